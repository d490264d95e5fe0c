#include "twod/unidirectional.hpp"

#include <algorithm>

#include "common/fem/line_mesh.hpp"

namespace talus::twod {

Unidirectional in_the_plane(const oned::Chute& chute) {
  return {oned::scene_of(chute),
          {{"left", flow::fully_developed<2>(0)},
           {"right", flow::fully_developed<2>(0)},
           {"bottom", flow::symmetry<2>(1)},
           {"top", flow::no_slip<2>()}}};
}

Unidirectional in_the_plane(const oned::Bagnold& bagnold) {
  return {oned::scene_of(bagnold),
          {{"left", flow::fully_developed<2>(0)},
           {"right", flow::fully_developed<2>(0)},
           {"bottom", flow::no_slip<2>()},
           {"top", {}}}};
}

flow::DenseSpace<2> space_of(const Unidirectional& flow, std::span<const double> across,
                             int along) {
  const double element = flow.scene.length / static_cast<double>(across.size() - 1);
  const auto stream = fem::graded_line(0, along * element, along, 1);
  return {flow::tensor_mesh<2>({stream, across}), flow.conditions};
}

flow::DenseLoad<2> load_of(const Unidirectional& flow) {
  using flow::Point;
  return {[&scene = flow.scene](const Point<2>& x) { return scene.pressure(x[1]); },
          [&scene = flow.scene](const Point<2>&) { return Point<2>(scene.body_force, 0); }};
}

Departure departure(const Unidirectional& flow, const flow::DenseSpace<2>& space,
                    const solve::CompensatedVector& state,
                    const solve::CompensatedVector& velocity) {
  double largest_pressure = 0;
  for (const auto& position : space.mesh().nodes)
    largest_pressure = std::max(largest_pressure, flow.scene.pressure(position[1]));
  return flow::departure(space, state, velocity, largest_pressure);
}

}  // namespace talus::twod
