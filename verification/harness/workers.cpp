#include "verification/harness/workers.hpp"

#include <atomic>
#include <csignal>
#include <thread>
#include <vector>

namespace talus::process {
namespace {

std::atomic<bool> is_interrupted = false;

}  // namespace

bool in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto stop = [](int) { is_interrupted = true; };
  const auto old_int = std::signal(SIGINT, stop), old_term = std::signal(SIGTERM, stop);
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < jobs; ++i)
      workers.emplace_back([&] {
        for (std::size_t k; !is_interrupted && (k = next++) < count;) work(k);
      });
  }
  std::signal(SIGINT, old_int);
  std::signal(SIGTERM, old_term);
  return !is_interrupted;
}

bool interrupted() {
  return is_interrupted;
}

}  // namespace talus::process
