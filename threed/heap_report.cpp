#include "threed/heap_report.hpp"

#include "common/mixed/extrusion.hpp"
#include "common/program/grid.hpp"
#include "common/program/model_choice.hpp"
#include "common/program/summary.hpp"
#include "twod/section_report.hpp"

namespace talus::threed {

nlohmann::json summary(const HeapSolution& solution, const shear::CrossSection<2>& section_space) {
  nlohmann::json all = twod::summary(solution.middle, section_space);
  if (solve::is_success(solution.middle.end)) {
    all["results"]["cross_flow"] = solution.cross_flow;
    all["results"]["dynamic_pressure"] = solution.dynamic_pressure;
    all["results"]["change_along"] = solution.change_along;
  }
  all["meshes"] = nlohmann::json::array();
  int factorisations = 0;
  for (const MeshCost& cost : solution.meshes) {
    factorisations += cost.factorisations;
    all["meshes"].push_back(
        {{"elements", {cost.mesh.along, cost.mesh.section.across, cost.mesh.section.up}},
         {"status", solve::name_of(cost.end)},
         {"iterations", cost.iterations},
         {"factorisations", cost.factorisations},
         {"unknowns", cost.unknowns},
         {"condensed_unknowns", cost.condensed},
         {"factor_entries", cost.factor_entries},
         {"seconds", cost.seconds}});
  }
  all["factorisations"] = factorisations;
  all["unknowns"] = solution.flow->space().size();
  return all;
}

io::Grid<3> grid(const HeapSolution& solution) {
  const HeapFlow& heap = *solution.flow;
  const auto& space = heap.space();
  io::Grid<3> grid = program::grid_of<3>(space.mesh(), {0, 1, 2});
  const Eigen::VectorXd& state = solution.state.value();
  grid.point_fields = {{"velocity", {state.begin(), state.begin() + space.velocity_count()}, 3}};
  io::Field rate{"shear_rate", {}}, inertial{"inertial_number", {}}, pressure{"pressure", {}},
      dynamic{"dynamic_pressure", {}}, stress{"stress", {}}, yield{"stress_over_yield_stress", {}};
  const auto rule = fem::gauss_rule<3>(3);
  const rheology::FrictionLaw& law = heap.heap().section.law;
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    double rates = 0, pressures = 0, dynamics = 0, stresses = 0;  // means over the points
    for (const auto& point : rule) {
      const mixed::FlowPoint<3> at = heap.point_at(solution.state, e, point.position);
      const double share = 1 / static_cast<double>(rule.size());
      rates += share * at.law.shear_rate;
      pressures += share * at.law.total_pressure;
      dynamics += share * at.values.pressure;
      stresses += share * at.law.stress();
    }
    rate.values.push_back(rates);
    pressure.values.push_back(pressures);
    dynamic.values.push_back(dynamics);
    stress.values.push_back(stresses);
    inertial.values.push_back(law.inertial_number(rates, pressures));
    yield.values.push_back(stresses / (law.mu_s * pressures));
  }
  grid.cell_fields = {rate, inertial, pressure, dynamic, stress, yield};
  return grid;
}

io::Figure figure(const HeapSolution& solution, const shear::CrossSection<2>& section_space) {
  io::Figure figure = twod::figure(solution.middle, section_space);
  figure.name = "heap";
  figure.caption = "heap in three dimensions, the section at half its length at Q* = " +
                   io::rounded(twod::flow_rate(solution.middle, section_space), 6);
  return figure;
}

void add_comparison(nlohmann::json& summary, const HeapSolution& solution,
                    const twod::SectionSolution& section) {
  summary["results"]["departure_from_section"] =
      mixed::departure(solution.flow->space(), solution.state, section.velocity, 1).velocity;
  summary["section_seconds"] = section.seconds;
}

std::string comparison_lines(const HeapSolution& solution, const twod::SectionSolution* section) {
  const std::string lines =
      "cross-flow " + io::rounded(solution.cross_flow, 2) + ", dynamic pressure " +
      io::rounded(solution.dynamic_pressure, 2) + "\n" +
      program::hint_of_poorer_model("heap", "space", "its cross-section", "--model section") + "\n";
  if (!section) return lines;
  // A clock may tick more slowly than a small section is solved.
  const std::string times =
      section->seconds > 0
          ? ", " + io::rounded(solution.middle.seconds / section->seconds, 2) + " times that"
          : "";
  return lines + "the section took " + io::rounded(section->seconds, 2) + " s; space " +
         io::rounded(solution.middle.seconds, 2) + " s more" + times + "\n";
}

std::string mesh_lines(const HeapSolution& solution) {
  std::string lines;
  for (const MeshCost& cost : solution.meshes)
    lines += std::to_string(cost.mesh.along) + "x" + std::to_string(cost.mesh.section.across) +
             "x" + std::to_string(cost.mesh.section.up) +
             " elements: " + std::to_string(cost.factorisations) + " factorisations, " +
             io::rounded(cost.seconds, 3) + " s\n";
  return lines;
}

}  // namespace talus::threed
