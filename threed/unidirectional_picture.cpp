// The fields of chute and inclined plane as a picture.
#include <algorithm>

#include "threed/unidirectional_program.hpp"

namespace talus::threed {

template <int Dim>
io::Figure picture(const oned::ShearScene& scene, const UnidirectionalSolution<Dim>& solution,
                   const UnidirectionalOptions& options, const program::PictureOptions& picture) {
  const auto flow = problem_of<Dim>(scene, *solution.space, options);
  const std::string title = scene.title + ", " + (Dim == 2 ? "plane, " : "space, ") +
                            std::to_string(solution.space->element_count() / thinnest<Dim>.along) +
                            " elements across, " + rheology::name_of(options.regularisation) +
                            ", λr = " + io::rounded(options.lambda_r);
  const program::PictureLabels labels{
      .name = "fields",
      .title = title,
      .caption = title + ". A thin piece of the flow, stretched along the stream (to the right).",
      .x = "along the stream / d",
      .y = scene.coordinate + " / d",
      .velocity = "sqrt(gd)",
      .pressure = "φρgd",
      .rate = "sqrt(g/d)",
      .viscosity = "φρd sqrt(gd)",
      .equal_axes = false};
  if constexpr (Dim == 2) {
    return program::picture(program::surface_of(flow, solution.state), scene.law(), labels,
                            picture);
  } else {
    double width = 0;
    for (const auto& node : solution.space->mesh().nodes) width = std::max(width, node[1]);
    const auto view = program::view_of(flow, solution.state);
    return program::picture(program::cut_of(view, 1, 0.5 * width), scene.law(), labels, picture);
  }
}

#define TALUS_FOR(Dim)                                                                     \
  template io::Figure picture(const oned::ShearScene&, const UnidirectionalSolution<Dim>&, \
                              const UnidirectionalOptions&, const program::PictureOptions&);
TALUS_FOR(2)
TALUS_FOR(3)
#undef TALUS_FOR

}  // namespace talus::threed
