// Loops over independent pieces of work on several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <vector>

namespace talus::solve {

/// Threads that loops may use; 1 at first. To be set between loops, not within.
int threads();
void set_threads(int count);

/// Calls body(i) for every i in [first, last), in equal runs of at least `least` on as many threads
/// as there are. What body throws is thrown here.
template <class Body>
void parallel_for(std::size_t first, std::size_t last, std::size_t least, const Body& body) {
  const std::size_t count = last - first;
  const std::size_t runs =
      std::clamp<std::size_t>(count / least, 1, static_cast<std::size_t>(threads()));
  const auto run = [&](std::size_t number) {
    for (std::size_t i = first + count * number / runs; i < first + count * (number + 1) / runs;
         ++i)
      body(i);
  };
  std::vector<std::future<void>> others;
  for (std::size_t number = 1; number < runs; ++number)
    others.push_back(std::async(std::launch::async, run, number));
  run(0);
  for (auto& other : others) other.get();
}

}  // namespace talus::solve
