// The flow around the cylinder as pictures.
#include "twod/cylinder_report.hpp"

namespace talus::twod {

std::vector<io::Figure> pictures(const CylinderFlow& cylinder, const CylinderFlow::State& state,
                                 const program::PictureOptions& options) {
  const Cylinder& scene = cylinder.scene();
  program::Surface surface = program::surface_of(cylinder.flow(), state);
  surface.is_mirrored = !scene.mesh.full;
  const std::string title = "cylinder, F = " + io::rounded(cylinder.flow().load_factor()) + ", " +
                            rheology::name_of(scene.regularisation) +
                            ", λr = " + io::rounded(cylinder.flow().rheology().lambda_r) + ", " +
                            std::to_string(scene.mesh.around) + " elements around";
  const auto drawn = [&](const std::string& name, const std::string& part,
                         const io::Window& window) {
    const program::PictureLabels labels{.name = name,
                                        .title = title,
                                        .caption = part + " (" + title + "). It flows downwards.",
                                        .x = "x / D",
                                        .y = "z / D",
                                        .velocity = "sqrt(p_ext/φρ)",
                                        .pressure = "p_ext",
                                        .rate = "sqrt(p_ext/φρ)/D",
                                        .viscosity = "D sqrt(p_ext φρ)"};
    return program::picture(surface, scene.law, labels, options, window);
  };
  const io::Figure around = drawn("fields", "Around the cylinder", {{-3.5, -4.5}, {3.5, 3.5}});
  if (!options.window.empty()) return {around};
  return {around, drawn("wake", "Close to the cylinder and in its wake", {{-1, -1.6}, {1, 0.7}})};
}

}  // namespace talus::twod
