#include "common/io/progress.hpp"

#include <cstdio>

#include <unistd.h>

namespace talus::io {

Progress::Progress() : on_terminal_(isatty(STDERR_FILENO) == 1), start_(Clock::now()) {}

Progress::~Progress() {
  if (on_terminal_) std::fprintf(stderr, "\r\033[K");
}

void Progress::show(const std::string& what, double fraction) {
  const auto now = Clock::now();
  if (!on_terminal_ || now - last_shown_ < std::chrono::milliseconds(100)) return;
  last_shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  std::string left;
  if (fraction > 0.02)
    left =
        ", about " + std::to_string(static_cast<int>(elapsed * (1 / fraction - 1)) + 1) + " s left";
  std::fprintf(stderr, "\r\033[K%3.0f%%  %s%s", 100 * fraction, what.c_str(), left.c_str());
  std::fflush(stderr);
}

}  // namespace talus::io
