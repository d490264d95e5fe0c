#include "verification/study/case_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "common/io/options.hpp"
#include "common/rheology/regularisation.hpp"

namespace talus::study {
namespace {

using nlohmann::json;

bool is_number(const std::string& text) {
  return std::isfinite(as_number(text));
}

// "grading 2", "barker-gray", "no-inertia".
std::string shown(const Varied& axis, const std::string& value) {
  const std::string name = axis.name.substr(2);
  if (value.empty()) return "no " + name;
  return is_number(value) ? name + " " + value : value;
}

bool any_has(const Table& table, const std::string& quantity) {
  return std::ranges::any_of(table.rows,
                             [&](const Row& row) { return std::isfinite(row.number(quantity)); });
}

double regularisation_of(const Row& row) {
  const json parameters = row.record.value("parameters", json::object());
  return parameters.value("lambda_r", 0.0);  // none by the interior point
}

// A law without a yield stress tends to a flow of its own: another problem.
std::string own_law_of(const Row& row) {
  const auto law = rheology::regularisation_named(row.option("--regularisation"));
  return law && !rheology::has_yield_stress(*law) ? rheology::name_of(*law) : "";
}

// Against the finest of each group; see errors_to_show.
void measure_against_the_finest(Table& table, const std::string& quantity,
                                const std::vector<std::string>& of_problem) {
  std::map<std::string, Row*> finest;
  const auto group_of = [&](const Row& row) {
    std::string group = own_law_of(row);
    for (const std::string& option : of_problem) group += row.option(option) + "\n";
    return group;
  };
  for (Row& row : table.rows) {
    if (!std::isfinite(row.number(quantity))) continue;
    Row*& best = finest[group_of(row)];
    const auto rank = [](const Row& each) {
      return std::pair(each.number("elements"), -regularisation_of(each));
    };
    if (!best || rank(row) > rank(*best)) best = &row;
  }
  std::map<const Row*, double> errors;
  for (const Row& row : table.rows) {
    const auto found = finest.find(group_of(row));
    // On the mesh of the measure itself its own mesh error would not be seen.
    if (found == finest.end() || row.number("elements") == found->second->number("elements"))
      continue;
    const double known = found->second->number(quantity);
    errors[&row] = std::abs(row.number(quantity) - known) / (known == 0 ? 1 : std::abs(known));
  }
  for (Row& row : table.rows)
    if (errors.contains(&row) && std::isfinite(errors[&row]))
      row.record["results"]["error_" + quantity] = errors[&row];
}

}  // namespace

std::vector<Varied> Table::axes() const {
  std::vector<Varied> all;
  std::ranges::copy_if(varied, std::back_inserter(all),
                       [](const Varied& each) { return each.values.size() > 1; });
  return all;
}

std::string Table::title_of(const std::string& quantity) const {
  if (const json* known = program.quantity(quantity)) return known->at("meaning");
  const json* measured = program.quantity(quantity.substr(std::string("error_").size()));
  return measured ? "relative error: " + measured->at("meaning").get<std::string>() : quantity;
}

std::string Table::unit_of(const std::string& quantity) const {
  const json* known = program.quantity(quantity);
  const std::string unit = known ? known->at("unit") : "1";
  return unit == "1" ? "dimensionless" : "in " + unit;
}

std::vector<Curve> curves_of(const Table& table, const std::vector<std::string>& without) {
  std::vector<Curve> curves;
  for (const Row& row : table.rows) {
    std::string label;
    for (const Varied& axis : table.axes())
      if (std::ranges::find(without, axis.name) == without.end() && !row.option(axis.name).empty())
        label += (label.empty() ? "" : ", ") + shown(axis, row.option(axis.name));
    const auto found =
        std::ranges::find_if(curves, [&](const Curve& each) { return each.label == label; });
    if (found == curves.end())
      curves.push_back({label, {&row}});
    else
      found->rows.push_back(&row);
  }
  return curves;
}

double as_number(const std::string& value) {
  double product = 1;
  const bool is_in_degrees = value.ends_with("deg");
  const std::string text = is_in_degrees ? value.substr(0, value.size() - 3) : value;
  for (const std::string& part : io::split(text, 'x')) {
    double each = 0;
    const char* const end = part.data() + part.size();
    const auto [stop, error] = std::from_chars(part.data(), end, each);
    if (error != std::errc() || stop != end) return std::numeric_limits<double>::quiet_NaN();
    product *= each;
  }
  return is_in_degrees ? product * std::numbers::pi / 180 : product;
}

bool is_numeric(const Varied& option) {
  return std::ranges::all_of(option.values, is_number);
}

std::vector<std::string> errors_to_show(Table& table, const std::vector<std::string>& of_problem) {
  const json& description = table.program.description;
  std::vector<std::string> names = table.quantities;
  const std::string main_error = description.at("main_error");
  if (names.empty())
    names = {any_has(table, main_error) ? main_error
                                        : description.at("main_quantity").get<std::string>()};
  for (std::string& name : names) {
    if (name.rfind("error_", 0) == 0) continue;
    if (!any_has(table, "error_" + name)) measure_against_the_finest(table, name, of_problem);
    name = "error_" + name;
  }
  return names;
}

io::Table cases_table(const Table& table) {
  const std::vector<std::string> measured = {"iterations",   "factorisations", "cpu_seconds",
                                             "wall_seconds", "peak_memory",    "elements",
                                             "unknowns",     "element_size"};
  std::set<std::string> results;
  for (const Row& row : table.rows)
    for (const auto& [name, _] : row.record.at("results").items()) results.insert(name);
  io::Table cases{"cases", {}, {}};
  for (const Varied& axis : table.axes()) cases.header.push_back(axis.name.substr(2));
  cases.header.emplace_back("status");
  cases.header.insert(cases.header.end(), measured.begin(), measured.end());
  cases.header.insert(cases.header.end(), results.begin(), results.end());
  cases.header.insert(cases.header.end(), {"case", "command"});
  const auto cell = [](double value) { return std::isfinite(value) ? io::exact(value) : ""; };
  for (const Row& row : table.rows) {
    auto& cells = cases.rows.emplace_back();
    for (const Varied& axis : table.axes()) cells.push_back(row.option(axis.name));
    cells.push_back(row.status());
    for (const std::string& name : measured) cells.push_back(cell(row.number(name)));
    for (const std::string& name : results) cells.push_back(cell(row.number(name)));
    cells.push_back(row.record.value("case", ""));
    cells.push_back(row.record.value("command", ""));
  }
  return cases;
}

std::string count_of_ends(const std::vector<const Row*>& rows) {
  std::map<std::string, int> failures;
  int successes = 0;
  for (const Row* row : rows)
    if (row->is_success())
      ++successes;
    else
      ++failures[row->status()];
  std::string text = std::to_string(successes) + " of " + std::to_string(rows.size()) + " arrive";
  for (const auto& [status, count] : failures)
    text +=
        (status == failures.begin()->first ? "; " : ", ") + std::to_string(count) + " " + status;
  return text;
}

std::vector<const Row*> all_rows(const Table& table) {
  std::vector<const Row*> rows;
  for (const Row& row : table.rows) rows.push_back(&row);
  return rows;
}

}  // namespace talus::study
