// Where the colours of a field change.
#include <algorithm>
#include <cmath>

#include "common/io/field_panel.hpp"

namespace talus::io {
namespace {

bool is_inside(const PlanePoint& point, const Window& window) {
  return window.low[0] <= point[0] && point[0] <= window.high[0] && window.low[1] <= point[1] &&
         point[1] <= window.high[1];
}

// The numbers that are shown, in their order; of a logarithmic scale positive ones.
std::vector<double> shown_values(const FieldMap& map) {
  const Window window = window_of(map);
  std::vector<double> shown;
  for (const FieldPatch& patch : map.patches)
    for (std::size_t k = 0; k < patch.points.size(); ++k)
      if (std::isfinite(patch.values[k]) && (!map.log_scale || patch.values[k] > 0) &&
          is_inside(patch.points[k], window))
        shown.push_back(patch.values[k]);
  std::ranges::sort(shown);
  return shown;
}

// The smallest and the largest of them. Next to a singular point a number says little: one in a
// hundred is left out at each end, of a linear scale if the others take up less than half of it.
std::array<double, 2> extremes(const std::vector<double>& shown, bool log_scale) {
  const std::size_t left_out = shown.size() / 100;
  const double low = shown[left_out], high = shown[shown.size() - 1 - left_out];
  const double all = shown.back() - shown.front();
  return log_scale || 2 * (high - low) < all ? std::array{low, high}
                                             : std::array{shown.front(), shown.back()};
}

std::vector<double> powers_of_ten(double low, double high, LogEnd kept) {
  constexpr double decades = 4;
  double last = std::ceil(std::log10(high) - 1e-9), first = std::floor(std::log10(low) + 1e-9);
  if (kept == LogEnd::high)
    first = std::max(first, last - decades);
  else
    last = std::min(last, first + decades);
  last = std::max(last, first + 1);
  std::vector<double> levels;
  for (int k = 0; k <= 2 * (last - first); ++k) levels.push_back(std::pow(10, first + 0.5 * k));
  return levels;
}

std::vector<double> round_numbers(double low, double high) {
  constexpr double tolerance = 0.02;  // by which a value may lie beyond the ends, in steps
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low <= 1e-9 * size || size == 0) {  // all the same, but for rounding
    const double step = size == 0 ? 1 : round_step(0.1 * size);
    low = std::floor(low / step) * step;
    return {low, low + step, low + 2 * step};
  }
  const double step = round_step((high - low) / 14);
  std::vector<double> levels;
  for (double k = std::floor(low / step + tolerance);
       levels.empty() || levels.back() < high - tolerance * step; ++k)
    levels.push_back(k * step);
  return levels;
}

}  // namespace

double round_step(double least) {
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1., 2., 5.})
    if (factor * power >= least * (1 - 1e-12)) return factor * power;
  return 10 * power;
}

std::vector<double> levels_of(const FieldMap& map) {
  if (map.levels.size() > 1) return map.levels;
  const std::vector<double> shown = shown_values(map);
  if (shown.empty()) return {1, 10};
  const auto [low, high] = extremes(shown, map.log_scale);
  return map.log_scale && high > 5 * low ? powers_of_ten(low, high, map.kept)
                                         : round_numbers(low, high);
}

}  // namespace talus::io
