#include "common/io/figure.hpp"

#include <algorithm>
#include <cmath>

#include "common/io/gnuplot.hpp"
#include "common/io/svg.hpp"
#include "common/io/table.hpp"

namespace talus::io {
namespace {

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

// A block for each part: middle, row, start, end, count. Rows go down, shares are in percent.
std::string data_of(const Panel& panel, const Bars& bars) {
  std::vector<double> sums(bars.rows.size(), 0), ends = sums;
  for (const auto& counts : bars.counts)
    for (std::size_t row = 0; row < sums.size(); ++row) sums[row] += counts[row];
  std::string data;
  for (std::size_t part = 0; part < bars.parts.size(); ++part) {
    data += "# " + panel.title + ": " + bars.parts[part] + "\n# middle row start end count\n";
    for (std::size_t row = 0; row < sums.size(); ++row) {
      const double count = bars.counts[part][row], start = ends[row];
      ends[row] += sums[row] > 0 ? 100 * count / sums[row] : 0;
      data += exact((start + ends[row]) / 2) + " -" + std::to_string(row) + " " + exact(start) +
              " " + exact(ends[row]) + " " + exact(count) + "\n";
    }
    data += "\n\n";
  }
  return data;
}

// Right-angled, under a stretch of the way from the first point of the curve to the last.
Curve triangle_of(const Curve& curve) {
  constexpr double from = 0.6, to = 0.85;
  const auto at = [&](double share, const std::vector<double>& values) {
    return std::pow(values.front(), 1 - share) * std::pow(values.back(), share);
  };
  const double left = std::min(at(from, curve.x), at(to, curve.x));
  const double right = std::max(at(from, curve.x), at(to, curve.x));
  const bool is_rising = (curve.x.back() > curve.x.front()) == (curve.y.back() > curve.y.front());
  const double low = std::min(at(from, curve.y), at(to, curve.y));
  const double high = std::max(at(from, curve.y), at(to, curve.y));
  const double corner = is_rising ? right : left;
  return {curve.label, {left, right, corner, is_rising ? left : right}, {low, low, high, low}};
}

}  // namespace

std::string figure_data(const Figure& figure) {
  std::string data;
  for (const Panel& panel : figure.panels) {
    if (panel.field) {
      data += field_data(*panel.field, panel.title);
      continue;
    }
    if (panel.bars) {
      data += data_of(panel, *panel.bars);
      continue;
    }
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
      const Curve shown =
          curve.style == Style::slope && !curve.x.empty() ? triangle_of(curve) : curve;
      for (std::size_t i = 0; i < shown.x.size(); ++i)
        data += exact(shown.x[i]) + " " + exact(shown.y[i]) + "\n";
      data += "\n\n";
    }
  }
  return data;
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
  const GnuplotRun drawn = run_gnuplot(folder.path(), figure_script(figure, format, true), limit);
  if (!drawn.failure.empty()) return drawn.failure;
  if (!is_whole(drawn.output, format)) return "gnuplot drew no whole picture";
  folder.write(image, drawn.output);
  return {};
}

std::string panel_file(const Figure& figure, std::size_t number) {
  return figure.name + (figure.panels.size() == 1 ? "" : "_" + std::to_string(number + 1)) + ".svg";
}

std::string write_panels(const ResultFolder& folder, const Figure& figure,
                         std::chrono::milliseconds limit) {
  for (std::size_t i = 0; i < figure.panels.size(); ++i)
    folder.remove_older({panel_file(figure, i)});
  const std::string data = figure_data(figure);
  limit += std::chrono::milliseconds(data.size() / 1000);
  folder.write(figure.name + ".dat", data);
  folder.write(figure.name + ".gp", figure_script(figure, "svg"));
  const GnuplotRun drawn = run_gnuplot(folder.path(), panels_script(figure), limit);
  if (!drawn.failure.empty()) return drawn.failure;
  std::vector<std::string> images;
  constexpr const char* start = "<?xml";
  for (std::size_t at = drawn.output.find(start); at != std::string::npos;) {
    const std::size_t next = drawn.output.find(start, at + 1);
    images.push_back(drawn.output.substr(at, next - at));
    at = next;
  }
  if (images.size() != figure.panels.size() ||
      !std::ranges::all_of(images, [](const auto& image) { return is_whole(image, "svg"); }))
    return "gnuplot drew no whole picture";
  for (std::size_t i = 0; i < images.size(); ++i)
    folder.write(panel_file(figure, i), without_padding(images[i], svg_font()));
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
  return {figure + ".dat", figure + ".gp",  figure + ".svg",
          figure + ".png", figure + ".pdf", figure + "_[0-9]*.svg"};
}

}  // namespace talus::io
