#include <algorithm>
#include <cmath>
#include <map>

#include "common/io/options.hpp"
#include "verification/study/kinds.hpp"

namespace talus::study {

Varied axis_of_sweep(const Table& table) {
  for (const Varied& axis : table.axes())
    if (is_numeric(axis)) return axis;
  throw io::UserError("sweep: no option has several numbers to be swept along");
}

Findings sweep(Table& table) {
  const Varied along = axis_of_sweep(table);
  std::vector<std::string> quantities = table.quantities;
  if (quantities.empty()) quantities = {table.program.description.at("main_quantity")};
  const auto curves = curves_of(table, {along.name});
  Findings found;
  io::Figure figure{"sweep", "", {}, static_cast<int>(std::min<std::size_t>(quantities.size(), 2))};
  for (const std::string& quantity : quantities) {
    io::Panel panel{
        table.title_of(quantity), along.name.substr(2), table.unit_of(quantity), false, false, {}};
    std::map<std::string, io::Curve> failures;
    double lowest = std::numeric_limits<double>::infinity();
    for (const Row& row : table.rows)
      if (row.is_success()) lowest = std::min(lowest, row.number(quantity));
    for (const Curve& curve : curves) {
      io::Curve drawn{curve.label, {}, {}};
      for (const Row* row : curve.rows) {
        const double x = as_number(row->option(along.name)), y = row->number(quantity);
        if (row->is_success() && std::isfinite(y)) {
          drawn.x.push_back(x);
          drawn.y.push_back(y);
          drawn.commands.push_back(row->record.at("command"));
        } else if (!row->is_success() && std::isfinite(lowest)) {
          io::Curve& mark = failures[row->status()];
          mark.label = row->status();
          std::ranges::replace(mark.label, '_', ' ');
          mark.style = io::Style::rings;
          mark.x.push_back(x);
          mark.y.push_back(lowest);
          mark.commands.push_back(row->record.at("command"));
        }
      }
      panel.curves.push_back(drawn);
    }
    for (const auto& [_, mark] : failures) panel.curves.push_back(mark);
    figure.panels.push_back(panel);
  }
  figure.caption = "Along " + along.name + ": " + count_of_ends(all_rows(table)) +
                   ". Cases that did not arrive are marked on the lower edge.";
  found.chapter.figure(figure);
  return found;
}

}  // namespace talus::study
