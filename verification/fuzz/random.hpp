// Draws of one trial: they depend on the seed, the kind and the number of the trial alone, so that
// any trial can be repeated by itself.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <string>

namespace talus::fuzz {

class Random {
 public:
  Random(std::uint64_t seed, const std::string& kind, int number) {
    std::seed_seq words(kind.begin(), kind.end());
    std::uint32_t of_kind[2];
    words.generate(std::begin(of_kind), std::end(of_kind));
    std::seed_seq all{of_kind[0], of_kind[1], static_cast<std::uint32_t>(seed),
                      static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(number)};
    engine_.seed(all);
  }

  /// In [0, 1).
  double share() { return std::ldexp(static_cast<double>(engine_() >> 11), -53); }
  bool chance(double probability) { return share() < probability; }
  double real(double lower, double upper) { return lower + (upper - lower) * share(); }
  /// Of no preferred magnitude; 0 < lower < upper.
  double magnitude(double lower, double upper) {
    return std::exp(real(std::log(lower), std::log(upper)));
  }
  /// In [lower, upper].
  int whole(int lower, int upper) {
    return lower + static_cast<int>(std::floor(share() * (static_cast<double>(upper) - lower + 1)));
  }
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  template <class List>
  const auto& one_of(const List& list) {
    return *std::next(std::begin(list), static_cast<std::ptrdiff_t>(below(std::size(list))));
  }
  template <class List>
  void shuffle(List& list) {
    for (std::size_t i = std::size(list); i > 1; --i) std::swap(list[i - 1], list[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace talus::fuzz
