#include "threed/heap_report.hpp"

#include <algorithm>

#include "common/mixed/extrusion.hpp"
#include "common/program/flow_view.hpp"
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
  grid.cell_fields = program::cell_means(program::view_of(heap.flow(), solution.state), true);
  return grid;
}

io::Figure figure(const HeapSolution& solution, const shear::CrossSection<2>& section_space) {
  io::Figure figure = twod::figure(solution.middle, section_space);
  figure.name = "heap";
  figure.caption = "heap in three dimensions, the section at half its length at Q* = " +
                   io::rounded(twod::flow_rate(solution.middle, section_space), 6);
  return figure;
}

io::Figure picture(const HeapSolution& solution, const std::string& title,
                   const program::PictureOptions& options) {
  const mixed::MixedFlow<3>& flow = solution.flow->flow();
  double length = 0;
  for (const auto& node : flow.space().mesh().nodes) length = std::max(length, node[0]);
  program::PictureLabels labels = twod::picture_labels("heap_fields", title);
  labels.caption += " Cut through space at half the length.";
  return program::picture(program::cut_of(program::view_of(flow, solution.state), 0, 0.5 * length),
                          flow.rheology().law, labels, options);
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
