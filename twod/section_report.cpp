#include "twod/section_report.hpp"

#include <algorithm>

#include "common/program/flow_view.hpp"
#include "common/program/grid.hpp"
#include "common/program/summary.hpp"

namespace talus::twod {

nlohmann::json summary(const SectionSolution& solution, const shear::CrossSection<2>& space) {
  nlohmann::json all;
  program::add_outcome(all, solution);
  for (const MeshCost& cost : solution.meshes)
    all["meshes"].push_back({{"elements", {cost.mesh.across, cost.mesh.up}},
                             {"status", solve::name_of(cost.end)},
                             {"iterations", cost.iterations},
                             {"seconds", cost.seconds}});
  all["results"] = nlohmann::json::object();
  if (!solve::is_success(solution.end)) return all;
  const SurfaceProfile surface = surface_profile(solution, space);
  all["results"] = {{"flow_rate", flow_rate(solution, space)},
                    {"angle", solution.section.angle},
                    {"surface_velocity", surface.velocity.front()},
                    {"depth_1_percent", surface.depth_1.front()},
                    {"depth_5_percent", surface.depth_5.front()},
                    {"depth_yield", surface.depth_yield.front()},
                    {"slip_at_surface", surface.velocity.back()},
                    {"yielded_share", yielded_share(solution, space)}};
  return all;
}

std::string mesh_lines(const SectionSolution& solution) {
  std::string lines;
  for (const MeshCost& cost : solution.meshes)
    lines += std::to_string(cost.mesh.across) + "x" + std::to_string(cost.mesh.up) +
             " elements: " + std::to_string(cost.iterations) + " iterations, " +
             io::rounded(cost.seconds, 3) + " s\n";
  return lines;
}

io::Table surface_table(const SectionSolution& solution, const shear::CrossSection<2>& space) {
  const SurfaceProfile surface = surface_profile(solution, space);
  io::Table table{"", {"y", "velocity", "depth_1_percent", "depth_5_percent", "depth_yield"}, {}};
  for (std::size_t i = 0; i < surface.y.size(); ++i)
    table.rows.push_back({io::exact(surface.y[i]), io::exact(surface.velocity[i]),
                          io::exact(surface.depth_1[i]), io::exact(surface.depth_5[i]),
                          io::exact(surface.depth_yield[i])});
  return table;
}

io::QuadraticGrid grid(const SectionSolution& solution, const shear::CrossSection<2>& space) {
  const auto& mesh = space.mesh();
  io::QuadraticGrid grid = program::grid_of<2>(mesh, {1, 2});
  const Eigen::VectorXd velocity = solution.velocity.value();
  grid.point_fields = {{"velocity", {velocity.begin(), velocity.end()}}};
  grid.cell_fields = program::cell_means(
      program::view_of(space, solution, load_of(solution.section).pressure, solution.section.law),
      false);
  return grid;
}

io::Panel profiles(const SectionSolution& solution, const shear::CrossSection<2>& space,
                   const std::string& title) {
  io::Panel panel{title, "u / sqrt(gd)", "z / d", false, false, {}};
  const std::vector<double> y = surface_profile(solution, space).y;
  const auto& nodes = space.mesh().nodes;
  for (const double share : {0.0, 0.5, 0.8, 0.95}) {
    const double wanted = share * solution.section.width / 2;
    const auto nearest = std::min_element(y.begin(), y.end(), [&](double left, double right) {
      return std::abs(left - wanted) < std::abs(right - wanted);
    });
    io::Curve curve{"y = " + io::rounded(*nearest, 3), {}, {}, io::Style::line};
    for (auto i = static_cast<std::size_t>(nearest - y.begin()); i < nodes.size(); i += y.size()) {
      curve.x.push_back(solution.velocity.value()[static_cast<Eigen::Index>(i)]);
      curve.y.push_back(nodes[i][1]);
    }
    panel.curves.push_back(curve);
  }
  return panel;
}

io::Figure figure(const SectionSolution& solution, const shear::CrossSection<2>& space) {
  const SurfaceProfile surface = surface_profile(solution, space);
  io::Panel velocity{"velocity at the surface", "y / d", "u / sqrt(gd)", false, false, {}};
  velocity.curves = {{"", surface.y, surface.velocity, io::Style::line}};
  io::Panel depth{"depth of the flowing layer", "y / d", "depth / d", false, false, {}};
  depth.curves = {{"1% of the surface velocity", surface.y, surface.depth_1, io::Style::line},
                  {"5%", surface.y, surface.depth_5, io::Style::line},
                  {"yield criterion", surface.y, surface.depth_yield, io::Style::line}};
  return {"section",
          "heap, cross-section at Q* = " + io::rounded(flow_rate(solution, space), 6),
          {velocity, depth, profiles(solution, space, "velocity below the surface")},
          3};
}

program::PictureLabels picture_labels(const std::string& name, const std::string& title) {
  return {.name = name,
          .title = title,
          .caption = title +
                     ": half of the channel, symmetry on the left, the side wall on the "
                     "right. The velocity points out of the picture.",
          .x = "y / d",
          .y = "z / d",
          .velocity = "sqrt(gd)",
          .pressure = "φρgd",
          .rate = "sqrt(g/d)",
          .viscosity = "φρd sqrt(gd)"};
}

io::Figure picture(const SectionSolution& solution, const shear::CrossSection<2>& space,
                   const rheology::Rheology& rheology, const std::string& title,
                   const program::PictureOptions& options) {
  const auto view = program::view_of(space, solution, load_of(solution.section).pressure, rheology);
  return program::picture(program::surface_of(view), rheology.law,
                          picture_labels("section_fields", title), options);
}

}  // namespace talus::twod
