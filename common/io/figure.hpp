// Figures: panels of curves or maps, written as data, gnuplot script and SVG (or PNG).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

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

/// Whether gnuplot can be run at all.
bool gnuplot_is_available();

/// The data file, blocks in the order of the curves.
std::string figure_data(const Figure& figure);
/// The script that draws `format` ("svg" or "png") from the data file.
std::string figure_script(const Figure& figure, const std::string& format);

/// Writes NAME.dat and NAME.gp, and runs gnuplot for NAME.svg or NAME.png.
/// Returns false where gnuplot is missing or drew nothing.
bool write_figure(const ResultFolder& folder, const Figure& figure, const std::string& format);

}  // namespace talus::io
