// How far Newton's iterate still is from the solution, told by the steps that led to it.
#pragma once

#include <limits>

namespace talus::solve {

/// After a full step of size |d| that contracted, θ = |d|/|d before| < 1, what is left is at most
/// θ/(1 - θ) |d| for as long as θ does not grow: a bound where convergence is linear, far from
/// sharp where it is quadratic (Deuflhard 2011, "Newton Methods for Nonlinear Problems", 2.1).
/// Infinity: the steps do not tell.
class RemainingDistance {
 public:
  /// A step of `length` along a direction of this size was taken.
  void stepped(double size, double length) {
    const double contraction = size / last_;
    bound_ = length == 1 && contraction < 1 ? contraction / (1 - contraction) * size : unknown;
    last_ = size;
  }
  double bound() const { return bound_; }
  /// The same from the direction of the step that would be next; from a first one 2 |d|, θ = 1/2.
  double bound_before(double size) const {
    const double contraction = last_ > 0 ? size / last_ : 0.5;
    return contraction < 1 ? size / (1 - contraction) : unknown;
  }
  /// Whether the next direction, of this size, is no smaller than the last.
  bool has_stopped_contracting(double size) const { return size >= last_; }

 private:
  static constexpr double unknown = std::numeric_limits<double>::infinity();
  double bound_ = unknown;
  double last_ = std::numeric_limits<double>::quiet_NaN();  // none yet: compares as false
};

}  // namespace talus::solve
