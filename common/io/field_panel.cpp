#include "common/io/field_panel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>

#include "common/io/table.hpp"

namespace talus::io {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Matplotlib's viridis at equal distances: lightness grows evenly, for the colour-blind as well.
constexpr std::array<std::array<int, 3>, 9> viridis = {{{68, 1, 84},
                                                        {71, 45, 123},
                                                        {59, 82, 139},
                                                        {44, 114, 142},
                                                        {33, 145, 140},
                                                        {40, 174, 128},
                                                        {94, 201, 98},
                                                        {173, 220, 48},
                                                        {253, 231, 37}}};
constexpr const char* grey = "#d4d4d4";

// The colour at a share of the scale, as "#rrggbb".
std::string colour_at(double share) {
  const double place = std::clamp(share, 0., 1.) * static_cast<double>(viridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  char text[8] = "#";
  for (std::size_t c = 0; c < 3; ++c)
    std::snprintf(text + 1 + 2 * c, 3, "%02lx",
                  std::lround(std::lerp(viridis[below][c], viridis[below + 1][c],
                                        place - static_cast<double>(below))) &
                      0xff);
  return text;
}

std::string colour_of(std::size_t band, std::size_t bands) {
  return colour_at((static_cast<double>(band) + 0.5) / static_cast<double>(bands));
}

// Values and levels as they go into colours: logarithms, or as they are.
double scaled(double value, bool log_scale) {
  if (!log_scale) return value;
  return value < 0 ? std::nan("") : std::log10(value);
}

// The patches in that scale, cut off a band beyond its ends.
std::vector<FieldPatch> scaled_patches(const FieldMap& map, const std::vector<double>& levels) {
  const double low = scaled(levels.front(), map.log_scale);
  const double high = scaled(levels.back(), map.log_scale);
  const double band = (high - low) / static_cast<double>(levels.size() - 1);
  std::vector<FieldPatch> patches = map.patches;
  for (FieldPatch& patch : patches)
    for (double& value : patch.values) {
      value = scaled(value, map.log_scale);
      if (!std::isnan(value)) value = std::clamp(value, low - band, high + band);
    }
  return patches;
}

// What is drawn, in its order: polygons or lines, and how.
struct Block {
  std::string meaning, style;
  std::function<std::vector<Polyline>()> lines;
  std::string title = {};  ///< in the legend
};

std::string filled(const std::string& colour) {
  return "with filledcurves closed fs solid noborder fc rgb '" + colour + "'";
}

std::string line_style(const std::string& width_and_colour) {
  return "with lines lw " + width_and_colour;
}

// Colours, and isolines: light where it is dark, dark where it is light.
void add_bands(const FieldMap& map, const Window& window, std::vector<Block>& blocks) {
  if (map.patches.empty()) return;
  const std::vector<double> levels = levels_of(map);
  const auto patches = std::make_shared<std::vector<FieldPatch>>(scaled_patches(map, levels));
  const std::size_t bands = levels.size() - 1;
  for (std::size_t k = 0; k < bands; ++k) {
    const double low = k == 0 ? -infinity : scaled(levels[k], map.log_scale);
    const double high = k + 1 == bands ? infinity : scaled(levels[k + 1], map.log_scale);
    blocks.push_back(
        {"from " + rounded(levels[k]) + " to " + rounded(levels[k + 1]),
         filled(colour_of(k, bands)),
         [=] { return std::vector<Polyline>{joined(area_between(*patches, low, high, window))}; }});
  }
  blocks.push_back({"not a number", filled(grey), [=] {
                      return std::vector<Polyline>{joined(area_without_number(*patches, window))};
                    }});
  for (const bool is_dark : {true, false})
    blocks.push_back(
        {is_dark ? "isolines, low" : "isolines, high",
         line_style(is_dark ? "0.6 lc rgb '#70ffffff'" : "0.6 lc rgb '#50000000'"), [=] {
           std::vector<Polyline> all;
           for (std::size_t k = 1; k < bands; ++k)
             if ((2 * k < bands) == is_dark)
               for (Polyline& line : isolines(*patches, scaled(levels[k], map.log_scale), window))
                 all.push_back(std::move(line));
           return all;
         }});
}

std::vector<Block> blocks_of(const FieldMap& map) {
  const Window window = window_of(map);
  std::vector<Block> blocks;
  add_bands(map, window, blocks);
  for (const FieldRegion& region : map.regions)
    blocks.push_back({region.label, filled(region.colour),
                      [&region, window] {
                        return std::vector<Polyline>{
                            joined(area_between(region.patches, 0, infinity, window))};
                      },
                      region.label});
  blocks.push_back(
      {"mesh", line_style("0.3 lc rgb '#60000000'"), [&map] { return map.mesh_lines; }});
  for (const FieldRegion& region : map.regions)
    blocks.push_back({"outline of " + region.label, line_style("0.8 lc rgb '#404040'"),
                      [&region, window] { return isolines(region.patches, 0, window); }});
  blocks.push_back({"streamlines", line_style("0.9 lc rgb '#1f2a44'"),
                    [&map] { return map.streamlines; },
                    map.streamlines.empty() ? "" : "streamlines"});
  const auto& whole =
      map.patches.empty() && !map.regions.empty() ? map.regions.front().patches : map.patches;
  blocks.push_back({"boundary", line_style("1 lc rgb '#222222'"), [&whole, window] {
                      std::vector<Polyline> outlines = area_of_all(whole, window);
                      for (Polyline& outline : outlines)
                        if (!outline.empty()) outline.push_back(outline.front());
                      return outlines;
                    }});
  return blocks;
}

std::string axis_range(const char* axis, double low, double high) {
  return std::string("set ") + axis + "range [" + rounded(low, 8) + ":" + rounded(high, 8) + "]\n";
}

// The scale beside the field, with the colours of the bands and marks where isolines are.
std::string bar_script(const FieldMap& map) {
  const std::vector<double> levels = levels_of(map);
  const std::size_t bands = levels.size() - 1, every = bands <= 8 ? 1 : 2;
  const bool has_powers = map.log_scale && levels.back() > 9 * levels.front();
  std::string colours, tics;
  for (std::size_t k = 0; k <= bands; ++k) {
    const double place = scaled(levels[k], map.log_scale);
    for (const std::size_t band : {k - 1, k})
      if (band < bands)
        colours +=
            (colours.empty() ? "" : ", ") + rounded(place, 8) + " '" + colour_of(band, bands) + "'";
    const bool is_power = std::abs(place - std::round(place)) < 1e-9;
    const std::string label = !has_powers ? (k % every == 0 ? rounded(levels[k]) : "")
                              : is_power  ? "1e" + std::to_string(std::lround(place))
                                          : "";
    tics += (tics.empty() ? "'" : ", '") + label + "' " + rounded(place, 8);
  }
  return "set palette defined (" + colours + ") maxcolors " + std::to_string(16 * bands) + "\n" +
         axis_range("cb", scaled(levels.front(), map.log_scale),
                    scaled(levels.back(), map.log_scale)) +
         "set cbtics (" + tics + ") scale 0.5\nset label 1 '" + map.value_label +
         "' at graph 1.04, graph 1 offset 0,0.9 noenhanced\nset colorbox user origin graph 1.04, "
         "graph 0 "
         "size character 1.6, graph 1\n";
}

}  // namespace

Window window_of(const FieldMap& map) {
  if (map.window) return *map.window;
  return box_of(map.patches.empty() && !map.regions.empty() ? map.regions.front().patches
                                                            : map.patches);
}

int field_height(const FieldMap& map, int width) {
  const bool has_key = !map.regions.empty() || !map.streamlines.empty();
  constexpr int beside = 160;
  const int above_and_below = has_key ? 150 : 105;
  const Window window = window_of(map);
  const double inside = width - beside;
  const double height = map.equal_axes && window.extent(0) > 0
                            ? inside * window.extent(1) / window.extent(0)
                            : 0.8 * inside;
  return static_cast<int>(std::clamp(height, 0.4 * width, 1.4 * width)) + above_and_below;
}

std::string field_data(const FieldMap& map, const std::string& title) {
  std::string data;
  for (const Block& block : blocks_of(map)) {
    data += "# " + title + ": " + block.meaning + "\n";
    bool is_empty = true;
    for (const Polyline& line : block.lines()) {
      if (!is_empty) data += "\n";
      for (const PlanePoint& point : line)
        data += rounded(point[0], 6) + " " + rounded(point[1], 6) + "\n";
      is_empty = is_empty && line.empty();
    }
    data += is_empty ? "NaN NaN\n\n\n" : "\n\n";
  }
  return data;
}

std::string field_script(const FieldMap& map, const std::string& data, std::size_t& block) {
  const Window window = window_of(map);
  const double step = round_step(std::max(window.extent(0), window.extent(1)) / 6);
  std::string script = "set title noenhanced\n" + axis_range("x", window.low[0], window.high[0]) +
                       axis_range("y", window.low[1], window.high[1]) + "unset grid\n";
  script += map.equal_axes ? "set size ratio -1\nset xtics " + rounded(step) + "\nset ytics " +
                                 rounded(step) + "\n"
                           : "";
  script += "set tics out nomirror scale 0.5\nset lmargin 8\nset rmargin 12\n";
  script += map.regions.empty() && map.streamlines.empty()
                ? "set bmargin 3.6\nunset key\n"
                : "set bmargin 6\nset key below vertical maxrows 2 Left reverse samplen 1.5\n";
  if (!map.patches.empty()) script += bar_script(map);
  std::string plots;
  for (const Block& each : blocks_of(map)) {
    plots += (plots.empty() ? "plot " : ", \\\n     ") + data + " index " +
             std::to_string(block++) + " using 1:2 " + each.style +
             (each.title.empty() ? " notitle" : " title '" + each.title + "'");
  }
  return script + plots + (map.patches.empty() ? "\n" : ", NaN with points palette notitle\n");
}

}  // namespace talus::io
