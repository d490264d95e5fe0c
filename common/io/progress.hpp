// Progress of long work on a terminal, with an estimate of the time left; silent elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace talus::io {

class Progress {
 public:
  Progress();
  ~Progress();
  /// Shows `what` and, from the fraction done in (0, 1], the time left.
  void show(const std::string& what, double fraction);

 private:
  using Clock = std::chrono::steady_clock;
  bool on_terminal_;
  Clock::time_point start_, last_shown_;
};

}  // namespace talus::io
