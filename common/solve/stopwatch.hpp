// CPU time of the process, all its threads together: what the studies chart, unmoved by other
// processes. The wall's clock beside it tells what threads gain.
#pragma once

#include <time.h>

namespace talus::solve {

class Stopwatch {
 public:
  /// Seconds of CPU time since construction.
  double seconds() const { return now(CLOCK_PROCESS_CPUTIME_ID) - start_; }
  /// Seconds on the wall since construction.
  double elapsed() const { return now(CLOCK_MONOTONIC) - wall_start_; }

 private:
  static double now(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double start_ = now(CLOCK_PROCESS_CPUTIME_ID), wall_start_ = now(CLOCK_MONOTONIC);
};

}  // namespace talus::solve
