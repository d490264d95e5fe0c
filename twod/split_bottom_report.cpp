#include "twod/split_bottom_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "common/program/summary.hpp"
#include "twod/least_resistance.hpp"

namespace talus::twod {
namespace {

std::optional<ZoneCurve> curve_of(double height) {
  try {
    return least_resistance(height);
  } catch (const std::domain_error&) {
    return {};
  }
}

double radius_at(const std::optional<ZoneCurve>& curve, double depth) {
  if (!curve) return std::numeric_limits<double>::quiet_NaN();
  const auto& [h, r, radius, integral] = *curve;
  const auto after = std::ranges::upper_bound(h, depth);
  if (after == h.begin()) return r.front();
  if (after == h.end()) return r.back();
  const auto i = static_cast<std::size_t>(after - h.begin());
  return std::lerp(r[i - 1], r[i], (depth - h[i - 1]) / (h[i] - h[i - 1]));
}

// Only numbers belong into results.
void add(nlohmann::json& results, const char* name, double value) {
  if (std::isfinite(value)) results[name] = value;
}

}  // namespace

const scene::Description& split_bottom_description() {
  static const scene::Description cell{
      .name = "split-bottom",
      .title = "slow flow in a cell whose bottom is split",
      .models = {"section"},
      .mesh_option = "--elements",
      .problem_options = {"--height", "--outer-radius", "--rate", "--friction"},
      .main_quantity = "torque_integral",
      .quantities = {
          {"zone_radius", "Rs", "where the surface turns with half of the rate"},
          {"zone_width", "Rs", "W of the error function between 16% and 84% at the surface"},
          {"torque_integral", "Rs^4", "torque over 2π μs φρg"},
          {"energy", "Rs^4", "energy over 2π μs φρg Ω"},
          {"turning_centre", "1", "angular velocity over Ω in the middle of the surface"},
          {"least_resistance_radius", "Rs", "zone_radius of the curve of least resistance"},
          {"least_resistance_integral", "Rs^4", "torque_integral of that curve"}}};
  return cell;
}

nlohmann::json summary(const SplitBottomSolution& solution, const shear::CrossSection<2>& space) {
  nlohmann::json all;
  program::add_outcome(all, solution);
  nlohmann::json& results = all["results"] = nlohmann::json::object();
  if (!solve::is_success(solution.end)) return all;
  const Zone zone = zone_of(solution, space);
  add(results, "zone_radius", zone.centre.back());
  add(results, "zone_width", zone.width.back());
  add(results, "torque_integral", torque_integral(solution, space));
  add(results, "energy", energy(solution, space));
  const io::Table surface = surface_table(solution, space);
  add(results, "turning_centre", io::number_in(surface.rows.front()[1]));
  if (const auto curve = curve_of(solution.cell.height)) {
    add(results, "least_resistance_radius", curve->surface_radius);
    add(results, "least_resistance_integral", curve->integral);
  }
  return all;
}

io::Table zone_table(const SplitBottomSolution& solution, const shear::CrossSection<2>& space) {
  const Zone zone = zone_of(solution, space);
  const auto curve = curve_of(solution.cell.height);
  io::Table table{"", {"z", "centre", "width", "least_resistance"}, {}};
  for (std::size_t i = 0; i < zone.height.size(); ++i)
    table.rows.push_back({io::exact(zone.height[i]), io::exact(zone.centre[i]),
                          io::exact(zone.width[i]),
                          io::exact(radius_at(curve, solution.cell.height - zone.height[i]))});
  return table;
}

io::Table surface_table(const SplitBottomSolution& solution, const shear::CrossSection<2>& space) {
  io::Table table{"", {"r", "angular_velocity"}, {}};
  const auto& nodes = space.mesh().nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i][1] == solution.cell.height)
      table.rows.push_back({io::exact(nodes[i][0]),
                            io::exact(solution.velocity.value()[static_cast<Eigen::Index>(i)] /
                                      solution.cell.rate)});
  return table;
}

io::Figure figure(const SplitBottomSolution& solution, const shear::CrossSection<2>& space) {
  const auto numbers = [](const io::Table& table, std::size_t column) {
    std::vector<double> values;
    for (const auto& row : table.rows) values.push_back(io::number_in(row[column]));
    return values;
  };
  const io::Table zone = zone_table(solution, space), surface = surface_table(solution, space);
  io::Panel in_cell{"shear zone", "r / Rs", "z / Rs", false, false, {}};
  in_cell.curves = {{"ω = Ω/2", numbers(zone, 1), numbers(zone, 0), io::Style::points}};
  if (curve_of(solution.cell.height))
    in_cell.curves.push_back(
        {"least resistance", numbers(zone, 3), numbers(zone, 0), io::Style::line});
  io::Panel at_surface{"surface", "r / Rs", "ω / Ω", false, false, {}};
  at_surface.curves = {{"", numbers(surface, 0), numbers(surface, 1), io::Style::line}};
  return {"zone",
          "split-bottom cell, H = " + io::rounded(solution.cell.height) + " Rs",
          {in_cell, at_surface},
          2};
}

}  // namespace talus::twod
