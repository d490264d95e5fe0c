#include "common/solve/path.hpp"

#include <algorithm>
#include <cmath>

namespace talus::solve {

std::string name_of(PathEnd end) {
  switch (end) {
    case PathEnd::target_reached:
      return "target_reached";
    case PathEnd::left_bounds:
      return "left_bounds";
    case PathEnd::stopped:
      return "stopped";
    case PathEnd::out_of_points:
      return "out_of_points";
    case PathEnd::step_too_small:
      return "step_too_small";
    case PathEnd::start_failed:
      return "start_failed";
  }
  return {};
}

double next_step(double step, int corrections, const PathOptions& options) {
  if (corrections <= options.few_corrections)
    return std::min(step * options.growth, options.largest_step);
  return corrections >= options.many_corrections ? step / options.growth : step;
}

std::optional<double> fold_between(const PathPoint& before, const PathPoint& after) {
  // σ is measured along the tangent before, so at the other end dσ is the cosine times the length.
  const double rise = after.parameter - before.parameter;
  // course 16: fold
  const double first = before.parameter_slope * after.step;
  const double last = after.parameter_slope * after.step / after.cosine;
  if (!(after.cosine > 0) || first * last >= 0) return std::nullopt;
  // ds/dτ = a τ² + b τ + first on [0, 1], with one root there; the larger of its two forms.
  const double a = 3 * (first + last - 2 * rise), b = 6 * rise - 4 * first - 2 * last;
  const double q = -0.5 * (b + std::copysign(std::sqrt(b * b - 4 * a * first), b));
  const double root = first / q;
  const double tau = root >= 0 && root <= 1 ? root : q / a;
  return before.parameter + tau * (first + tau * (b / 2 + tau * a / 3));
  // end of course 16
}

std::vector<double> fold_parameters(std::span<const PathPoint> points) {
  std::vector<double> found;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (const auto fold = fold_between(points[i - 1], points[i])) found.push_back(*fold);
  return found;
}

}  // namespace talus::solve
