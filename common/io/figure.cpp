#include "common/io/figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/io/gnuplot.hpp"
#include "common/io/table.hpp"

namespace talus::io {
namespace {

// Okabe & Ito's palette, told apart by the colour-blind as well.
constexpr const char* palette[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#E69F00", "#56B4E9", "#000000", "#999933"};
constexpr int panel_width = 520, panel_height = 390;

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

int columns_of(const Figure& figure) {
  return std::min(figure.columns, static_cast<int>(figure.panels.size()));
}

std::string tics(const char* axis, const std::vector<std::string>& labels) {
  std::string result = std::string("set ") + axis + "tics (";
  for (std::size_t i = 0; i < labels.size(); ++i)
    result += (i == 0 ? "" : ", ") + quoted(labels[i]) + " " + std::to_string(i);
  return result + ")\n";
}

std::string curve_style(const Curve& curve, std::size_t number) {
  const std::string colour = quoted(palette[number % std::size(palette)]);
  const std::string point = std::to_string(std::vector<int>{7, 5, 9, 13, 11, 6, 4, 8}[number % 8]);
  switch (curve.style) {
    case Style::line:
      return "with lines lw 2 lc rgb " + colour;
    case Style::dashed:
      return "with lines lw 1.5 dt 2 lc rgb " + colour;
    case Style::rings:
      return "with points ps 1.2 pt 6 lw 1.2 lc rgb '#000000'";
    case Style::points:
      return "with points ps 0.6 pt " + point + " lc rgb " + colour;
    case Style::line_points:
      return "with linespoints lw 1.5 ps 0.7 pt " + point + " lc rgb " + colour;
  }
  return {};
}

// A range around values that are all the same, of which gnuplot makes none without a warning.
std::string range(const char* axis, const Panel& panel, std::vector<double> Curve::*values,
                  bool is_log) {
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (const Curve& curve : panel.curves)
    for (const double value : curve.*values)
      if (std::isfinite(value) && (!is_log || value > 0)) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
      }
  if (lowest != highest) return {};
  const double margin = lowest == 0 ? 1 : 0.1 * std::abs(lowest);
  return std::string("set ") + axis + "range [" + exact(is_log ? lowest / 2 : lowest - margin) +
         ":" + exact(is_log ? 2 * highest : highest + margin) + "]\n";
}

std::string panel_script(const Panel& panel, const std::string& data, std::size_t& block) {
  std::string script = "reset\nset border lc rgb '#444444'\nset grid lc rgb '#dddddd' lt 1\n";
  script += "set title " + quoted(panel.title) + "\nset xlabel " + quoted(panel.x_label) +
            "\nset ylabel " + quoted(panel.y_label) + "\nset key " + panel.key +
            " samplen 2 spacing 0.95 font ',10'\n";
  if (panel.map) {
    const Map& map = *panel.map;
    script += tics("x", map.columns) + tics("y", map.rows);
    script +=
        "set xtics rotate by -40 left\nset tics scale 0\nunset grid\nunset key\nset cblabel " +
        quoted(map.value_label) +
        "\nset palette defined (0 '#f7fbff', 0.5 '#6baed6', 1 '#08306b')\n";
    script += "set cbrange [0:" + exact(map.largest) + "]\n";
    script += "set xrange [-0.5:" + std::to_string(map.columns.size()) +
              "-0.5]\nset yrange [-0.5:" + std::to_string(map.rows.size()) +
              "-0.5]\nset object 1 rectangle from graph 0,0 to "
              "graph 1,1 fc rgb '#dddddd' behind\n";
    script += "plot " + data + " index " + std::to_string(block) +
              " using 1:2:3 with image pixels, " + data + " index " + std::to_string(block) +
              " using 1:2:4:($3 > " + exact(map.largest / 2) +
              " ? 0xffffff : 0xd55e00) with labels font ',11' tc rgb variable\n";
    ++block;
    return script;
  }
  if (panel.log_x) script += "set logscale x\nset format x '10^{%L}'\n";
  if (panel.log_y) script += "set logscale y\nset format y '10^{%L}'\n";
  script += range("x", panel, &Curve::x, panel.log_x) + range("y", panel, &Curve::y, panel.log_y);
  std::string plots;
  for (std::size_t i = 0; i < panel.curves.size(); ++i, ++block) {
    const Curve& curve = panel.curves[i];
    if (curve.x.empty()) continue;
    plots += (plots.empty() ? "plot " : ", \\\n     ") + data + " index " + std::to_string(block) +
             " " + curve_style(curve, i) +
             (curve.label.empty() ? " notitle" : " title " + quoted(curve.label));
  }
  return script + plots + "\n";
}

// To where `output` says.
std::string script_to(const std::string& output, const Figure& figure, const std::string& format) {
  const int columns = columns_of(figure);
  const int rows = (static_cast<int>(figure.panels.size()) + columns - 1) / columns;
  const std::string size =
      std::to_string(columns * panel_width) + "," + std::to_string(rows * panel_height);
  std::string script = "# gnuplot " + figure.name + ".gp\nset encoding utf8\n";
  // Of the same size on paper as on a screen of 96 dots an inch.
  const std::string inches =
      io::rounded(columns * panel_width / 96., 5) + "," + io::rounded(rows * panel_height / 96., 5);
  script += format == "png" ? "set terminal pngcairo size " + size + " font 'Sans,11' enhanced\n"
            : format == "pdf"
                ? "set terminal pdfcairo size " + inches + " font 'Sans,9' enhanced\n"
                : "set terminal svg size " + size +
                      " dynamic font 'Helvetica,13' enhanced background rgb 'white'\n";
  script += "set output" + output + "\n";
  script += "set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) + "\n";
  std::size_t block = 0;
  for (const Panel& panel : figure.panels)
    script += panel_script(panel, quoted(figure.name + ".dat"), block);
  return script + "unset multiplot\nset output\n";
}

// Gnuplot can die, or be a stand-in, without saying so.
bool is_whole(const std::string& image, const std::string& format) {
  const bool is_png = format == "png", is_pdf = format == "pdf";
  const std::string start = is_png ? "\x89PNG" : is_pdf ? "%PDF" : "<svg";
  const std::string end = is_png ? "IEND" : is_pdf ? "%%EOF" : "</svg>";
  const std::size_t first = image.find(start), last = image.rfind(end);
  constexpr std::size_t most_after = 4;  // a checksum, or line breaks
  return first != std::string::npos && last != std::string::npos && first < last &&
         image.size() - last - end.size() <= most_after;
}

}  // namespace

std::string figure_data(const Figure& figure) {
  std::string data;
  for (const Panel& panel : figure.panels) {
    if (panel.map) {
      data += "# " + panel.title + ": column row value mark\n";
      for (std::size_t row = 0; row < panel.map->rows.size(); ++row)
        for (std::size_t column = 0; column < panel.map->columns.size(); ++column) {
          const std::string& mark = panel.map->marks[row][column];
          const double value = panel.map->values[row][column];
          data += std::to_string(column) + " " + std::to_string(row) + " " +
                  (std::isfinite(value) ? exact(value) : "NaN") + " " +
                  (mark.empty() ? "\"\"" : "\"" + mark + "\"") + "\n";
        }
      data += "\n\n";
      continue;
    }
    for (const Curve& curve : panel.curves) {
      data += "# " + panel.title + ": " + curve.label + "\n# " + panel.x_label + "  " +
              panel.y_label + "\n";
      if (curve.x.empty()) data += "NaN NaN\n";
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        data += exact(curve.x[i]) + " " + exact(curve.y[i]) + "\n";
      data += "\n\n";
    }
  }
  return data;
}

std::string figure_script(const Figure& figure, const std::string& format) {
  return script_to(" " + quoted(figure.name + "." + format), figure, format);
}

std::string write_figure(const ResultFolder& folder, const Figure& figure,
                         const std::string& format, std::chrono::milliseconds limit) {
  const std::string image = figure.name + "." + format;
  folder.remove_older({image});
  const std::string data = figure_data(figure);
  limit += std::chrono::milliseconds(data.size() / 1000);
  folder.write(figure.name + ".dat", data);
  folder.write(figure.name + ".gp", figure_script(figure, format));
  // The picture comes to us: a full disk is ours to notice, and the file is whole or absent.
  const GnuplotRun drawn = run_gnuplot(folder.path(), script_to("", figure, format), limit);
  if (!drawn.failure.empty()) return drawn.failure;
  if (!is_whole(drawn.output, format)) return "gnuplot drew no whole picture";
  folder.write(image, drawn.output);
  return {};
}

std::string draw(const ResultFolder& folder, const std::vector<Figure>& figures,
                 const std::vector<std::string>& formats) {
  std::string drawn;
  for (const Figure& figure : figures)
    for (const std::string& format : formats) {
      const std::string failure = write_figure(folder, figure, format);
      if (!failure.empty())
        return drawn + " (no " + figure.name + "." + format + ": " + failure + ")";
      drawn += " " + figure.name + "." + format;
    }
  return drawn;
}

std::vector<std::string> files_of(const std::string& figure) {
  return {figure + ".dat", figure + ".gp", figure + ".svg", figure + ".png", figure + ".pdf"};
}

}  // namespace talus::io
