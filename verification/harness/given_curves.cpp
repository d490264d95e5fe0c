#include "verification/harness/given_curves.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "common/io/options.hpp"

namespace talus::verification {
namespace {

const std::string header = "figure,panel,curve,x,y";

// Of lines that carry something, without what Windows and spreadsheets add.
bool has_content(std::string& line, bool is_first) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (is_first && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
  return !line.empty() && line.front() != '#';
}

double number_in_field(const std::string& where, const std::string& name, const std::string& text) {
  const double value = io::number_in(text);
  if (!std::isfinite(value))
    throw io::UserError(where + name + ": '" + text + "' is not a finite number");
  return value;
}

// Throws unless the figure and its panel are there.
void refuse_unknown(const std::string& where, const std::string& figure, const std::string& panel,
                    const std::vector<OpenFigure>& figures) {
  const auto found = std::ranges::find(figures, figure, &OpenFigure::number);
  if (found == figures.end()) {
    std::string list;
    for (const OpenFigure& each : figures) list += (list.empty() ? "" : ", ") + each.number;
    throw io::UserError(where + "figure: '" + figure + "' is none of: " + list);
  }
  const auto last = static_cast<std::size_t>(found->panels) - 1;
  for (std::size_t i = 0; i <= last; ++i)
    if (panel == name_of_panel(i)) return;
  throw io::UserError(where + "panel: '" + panel + "' of figure " + figure + " is not in a ... " +
                      name_of_panel(last));
}

GivenCurve& curve_of(std::vector<GivenCurve>& curves, const std::vector<std::string>& fields) {
  for (GivenCurve& each : curves)
    if (each.figure == fields[0] && each.panel == fields[1] && each.curve.label == fields[2])
      return each;
  return curves.emplace_back(fields[0], fields[1], io::Curve{fields[2], {}, {}, io::Style::points});
}

}  // namespace

std::string name_of_panel(std::size_t number) {
  return std::string(1, static_cast<char>('a' + number));
}

std::vector<GivenCurve> read_given_curves(const std::filesystem::path& file,
                                          const std::vector<OpenFigure>& figures) {
  const std::string of_file = "--data: '" + file.string() + "'";
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file))
    throw io::UserError(of_file + " is no file that can be read");
  std::vector<GivenCurve> curves;
  bool has_header = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (!has_content(line, number == 1)) continue;
    const std::string where = of_file + ", line " + std::to_string(number) + ": ";
    if (!has_header) {
      if (line != header) throw io::UserError(where + "the first line must be " + header);
      has_header = true;
      continue;
    }
    const std::vector<std::string> fields = io::split(line, ',');
    if (fields.size() != 5)
      throw io::UserError(where + "it has " + std::to_string(fields.size()) +
                          " fields, not the 5 of " + header);
    refuse_unknown(where, fields[0], fields[1], figures);
    if (fields[2].empty()) throw io::UserError(where + "curve: '' is no name");
    const double x = number_in_field(where, "x", fields[3]);
    const double y = number_in_field(where, "y", fields[4]);
    io::Curve& curve = curve_of(curves, fields).curve;
    curve.x.push_back(x);
    curve.y.push_back(y);
  }
  if (curves.empty()) throw io::UserError(of_file + " holds no point");
  return curves;
}

io::Figure with_given_curves(io::Figure figure, const std::string& number,
                             const std::vector<GivenCurve>& given,
                             const std::vector<Awaited>& awaited) {
  std::size_t drawn = 0, without_place = 0;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    io::Panel& panel = figure.panels[i];
    const std::size_t ours = panel.curves.size();
    for (const GivenCurve& each : given) {
      if (each.figure != number || each.panel != name_of_panel(i)) continue;
      const io::Curve& curve = panel.curves.emplace_back(each.curve);
      for (std::size_t k = 0; k < curve.x.size(); ++k) {
        ++drawn;
        if ((panel.log_x && curve.x[k] <= 0) || (panel.log_y && curve.y[k] <= 0)) ++without_place;
      }
    }
    if (panel.curves.size() > ours) continue;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();  // an entry of the key alone
    for (const Awaited& each : awaited)
      if (each.panel == name_of_panel(i))
        panel.curves.push_back({each.label, {nan}, {nan}, io::Style::rings});
  }
  if (drawn > 0) figure.caption += " Points given with --data: " + std::to_string(drawn) + ".";
  if (without_place > 0)
    figure.caption +=
        " Without a place on a logarithmic axis: " + std::to_string(without_place) + ".";
  return figure;
}

}  // namespace talus::verification
