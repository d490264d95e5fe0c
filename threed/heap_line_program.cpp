#include <cmath>

#include "oned/heap_line.hpp"
#include "threed/heap_program.hpp"
#include "threed/unidirectional_program.hpp"

namespace talus::threed {
namespace {

oned::HeapLine heap_line_of(const ProgramOptions& options) {
  return {.angle = options.section.angle,
          .width = options.section.width,
          .height = options.section.height,
          .wall_friction = options.wall_friction,
          .law = options.section.law,
          .regularisation = program::limiting_law(options.method)};
}

UnidirectionalProgram line_program_of(const ProgramOptions& options) {
  UnidirectionalProgram program;
  program.mesh = {.elements = options.mesh.section.up,
                  .grading = options.mesh.section.grading_to_surface};
  program.method = options.method;
  program.output = options.output;
  program.plot = options.plot;
  program.check_jacobian = options.check_jacobian;
  return program;
}

// Under the names that a section has for them.
nlohmann::json as_json(const oned::LayerMeasures& layer, double angle) {
  return {{"flow_rate", layer.flow_rate},
          {"angle", angle},
          {"surface_velocity", layer.surface_velocity},
          {"depth_1_percent", layer.depth_1},
          {"depth_5_percent", layer.depth_5},
          {"depth_yield", layer.depth_yield},
          {"slip_at_surface", layer.surface_velocity},
          {"yielded_share", layer.yielded_share}};
}

// What the line leaves out, measured: the flow rate of the cross-section on few elements.
std::string comparison_with_section(const ProgramOptions& options, double flow_rate) {
  const twod::SectionMesh few{18, 25, 2, 1.5};
  auto space = twod::space_of(options.section, few);
  const auto section = twod::solve(options.section, space, twod::default_options());
  if (!solve::is_success(section.end) || section.interior_point.at_rest) return "";
  const double other = twod::flow_rate(section, space);
  return "The cross-section, on 18x25 elements, has Q* = " + io::rounded(other, 4) +
         ": averaged over the width it is off by " +
         io::rounded(100 * std::abs(flow_rate / other - 1), 2) +
         "%. For the walls take --model section.\n";
}

}  // namespace

int run_on_line(const io::CommandLine& line, const ProgramOptions& options,
                const std::vector<std::string>& other_files, scene::Case& a_case) {
  const oned::HeapLine heap = heap_line_of(options);
  const oned::ShearScene scene = scene_of(heap);
  const OwnOfScene own{.parameters = {{"angle", heap.angle},
                                      {"width", heap.width},
                                      {"height", heap.height},
                                      {"wall_friction", heap.wall_friction}},
                       .measures =
                           [&](const oned::Solution& solution) {
                             nlohmann::json all = as_json(measures(solution, scene), heap.angle);
                             all["exact_flow_rate"] = exact_flow_rate(heap);
                             return all;
                           },
                       .remarks =
                           [&](const nlohmann::json& results) {
                             return "flow rate Q* = " + io::rounded(results["flow_rate"], 10) +
                                    " (exact on a line " +
                                    io::rounded(results["exact_flow_rate"], 10) + ")\n" +
                                    comparison_with_section(options, results["flow_rate"]);
                           },
                       .other_files = other_files};
  return run(line, scene, line_program_of(options), own, a_case);
}

}  // namespace talus::threed
