#include "common/solve/parallel.hpp"

namespace talus::solve {
namespace {

int thread_count = 1;

}  // namespace

int threads() {
  return thread_count;
}

void set_threads(int count) {
  thread_count = std::max(1, count);
}

}  // namespace talus::solve
