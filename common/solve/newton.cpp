#include "common/solve/newton.hpp"

#include <algorithm>

namespace talus::solve {

LineSearchResult search_energy_slope(double initial_slope,
                                     const std::function<double(double)>& slope) {
  constexpr double overshoot = 0.1;   // accepted positive slope, relative to the first
  constexpr double undershoot = 0.5;  // a shortened step must come this near the minimum
  constexpr int max_evaluations = 60;
  if (!(initial_slope < 0)) return {};
  double low = 0, slope_low = initial_slope, high = 1;
  double slope_high = slope(high);
  if (slope_high <= overshoot * -initial_slope) return {1, 1};
  for (int evaluations = 2; evaluations <= max_evaluations; ++evaluations) {
    // course 11: line search
    // A step that left the range of numbers is halved; otherwise false position, kept inside.
    double step = 0.5 * (low + high);
    if (std::isfinite(slope_high)) {
      const double secant = low - slope_low * (high - low) / (slope_high - slope_low);
      const double margin = 1e-3 * (high - low);
      step = std::clamp(secant, low + margin, high - margin);
    }
    const double s = slope(step);
    if (s <= overshoot * -initial_slope && s >= undershoot * initial_slope)
      return {step, evaluations};
    if (s < 0) {
      low = step;
      slope_low = s;
      if (std::isfinite(slope_high)) slope_high *= 0.5;
    } else {
      high = step;
      slope_high = s;
      slope_low *= 0.5;
    }
    // end of course 11
  }
  return {};
}

LineSearchResult search_residual_norm(double initial_norm,
                                      const std::function<double(double)>& norm, double smallest) {
  constexpr double decrease = 1e-4;
  int evaluations = 0;
  for (double step = 1; step >= smallest; step *= 0.5) {
    ++evaluations;
    if (norm(step) <= (1 - decrease * step) * initial_norm) return {step, evaluations};
  }
  return {0, evaluations};
}

}  // namespace talus::solve
