#include <algorithm>
#include <cmath>
#include <map>

#include "verification/study/kinds.hpp"

namespace talus::study {
namespace {

// Letters for the ends that cases met, in the order of the alphabet.
std::map<std::string, std::string> letters_of(const Table& table) {
  std::map<std::string, std::string> letters;
  for (const Row& row : table.rows)
    if (!row.is_success()) letters[row.status()];
  char next = 'A';
  for (auto& [status, letter] : letters) letter = std::string(1, next++);
  return letters;
}

io::Map map_of(const std::vector<const Row*>& rows, const Varied& across, const Varied& up,
               const std::map<std::string, std::string>& letters, double largest) {
  io::Map map{across.values, up.values, {}, {}, "factorisations", largest};
  for (const std::string& y : up.values) {
    auto& values = map.values.emplace_back();
    auto& marks = map.marks.emplace_back();
    for (const std::string& x : across.values) {
      const auto found = std::ranges::find_if(rows, [&](const Row* row) {
        return row->option(across.name) == x && (up.name.empty() || row->option(up.name) == y);
      });
      const bool is_there = found != rows.end();
      const bool arrives = is_there && (*found)->is_success();
      values.push_back(arrives ? (*found)->number("factorisations")
                               : std::numeric_limits<double>::quiet_NaN());
      marks.push_back(arrives    ? io::rounded((*found)->number("factorisations"), 4)
                      : is_there ? letters.at((*found)->status())
                                 : "");
    }
  }
  return map;
}

}  // namespace

Findings stability(Table& table) {
  const auto axes = table.axes();
  // The first two that are numbers, or whatever varies.
  std::vector<Varied> by = axes;
  std::ranges::stable_partition(by, is_numeric);
  const Varied across = by.size() > 1 ? by[1] : by[0];
  const Varied up = by.size() > 1 ? by[0] : Varied{"", {""}};
  const auto letters = letters_of(table);
  double largest = 1;
  for (const Row& row : table.rows)
    if (row.is_success()) largest = std::max(largest, row.number("factorisations"));

  Findings found;
  io::Figure figure{"stability", "", {}, 2};
  io::Table ends{"how the cases end", {"curve", "ends"}, {}};
  for (const Curve& curve : curves_of(table, {across.name, up.name})) {
    io::Panel panel{
        curve.label, across.name.substr(2), up.name.empty() ? "" : up.name.substr(2), false, false,
        {}};
    panel.map = map_of(curve.rows, across, up, letters, largest);
    figure.panels.push_back(panel);
    ends.rows.push_back({curve.label.empty() ? "all" : curve.label, count_of_ends(curve.rows)});
  }
  figure.columns = static_cast<int>(std::min<std::size_t>(figure.panels.size(), 2));
  figure.caption = "Factorisations of the cases that arrive";
  figure.caption += letters.empty() ? ": all of them." : "; grey: those that do not.";
  for (const auto& [status, letter] : letters) figure.caption += " " + letter + ": " + status + ".";
  found.chapter.figure(figure);
  found.chapter.table(ends);
  return found;
}

}  // namespace talus::study
