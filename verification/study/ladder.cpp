#include <algorithm>
#include <cmath>

#include "common/program/model_choice.hpp"
#include "verification/study/kinds.hpp"

namespace talus::study {
namespace {

std::vector<std::string> compared_quantities(const Table& table) {
  if (!table.quantities.empty()) return table.quantities;
  return {table.program.description.at("main_quantity")};
}

double apart(const Row& row, const Row& poorest, const std::vector<std::string>& quantities) {
  double largest = 0;
  for (const std::string& quantity : quantities) {
    const double a = row.number(quantity), b = poorest.number(quantity);
    const double each = std::abs(a - b) / (b == 0 ? 1 : std::abs(b));
    if (!(each <= largest)) largest = each;  // keeps a NaN
    if (std::isnan(each)) return each;
  }
  return largest;
}

}  // namespace

Findings ladder(Table& table) {
  constexpr const char* model = "--model";
  const auto quantities = compared_quantities(table);
  Findings found;
  io::Table rungs{"the models, poorest first",
                  {"curve", "model", "end", "apart from the poorest", "iterations", "unknowns",
                   "CPU s", "times", "memory, MB"},
                  {}};
  io::Panel panel{"what a model costs", "unknowns", "CPU seconds", true, true, {}};
  for (const Curve& curve : curves_of(table, {model})) {
    const Row& poorest = *curve.rows.front();
    std::vector<program::RicherModel> richer;
    for (const Row* row : curve.rows) {
      const double distance = apart(*row, poorest, quantities);
      const double times = row->number("cpu_seconds") / poorest.number("cpu_seconds");
      const double memory = row->number("peak_memory") / poorest.number("peak_memory");
      if (row != &poorest) richer.push_back({row->option(model), distance, times, memory});
      rungs.rows.push_back(
          {curve.label, row->option(model), row->status(),
           row == &poorest ? "" : io::rounded(distance, 2), io::rounded(row->number("iterations")),
           io::rounded(row->number("unknowns"), 7), io::rounded(row->number("cpu_seconds"), 3),
           io::rounded(times, 3), io::rounded(row->number("peak_memory"), 3)});
      if (row->number("unknowns") > 0 && row->number("cpu_seconds") > 0) {
        const std::string label =
            (curve.label.empty() ? "" : curve.label + ", ") + row->option(model);
        panel.curves.push_back({label,
                                {row->number("unknowns")},
                                {row->number("cpu_seconds")},
                                io::Style::line_points,
                                {row->record.at("command")}});
      }
    }
    std::string sentence = curve.label.empty() ? "" : curve.label + ": ";
    const bool all_arrive =
        std::ranges::all_of(curve.rows, [](const Row* row) { return row->is_success(); });
    sentence += all_arrive
                    ? program::recommendation(table.program.name(), poorest.option(model), richer)
                    : "no verdict, " + count_of_ends(curve.rows) + ".";
    found.chapter.text(sentence);
  }
  found.chapter.table(rungs);
  found.chapter.figure({"ladder",
                        "CPU time and unknowns of each model of " + table.program.name() + ".",
                        {panel},
                        1});
  return found;
}

}  // namespace talus::study
