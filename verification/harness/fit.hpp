// What is said of numbers: fitted orders of convergence, and how far they range.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace talus::verification {

/// Least-squares slope of log y against log x (GSL); NaN for fewer than two points.
double fitted_order(const std::vector<double>& x, const std::vector<double>& y);

/// From the smallest to the largest of some numbers, as a caption gives it: computed from the data
/// that it stands under.
class Range {
 public:
  void add(double value);
  double lower() const { return lower_; }  ///< NaN of none, or if one is NaN
  double upper() const { return upper_; }  ///< the same
  /// "1.5 to 2", "2" where that is the same in so many digits, "not known" for NaN.
  std::string text(int digits) const;

 private:
  double lower_ = std::numeric_limits<double>::quiet_NaN(), upper_ = lower_;
  bool is_empty_ = true;
};
/// A number as `Range` gives it.
std::string known(double value, int digits);

}  // namespace talus::verification
