#include "common/mixed/extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::mixed {
namespace {

// The first axis is numbered fastest.
template <int Dim>
Eigen::Index nodes_along(const MixedSpace<Dim>& space, const solve::CompensatedVector& velocity) {
  return static_cast<Eigen::Index>(space.mesh().nodes.size()) / velocity.size();
}

}  // namespace

template <int Dim>
typename MixedSpace<Dim>::State extruded(const MixedSpace<Dim>& space,
                                         const solve::CompensatedVector& velocity) {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(space.size()), correction = value;
  const Eigen::Index along = nodes_along(space, velocity);
  for (Eigen::Index node = 0; node < along * velocity.size(); ++node) {
    value[space.velocity_index(node, 0)] = velocity.value()[node / along];
    correction[space.velocity_index(node, 0)] = velocity.correction()[node / along];
  }
  return {std::move(value), std::move(correction)};
}

template <int Dim>
Departure departure(const MixedSpace<Dim>& space, const solve::CompensatedVector& state,
                    const solve::CompensatedVector& velocity, double largest_pressure) {
  const Eigen::Index along = nodes_along(space, velocity);
  Departure farthest;
  for (Eigen::Index node = 0; node < along * velocity.size(); ++node) {
    const double u = state.value()[space.velocity_index(node, 0)];
    farthest.velocity = std::max(farthest.velocity, std::abs(u - velocity.value()[node / along]));
    for (int i = 1; i < Dim; ++i)
      farthest.cross_flow =
          std::max(farthest.cross_flow, std::abs(state.value()[space.velocity_index(node, i)]));
  }
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : fem::gauss_rule<Dim>(3))
      farthest.pressure =
          std::max(farthest.pressure, std::abs(space.values_at(state, e, point.position).pressure));
  const double largest = std::max(velocity.value().lpNorm<Eigen::Infinity>(),
                                  std::numeric_limits<double>::min());  // at rest
  return {farthest.velocity / largest, farthest.cross_flow / largest,
          farthest.pressure / largest_pressure};
}

template MixedSpace<2>::State extruded(const MixedSpace<2>&, const solve::CompensatedVector&);
template MixedSpace<3>::State extruded(const MixedSpace<3>&, const solve::CompensatedVector&);
template Departure departure(const MixedSpace<2>&, const solve::CompensatedVector&,
                             const solve::CompensatedVector&, double);
template Departure departure(const MixedSpace<3>&, const solve::CompensatedVector&,
                             const solve::CompensatedVector&, double);

}  // namespace talus::mixed
