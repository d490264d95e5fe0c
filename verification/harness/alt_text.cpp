#include "verification/harness/alt_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "common/io/table.hpp"

namespace talus::verification {
namespace {

std::string words_for(const io::Curve& curve) {
  const std::string name = curve.label.empty() ? "curve" : curve.label;
  if (curve.style == io::Style::slope) return name + " as a triangle";
  const std::string count = std::to_string(curve.x.size());
  if (curve.x.size() == 1)
    return name + ": one point, " + io::rounded(curve.y[0], 3) + " at " +
           io::rounded(curve.x[0], 3);
  if (curve.style == io::Style::rings || curve.style == io::Style::points)
    return name + ": " + count + " points between " +
           io::rounded(*std::ranges::min_element(curve.y), 3) + " and " +
           io::rounded(*std::ranges::max_element(curve.y), 3);
  const double first = curve.y.front(), last = curve.y.back();
  return name +
         (last < first   ? " falls from "
          : last > first ? " rises from "
                         : " goes from ") +
         io::rounded(first, 3) + " at " + io::rounded(curve.x.front(), 3) + " to " +
         io::rounded(last, 3) + " at " + io::rounded(curve.x.back(), 3);
}

std::string words_for(const io::Map& map) {
  std::map<std::string, int> marks;
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  int grey = 0;
  for (std::size_t row = 0; row < map.values.size(); ++row)
    for (std::size_t column = 0; column < map.values[row].size(); ++column) {
      const double value = map.values[row][column];
      const std::string& mark = map.marks[row][column];
      if (std::isnan(value)) ++grey;
      if (!mark.empty() && std::isnan(io::number_in(mark))) ++marks[mark];
      if (!std::isfinite(value)) continue;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  std::string words = "map of " + std::to_string(map.columns.size()) + " columns and " +
                      std::to_string(map.rows.size()) + " rows, " + map.value_label;
  if (lowest <= highest)
    words += " from " + io::rounded(lowest, 3) + " to " + io::rounded(highest, 3);
  words += ", " + std::to_string(grey) + " grey cells";
  for (const auto& [mark, count] : marks) words += ", mark " + mark + " " + std::to_string(count);
  return words;
}

std::string words_for(const io::Bars& bars) {
  std::string words = "bars";
  for (std::size_t row = 0; row < bars.rows.size(); ++row) {
    words += "; " + bars.rows[row] + ":";
    for (std::size_t part = 0; part < bars.parts.size(); ++part)
      if (bars.counts[part][row] != 0)
        words += " " + io::rounded(bars.counts[part][row]) + " " + bars.parts[part];
  }
  return words;
}

}  // namespace

std::string alt_text(const io::Panel& panel) {
  std::string text = panel.title + ". ";
  if (panel.map) return text + words_for(*panel.map) + ".";
  if (panel.bars) return text + words_for(*panel.bars) + ".";
  text += panel.y_label + " over " + panel.x_label +
          (panel.log_x && panel.log_y ? ", both logarithmic"
           : panel.log_y              ? ", logarithmic upwards"
           : panel.log_x              ? ", logarithmic to the right"
                                      : "");
  for (const io::Curve& curve : panel.curves)
    if (!curve.x.empty()) text += "; " + words_for(curve);
  return text + ".";
}

}  // namespace talus::verification
