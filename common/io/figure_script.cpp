// How figures look: sizes, colours, marks and lines, legends and the marks of maps.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/io/figure.hpp"
#include "common/io/figure_text.hpp"
#include "common/io/table.hpp"

namespace talus::io {
namespace {

// After Okabe & Ito and Tol, darkened until each has a contrast of three on white; told apart by
// the colour-blind, and by mark and line.
constexpr const char* palette[] = {"#0072B2", "#D55E00", "#007A5A", "#AA3377",
                                   "#8A6D00", "#000000", "#5B4B9E", "#6B7280"};
constexpr int marks[] = {7, 4, 9, 12, 5, 8, 13, 10, 11};
constexpr const char* dashes[] = {"1", "(12,4)", "(4,4)", "(12,4,3,4)", "(2,3)"};
constexpr const char* font_family = "Helvetica,Arial,sans-serif";
constexpr int font = 14, text_height = 19, text_width = 8;  // pixels; of a letter, on average
constexpr int axes_height = 305;                            // with tics and labels
constexpr int row_height = 22;                              // of a map or of bars

constexpr int longest_entry = 40, longest_title = 46, longest_y_label = 30;

// A label that comes again stands for both.
bool is_in_legend(const Panel& panel, std::size_t number) {
  const Curve& curve = panel.curves[number];
  if (curve.x.empty() || curve.label.empty() || curve.style == Style::slope) return false;
  for (std::size_t i = 0; i < number; ++i)
    if (panel.curves[i].label == curve.label && !panel.curves[i].x.empty()) return false;
  return true;
}

// Entries of the legend, and in how many rows they stand.
struct Legend {
  int entries = 0, rows = 0;
  int lines = 1;  ///< of an entry
};
Legend legend_of(const Panel& panel) {
  Legend legend;
  int longest = 0;
  const auto add = [&](const std::string& label) {
    if (label.empty()) return;
    ++legend.entries;
    const auto lines = lines_of(label, longest_entry);
    for (const std::string& line : lines) longest = std::max(longest, length_of(line));
    legend.lines = std::max(legend.lines, static_cast<int>(lines.size()));
  };
  if (panel.bars)
    for (const std::string& part : panel.bars->parts) add(part);
  else if (!panel.map)
    for (std::size_t i = 0; i < panel.curves.size(); ++i)
      if (is_in_legend(panel, i)) add(panel.curves[i].label);
  const int columns = std::max(1, (PanelSize{}.width - 20) / (longest * text_width + 50));
  legend.rows = (legend.entries + columns - 1) / columns;
  return legend;
}

std::string tics(const char* axis, const std::vector<std::string>& labels, int step = 1) {
  std::string result = std::string("set ") + axis + "tics (";
  for (std::size_t i = 0; i < labels.size(); ++i)
    result += (i == 0 ? "" : ", ") + in_quotes(labels[i]) + " " +
              std::to_string(step * static_cast<int>(i));
  return result + ")\n";
}

// The first curves are drawn thick and large, the last thin and small over them, so that of curves
// that coincide each is seen.
std::string curve_style(const Curve& curve, std::size_t number, std::size_t count) {
  const double late =
      count > 1 ? static_cast<double>(number) / static_cast<double>(count - 1) : 0.5;
  const std::string colour = " lc rgb " + in_quotes(palette[number % std::size(palette)]);
  const std::string mark = " pt " + std::to_string(marks[number % std::size(marks)]) + " ps " +
                           rounded(0.95 - 0.45 * late, 3);
  const std::string line =
      " lw " + rounded(2.8 - 1.5 * late, 3) + " dt " + dashes[number % std::size(dashes)];
  switch (curve.style) {
    case Style::line:
      return "with lines" + line + colour;
    case Style::dashed:
      return "with lines lw 1.5 dt (6,4)" + colour;
    case Style::rings:
      return "with points ps 1.5 pt 6 lw 1.6 lc rgb '#000000'";
    case Style::points:
      return "with points" + mark + colour;
    case Style::line_points:
      return "with linespoints" + line + mark + colour;
    case Style::slope:
      return "with lines lw 1.2 lc rgb '#444444'";
  }
  return {};
}

// At the upper end of the upright side of the triangle, which figure_data leaves in the data.
std::string slope_label(const std::string& block_of_data, const Curve& curve) {
  const bool is_rising = (curve.x.back() > curve.x.front()) == (curve.y.back() > curve.y.front());
  return ", \\\n     " + block_of_data + " every ::2::2 using 1:2:(" + in_quotes(curve.label) +
         ") with labels " + (is_rising ? "left offset 0.6,-0.7" : "right offset -0.6,-0.7") +
         " notitle";
}

// More points than that run into each other; all are in the data.
std::string thinned(const Curve& curve) {
  constexpr std::size_t most = 100;
  if (curve.style != Style::points || curve.x.size() <= most) return " ";
  return " every " + std::to_string((curve.x.size() + most - 1) / most) + " ";
}

struct Extent {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
};
Extent extent_of(const Panel& panel, std::vector<double> Curve::*values, bool is_log) {
  Extent extent;
  for (const Curve& curve : panel.curves)
    for (const double value : curve.*values)
      if (std::isfinite(value) && (!is_log || value > 0)) {
        extent.lowest = std::min(extent.lowest, value);
        extent.highest = std::max(extent.highest, value);
      }
  return extent;
}

// A range around values that are all the same, of which gnuplot makes none without a warning.
std::string range(const char* axis, const Extent& extent, bool is_log) {
  const double at = extent.lowest;
  if (at != extent.highest) return {};
  const double margin = at == 0 ? 1 : 0.1 * std::abs(at);
  return std::string("set ") + axis + "range [" + exact(is_log ? at / 2 : at - margin) + ":" +
         exact(is_log ? 2 * at : at + margin) + "]\n";
}

// At most five numbers along a linear axis: more run into each other on a phone.
std::string spaced_tics(const Extent& extent) {
  const double least = (extent.highest - extent.lowest) / 4;
  if (!(least > 0 && std::isfinite(least))) return {};
  const double unit = std::pow(10, std::floor(std::log10(least)));
  double step = 10 * unit;
  for (const double share : {5., 2., 1.})
    if (share * unit >= least) step = share * unit;
  return "set xtics " + rounded(step, 3) + "\n";
}

// Cells in blue, their marks in white on the dark ones and in black on the light: a contrast of 4.4
// at least.
std::string map_script(const Map& map, const std::string& data, std::size_t block) {
  const std::string cells = data + " index " + std::to_string(block);
  return tics("x", map.columns) + tics("y", map.rows) +
         "set xtics rotate by -40 left\nset tics scale 0\nunset grid\nunset key\nset cblabel " +
         in_quotes(map.value_label) +
         "\nset palette defined (0 '#f7fbff', 0.5 '#6baed6', 1 '#08306b') maxcolors 32\nset "
         "cbrange [0:" +
         exact(map.largest) + "]\nset xrange [-0.5:" + std::to_string(map.columns.size()) +
         "-0.5]\nset yrange [-0.5:" + std::to_string(map.rows.size()) +
         "-0.5]\nset object 1 rectangle from graph 0,0 to graph 1,1 fc rgb '#dddddd' "
         "behind\nplot " +
         cells + " using 1:2:3 with image pixels, " + cells + " using 1:2:4:($3 > " +
         exact(0.7 * map.largest) + " ? 0xffffff : 0x000000) with labels tc rgb variable\n";
}

// Bars with their numbers in them, where there is room.
std::string bars_script(const Bars& bars, const std::string& data, std::size_t block) {
  constexpr double room = 6;  // percent
  int longest = 0;
  for (const std::string& row : bars.rows) longest = std::max(longest, length_of(row));
  std::string boxes, numbers;
  for (std::size_t part = 0; part < bars.parts.size(); ++part) {
    const std::string block_of_data = data + " index " + std::to_string(block + part);
    boxes += (boxes.empty() ? "plot " : ", \\\n     ") + block_of_data +
             " using 1:2:3:4:($2-0.38):($2+0.38) with boxxyerror fs solid border lc rgb '#ffffff' "
             "fc rgb " +
             in_quotes(palette[part % std::size(palette)]) + " title " +
             in_quotes(bars.parts[part]);
    numbers += ", \\\n     " + block_of_data + " using 1:2:($4-$3 < " + exact(room) +
               " ? '' : sprintf('%g', $5)) with labels tc rgb '#ffffff' notitle";
  }
  return tics("y", bars.rows, -1) + "set tics scale 0\nset lmargin " + rounded(0.95 * longest + 1) +
         "\nset xtics 0,25,100\nunset grid\nset xrange [0:100]\nset yrange [" +
         exact(0.5 - static_cast<double>(bars.rows.size())) + ":0.5]\n" + boxes + numbers + "\n";
}

std::string panel_script(const Panel& panel, const std::string& data, std::size_t& block) {
  const Legend legend = legend_of(panel);
  std::string script =
      "reset\nset tmargin " +
      std::to_string(lines_of(panel.title, longest_title).size() + (panel.title.empty() ? 0 : 1)) +
      "\nset border lc rgb '#444444'\nset tics nomirror\nset grid lc rgb '#dddddd' lt 1\nset "
      "title " +
      wrapped(panel.title, longest_title) + " offset 0,-0.6" + "\nset xlabel " +
      wrapped(panel.x_label, longest_title, legend.entries > 0) + " offset 0,0.4" +
      "\nset ylabel " + wrapped(panel.y_label, longest_y_label) +
      "\nset key below vertical maxrows " + std::to_string(std::max(1, legend.rows)) +
      " Left reverse samplen 3 spacing " + rounded(0.92 * legend.lines, 3) + "\n";
  if (legend.entries == 0) script += "unset key\n";
  if (panel.field) return script + field_script(*panel.field, data, block);
  if (panel.bars) {
    script += bars_script(*panel.bars, data, block);
    block += panel.bars->parts.size();
    return script;
  }
  if (panel.map) return script + map_script(*panel.map, data, block++);
  if (panel.log_x) script += "set logscale x\nset format x '1e%T'\n";
  if (panel.log_y) script += "set logscale y\nset format y '1e%T'\n";
  const Extent across = extent_of(panel, &Curve::x, panel.log_x);
  script += range("x", across, panel.log_x) +
            range("y", extent_of(panel, &Curve::y, panel.log_y), panel.log_y);
  if (!panel.log_x) script += spaced_tics(across);
  const auto count = static_cast<std::size_t>(std::ranges::count_if(
      panel.curves, [](const Curve& curve) { return curve.style < Style::rings; }));
  std::string plots;
  for (std::size_t i = 0; i < panel.curves.size(); ++i, ++block) {
    const Curve& curve = panel.curves[i];
    if (curve.x.empty()) continue;
    const bool is_slope = curve.style == Style::slope;
    const std::string block_of_data = data + " index " + std::to_string(block);
    plots +=
        (plots.empty() ? "plot " : ", \\\n     ") + block_of_data + thinned(curve) +
        curve_style(curve, i, std::max(count, i + 1)) +
        (is_in_legend(panel, i) ? " title " + wrapped(curve.label, longest_entry) : " notitle");
    if (is_slope) plots += slope_label(block_of_data, curve);
  }
  return script + plots + "\n";
}

// Of the panels in a whole figure.
struct PanelGrid {
  int columns = 0, rows = 0;
};
PanelGrid grid_of(const Figure& figure) {
  const int count = static_cast<int>(figure.panels.size());
  const int columns = std::max(1, std::min(figure.columns, count));
  return {columns, (count + columns - 1) / columns};
}

std::string terminal(const std::string& format, int width, int height) {
  const std::string size = std::to_string(width) + "," + std::to_string(height);
  if (format == "png")  // twice as fine as a page: for a projector
    return "set terminal pngcairo noenhanced size " + std::to_string(2 * width) + "," +
           std::to_string(2 * height) + " font 'Sans,10' fontscale 2 linewidth 2 pointscale 2\n";
  if (format == "pdf")  // of the same size on paper as on a screen of 96 dots an inch
    return "set terminal pdfcairo noenhanced size " + rounded(width / 96., 5) + "," +
           rounded(height / 96., 5) + " font 'Sans,10'\n";
  return "set terminal svg noenhanced size " + size + " fixed font '" + font_family + "," +
         std::to_string(font) + "' background rgb 'white'\n";
}

}  // namespace

PanelSize size_of(const Panel& panel) {
  if (panel.field) return {.height = field_height(*panel.field, PanelSize{}.width)};
  const int titles = static_cast<int>(lines_of(panel.title, longest_title).size()) - 1;
  int height = axes_height;
  if (panel.map)
    height = std::max(height, 110 + row_height * static_cast<int>(panel.map->rows.size()));
  if (panel.bars) height = 80 + row_height * static_cast<int>(panel.bars->rows.size());
  const Legend legend = legend_of(panel);
  return {.height = height + text_height * (titles + legend.rows * legend.lines)};
}

PanelSize size_of(const Figure& figure) {
  PanelSize largest;
  for (const Panel& panel : figure.panels)
    largest.height = std::max(largest.height, size_of(panel).height);
  const PanelGrid grid = grid_of(figure);
  return {grid.columns * largest.width, grid.rows * largest.height};
}

std::string svg_font() {
  return std::string("font-family=\"") + font_family + "\" font-size=\"" + std::to_string(font) +
         "\"";
}

std::string figure_script(const Figure& figure, const std::string& format, bool to_stdout) {
  const PanelSize size = size_of(figure);
  const PanelGrid grid = grid_of(figure);
  std::string script = "# gnuplot " + figure.name + ".gp\nset encoding utf8\n" +
                       terminal(format, size.width, size.height) + "set output" +
                       (to_stdout ? "" : " " + in_quotes(figure.name + "." + format)) +
                       "\nset multiplot layout " + std::to_string(grid.rows) + "," +
                       std::to_string(grid.columns) +
                       (figure.title.empty() ? "" : " title " + in_quotes(figure.title)) + "\n";
  std::size_t block = 0;
  for (const Panel& panel : figure.panels)
    script += panel_script(panel, in_quotes(figure.name + ".dat"), block);
  return script + "unset multiplot\nset output\n";
}

std::string panels_script(const Figure& figure) {
  std::string script = "set encoding utf8\n";
  std::size_t block = 0;
  for (const Panel& panel : figure.panels) {
    const PanelSize size = size_of(panel);
    script += terminal("svg", size.width, size.height) + "set output\n" +
              panel_script(panel, in_quotes(figure.name + ".dat"), block) + "set output\n";
  }
  return script;
}

}  // namespace talus::io
