#include "twod/cylinder_report.hpp"

namespace talus::twod {

const scene::Description& description() {
  static const scene::Description cylinder{
      .name = "cylinder",
      .title = "flow down a channel past a cylinder",
      .models = {"plane"},
      .mesh_option = "--around",
      .problem_options = {"--loading", "--sweep", "--regularisation", "--friction", "--outlet",
                          "--outflow", "--full", "--no-inertia"},
      .main_quantity = "drag",
      .quantities = {
          {"loading", "1", "F = φρgD/p_ext"},
          {"lambda_r", "sqrt(p_ext/(φρ))/D", "regularisation parameter"},
          {"mean_velocity", "sqrt(p_ext/(φρ))", "U, flux through the inlet over its width"},
          {"drag", "p_ext D", "F_D on the cylinder, from the nodal reactions"},
          {"drag_traction", "p_ext D", "F_D from the integral of the traction"},
          {"wall_force", "p_ext D", "friction of the side walls"},
          {"weight", "p_ext D", "weight of the material"},
          {"momentum_flux", "p_ext D", "what the flow carries off"},
          {"min_pressure", "p_ext", "smallest total pressure"},
          {"max_pressure", "p_ext", "largest total pressure"},
          {"largest_velocity", "sqrt(p_ext/(φρ))", "largest velocity"},
          {"divergence", "1", "of the velocity, relative to its gradient"},
          {"projected_divergence", "1", "the same, as far as the pressures can see it"},
          {"yielded_share", "1", "share of the area that yields"},
          {"ill_posed_share", "1", "share of the area that flows and is ill-posed"},
          {"negative_share", "1", "share of the area of negative total pressure"},
          {"imbalance", "1", "of forces, over the weight: 0 in equilibrium"},
          {"drag_coefficient", "1", "F_D/(½ φρ U² D)"}}};
  return cylinder;
}

}  // namespace talus::twod
