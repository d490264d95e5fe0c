#include <algorithm>
#include <cmath>

#include "verification/study/kinds.hpp"

namespace talus::study {

std::vector<const Row*> pareto_front(const std::vector<const Row*>& rows, const std::string& first,
                                     const std::string& second) {
  std::vector<const Row*> sorted;
  for (const Row* row : rows)
    if (row->number(first) > 0 && row->number(second) > 0) sorted.push_back(row);
  std::ranges::sort(sorted, [&](const Row* a, const Row* b) {
    return std::pair(a->number(first), a->number(second)) <
           std::pair(b->number(first), b->number(second));
  });
  std::vector<const Row*> front;
  for (const Row* row : sorted)
    if (front.empty() || row->number(second) < front.back()->number(second)) front.push_back(row);
  return front;
}

Findings cost(Table& table) {
  constexpr const char* time = "cpu_seconds";
  Findings found;
  const auto of_problem =
      table.program.description.at("problem_options").get<std::vector<std::string>>();
  const auto errors = errors_to_show(table, of_problem);
  const auto curves = curves_of(table, {table.mesh_option()});
  io::Figure figure{"cost", "", {}, static_cast<int>(std::min<std::size_t>(errors.size(), 2))};
  for (const std::string& error : errors) {
    io::Panel panel{table.title_of(error), "CPU seconds", table.unit_of(error), true, true, {}};
    for (const Curve& curve : curves) {
      io::Curve drawn{curve.label, {}, {}};
      for (const Row* row : curve.rows) {
        if (!(row->number(time) > 0) || !(row->number(error) > 0)) continue;
        drawn.x.push_back(row->number(time));
        drawn.y.push_back(row->number(error));
        drawn.commands.push_back(row->record.at("command"));
      }
      panel.curves.push_back(drawn);
    }
    io::Curve rings{"on the front", {}, {}, io::Style::rings};
    io::Table front{"the front of " + error + ": no other case is both faster and better",
                    {"error", "CPU s", "curve", table.mesh_option().substr(2), "command"},
                    {}};
    for (const Row* row : pareto_front(all_rows(table), time, error)) {
      const auto curve = std::ranges::find_if(curves, [&](const Curve& each) {
        return std::ranges::find(each.rows, row) != each.rows.end();
      });
      rings.x.push_back(row->number(time));
      rings.y.push_back(row->number(error));
      rings.commands.push_back(row->record.at("command"));
      front.rows.push_back({io::rounded(row->number(error), 3), io::rounded(row->number(time), 3),
                            curve->label, row->option(table.mesh_option()),
                            row->record.at("command")});
      if (error == errors.front()) found.front.emplace_back(curve->label, row);
    }
    panel.curves.push_back(rings);
    figure.panels.push_back(panel);
    found.chapter.table(front);
  }
  figure.caption = "Error against CPU time of " + table.program.name() +
                   ". Rings: no other case is both faster and better.";
  found.chapter.blocks.insert(found.chapter.blocks.begin(), figure);
  return found;
}

}  // namespace talus::study
