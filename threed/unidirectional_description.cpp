#include <algorithm>
#include <iterator>

#include "threed/unidirectional_program.hpp"

namespace talus::threed {

std::vector<scene::Quantity> quantities_of_line() {
  return {{"max_velocity", "sqrt(gd)", "largest velocity at the nodes"},
          {"exact_max_velocity", "sqrt(gd)", "largest exact velocity"},
          {"error_l2", "d sqrt(g)", "error of the velocity in L2"},
          {"error_max", "sqrt(gd)", "error of the velocity in the maximum norm"},
          {"error_nodal_max", "sqrt(gd)", "largest error of the velocity at a node"},
          {"error_paper_rms", "sqrt(gd)", "the paper's RMS: 1/N times the root of the sum"},
          {"error_shear_rate_l2", "sqrt(g)", "error of the shear rate in L2"},
          {"error_shear_rate_max", "sqrt(g/d)", "error of the shear rate, maximum norm"},
          {"error_stress_l2", "φρgd sqrt(d)", "error of the shear stress in L2"},
          {"error_stress_max", "φρgd", "error of the shear stress, maximum norm"}};
}

scene::Description description_of(const oned::ShearScene& scene,
                                  const std::vector<std::string>& problem_options) {
  std::vector<scene::Quantity> quantities = quantities_of_line();
  std::ranges::copy(
      std::vector<scene::Quantity>{
          {"cross_flow", "sqrt(gd)", "largest velocity across the stream"},
          {"dynamic_pressure", "1", "largest dynamic pressure, over the static one"},
          {"change_along", "1", "largest change of the velocity along the stream, relative"}},
      std::back_inserter(quantities));
  return {.name = scene.name,
          .title = scene.title,
          .models = {"line", "plane", "space"},
          .mesh_option = "--elements",
          .problem_options = problem_options,
          .main_quantity = "max_velocity",
          .main_error = "error_l2",
          .quantities = quantities};
}

}  // namespace talus::threed
