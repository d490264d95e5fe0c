// CPU time of the calling thread: what the studies chart, unmoved by other processes.
#pragma once

#include <time.h>

namespace talus::solve {

class Stopwatch {
 public:
  Stopwatch() : start_(now()) {}
  /// Seconds of CPU time since construction.
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double start_;
};

}  // namespace talus::solve
