// Figures: panels of curves or maps, written as data, gnuplot script and SVG, PNG or PDF.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/io/gnuplot.hpp"
#include "common/io/result_folder.hpp"

namespace talus::io {

enum class Style { line, dashed, points, line_points, rings };

struct Curve {
  std::string label;
  std::vector<double> x, y;
  Style style = Style::line_points;
};

/// A value and a short mark for every cell of a grid of columns by rows; NaN is drawn grey.
struct Map {
  std::vector<std::string> columns, rows;
  std::vector<std::vector<double>> values;      ///< values[row][column]
  std::vector<std::vector<std::string>> marks;  ///< same shape
  std::string value_label;
  double largest = 1;  ///< end of the colour scale, which starts at 0
};

/// Axes with curves, or with a map.
struct Panel {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<Curve> curves;
  std::optional<Map> map = std::nullopt;
  std::string key = "top right";  ///< gnuplot's place of the legend
};

struct Figure {
  std::string name;     ///< of the files, without ending
  std::string caption;  ///< what to see in it
  std::vector<Panel> panels;
  int columns = 2;
};

/// The data file, blocks in the order of the curves.
std::string figure_data(const Figure& figure);
/// The script that draws `format` ("svg", "png" or "pdf") from the data file.
std::string figure_script(const Figure& figure, const std::string& format);

/// Writes NAME.dat and NAME.gp, and runs gnuplot for NAME.svg, .png or .pdf, which is there whole
/// or not at all. Returns why it is not; empty if it is. Throws UserError if a file cannot be
/// written. A tenth of a second is usual; gnuplot is killed after `limit`, and a second more for
/// each megabyte of data.
std::string write_figure(const ResultFolder& folder, const Figure& figure,
                         const std::string& format,
                         std::chrono::milliseconds limit = std::chrono::seconds(30));

/// Draws the figures in every format until one fails. Returns what a program says of it: a space
/// and the name of every picture, then why the rest is missing, in brackets.
std::string draw(const ResultFolder& folder, const std::vector<Figure>& figures,
                 const std::vector<std::string>& formats = {"png", "svg"});

/// The files that a figure of that name can leave, for ResultFolder::remove_older.
std::vector<std::string> files_of(const std::string& figure);

}  // namespace talus::io
