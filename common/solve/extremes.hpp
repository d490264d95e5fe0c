// Largest and smallest that keep a NaN, whichever side it stands on: std::max and std::fmin drop
// it, and a check on what is left would pass.
#pragma once

#include <initializer_list>

namespace talus::solve {

/// The larger of two numbers; NaN if one of them is.
constexpr double nan_max(double a, double b) {
  return a > b || a != a ? a : b;
}
/// The smaller of two numbers; NaN if one of them is.
constexpr double nan_min(double a, double b) {
  return a < b || a != a ? a : b;
}

/// The largest of several numbers (at least one); NaN if one of them is.
constexpr double nan_max(std::initializer_list<double> numbers) {
  double largest = *numbers.begin();
  for (const double each : numbers) largest = nan_max(largest, each);
  return largest;
}

}  // namespace talus::solve
