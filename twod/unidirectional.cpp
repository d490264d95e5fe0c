#include "twod/unidirectional.hpp"

#include <algorithm>
#include <cmath>

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
  const auto nodes = static_cast<Eigen::Index>(space.mesh().nodes.size());
  const Eigen::Index nodes_along = nodes / velocity.size();  // the first coordinate runs fastest
  Departure farthest;
  for (Eigen::Index node = 0; node < nodes; ++node) {
    const double u = state.value()[space.velocity_index(node, 0)];
    const double v = state.value()[space.velocity_index(node, 1)];
    farthest.velocity =
        std::max(farthest.velocity, std::abs(u - velocity.value()[node / nodes_along]));
    farthest.cross_flow = std::max(farthest.cross_flow, std::abs(v));
  }
  double largest_pressure = 0;
  for (const auto& position : space.mesh().nodes)
    largest_pressure = std::max(largest_pressure, flow.scene.pressure(position[1]));
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : flow::gauss_rule<2>(3))
      farthest.pressure =
          std::max(farthest.pressure, std::abs(space.values_at(state, e, point.position).pressure));
  const double largest = velocity.value().lpNorm<Eigen::Infinity>();
  return {farthest.velocity / largest, farthest.cross_flow / largest,
          farthest.pressure / largest_pressure};
}

}  // namespace talus::twod
