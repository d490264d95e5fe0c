// A vector held as an unevaluated sum value + correction (double-double): Newton's iterate and
// step.
//
// Why: in a plug η ~ μs p/λr multiplies differences of velocities that agree in most of their
// digits. What a double drops from the velocities then bounds the residual from below. Keeping what
// is dropped costs a few additions a component; differences of neighbouring components become exact
// to relative rounding, and with them the shear rate and the residual. Systems stay in double.
#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Core>

namespace talus::solve {

/// `plain` keeps the vector in double, as the paper does; `compensated` as value + correction.
enum class Precision { plain, compensated };

class CompensatedVector {
 public:
  CompensatedVector() = default;
  explicit CompensatedVector(Eigen::Index size, Precision precision = Precision::compensated)
      : value_(Eigen::VectorXd::Zero(size)),
        correction_(Eigen::VectorXd::Zero(size)),
        precision_(precision) {}
  /// A vector of doubles, exactly.
  explicit CompensatedVector(const Eigen::VectorXd& value)
      : value_(value), correction_(Eigen::VectorXd::Zero(value.size())) {}

  /// Both parts as they were: what a checkpoint keeps.
  CompensatedVector(Eigen::VectorXd value, Eigen::VectorXd correction)
      : value_(std::move(value)), correction_(std::move(correction)) {}

  Eigen::Index size() const { return value_.size(); }
  /// The vector rounded to double.
  const Eigen::VectorXd& value() const { return value_; }
  /// What the rounding dropped.
  const Eigen::VectorXd& correction() const { return correction_; }
  Precision precision() const { return precision_; }

  /// (this)_i to extended precision.
  long double long_value(Eigen::Index i) const {
    return static_cast<long double>(value_[i]) + correction_[i];
  }

  /// (this)_i - (this)_j; exact but for one rounding where the two agree in leading digits.
  long double difference(Eigen::Index i, Eigen::Index j) const {
    return (static_cast<long double>(value_[i]) - value_[j]) +
           (static_cast<long double>(correction_[i]) - correction_[j]);
  }

  /// The same in double: for sums in which no stiff neighbour needs the last digits.
  double short_difference(Eigen::Index i, Eigen::Index j) const {
    return (value_[i] - value_[j]) + (correction_[i] - correction_[j]);
  }

  /// Relative error with which a component is held.
  double resolution() const {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    return precision_ == Precision::plain ? epsilon : epsilon * epsilon;
  }

  /// this + step * direction.
  CompensatedVector moved(double step, const CompensatedVector& direction) const {
    CompensatedVector result(*this);
    for (Eigen::Index i = 0; i < size(); ++i) {
      const double product = step * direction.value_[i];
      const double rest = std::fma(step, direction.value_[i], -product);
      result.set_sum(i, value_[i], correction_[i], product, rest + step * direction.correction_[i]);
    }
    return result;
  }

  void set_zero() {
    value_.setZero();
    correction_.setZero();
  }
  void set(Eigen::Index i, double value) {
    value_[i] = value;
    correction_[i] = 0;
  }
  /// (this)_i = (this)_j + increment.
  void set_relative(Eigen::Index i, Eigen::Index j, double increment) {
    set_sum(i, value_[j], correction_[j], increment, 0);
  }

 private:
  // (a + a_low) + (b + b_low), by Knuth's two-sum: the rounding error of a + b goes to the
  // correction.
  void set_sum(Eigen::Index i, double a, double a_low, double b, double b_low) {
    const double sum = a + b;
    if (precision_ == Precision::plain) {
      value_[i] = sum;
      return;
    }
    const double shifted = sum - a;
    const double low = ((a - (sum - shifted)) + (b - shifted)) + (a_low + b_low);
    value_[i] = sum + low;
    correction_[i] = low - (value_[i] - sum);
  }

  Eigen::VectorXd value_, correction_;
  Precision precision_ = Precision::compensated;
};

}  // namespace talus::solve
