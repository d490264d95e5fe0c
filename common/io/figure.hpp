// Figures: panels of curves, maps or bars, written as data, gnuplot script and SVG, PNG or PDF.
// All look alike: how, is decided in figure_script.cpp alone.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/io/field_panel.hpp"
#include "common/io/gnuplot.hpp"
#include "common/io/result_folder.hpp"

namespace talus::io {

/// rings: around points of other curves. slope: a triangle with its label beside it, on logarithmic
/// axes, under part of the way from the first point to the last.
enum class Style { line, dashed, points, line_points, rings, slope };

struct Curve {
  std::string label;
  std::vector<double> x, y;
  Style style = Style::line_points;
  std::vector<std::string> commands = {};  ///< that make the points, one each; may be none
};

/// A value and a short mark for every cell of a grid of columns by rows; NaN is drawn grey.
struct Map {
  std::vector<std::string> columns, rows;
  std::vector<std::vector<double>> values;      ///< values[row][column]
  std::vector<std::vector<std::string>> marks;  ///< same shape
  std::string value_label;
  double largest = 1;  ///< end of the colour scale, which starts at 0
};

/// Of every row, the first on top, how many there are of each part, as shares of a bar of full
/// length with the numbers in it.
struct Bars {
  std::vector<std::string> rows, parts;
  std::vector<std::vector<double>> counts;  ///< counts[part][row]
};

/// Axes with curves, with a map, with bars or with a field. The legend stands below the axes.
struct Panel {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Curve> curves;
  std::optional<Map> map = std::nullopt;
  std::optional<Bars> bars = std::nullopt;
  std::optional<FieldMap> field = std::nullopt;
};

/// Of a panel, in CSS pixels: as wide as a phone shows it with text of 12 pixels.
struct PanelSize {
  int width = 400, height = 0;
};
PanelSize size_of(const Panel& panel);

struct Figure {
  std::string name;     ///< of the files, without ending
  std::string caption;  ///< what to see in it
  std::vector<Panel> panels;
  int columns = 2;
  std::string title = {};  ///< over all panels

  /// A picture of a flow rather than a chart.
  bool has_fields() const {
    return std::ranges::any_of(panels, [](const Panel& panel) { return panel.field.has_value(); });
  }
};
PanelSize size_of(const Figure& figure);

/// The data file, blocks in the order of the curves.
std::string figure_data(const Figure& figure);
/// The script that draws `format` ("svg", "png" or "pdf") from the data file, into NAME.FORMAT or
/// to stdout.
std::string figure_script(const Figure& figure, const std::string& format, bool to_stdout = false);
/// The script that draws every panel as an SVG, one after the other, to stdout.
std::string panels_script(const Figure& figure);
/// The font of an SVG, as attributes of its root.
std::string svg_font();

/// Writes NAME.dat and NAME.gp, and runs gnuplot for NAME.svg, .png or .pdf, which is there whole
/// or not at all. Returns why it is not; empty if it is. Throws UserError if a file cannot be
/// written. A tenth of a second is usual; gnuplot is killed after `limit`, and a second more for
/// each megabyte of data.
std::string write_figure(const ResultFolder& folder, const Figure& figure,
                         const std::string& format,
                         std::chrono::milliseconds limit = std::chrono::seconds(30));

/// The same with a file for each panel, all of them SVG: what a page arranges as wide as it is.
std::string write_panels(const ResultFolder& folder, const Figure& figure,
                         std::chrono::milliseconds limit = std::chrono::seconds(30));
/// The file of the panel of this number: NAME.svg of a single one, NAME_1.svg of the first of many.
std::string panel_file(const Figure& figure, std::size_t number);

/// Draws the figures in every format until one fails. Returns what a program says of it: a space
/// and the name of every picture, then why the rest is missing, in brackets.
std::string draw(const ResultFolder& folder, const std::vector<Figure>& figures,
                 const std::vector<std::string>& formats = {"png", "svg"});

/// The files that a figure of that name can leave, for ResultFolder::remove_older.
std::vector<std::string> files_of(const std::string& figure);

}  // namespace talus::io
