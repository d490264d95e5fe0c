#include "threed/unidirectional.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "common/fem/line_mesh.hpp"

namespace talus::threed {
namespace {

template <int Dim>
mixed::BoundaryConditions<Dim> conditions_of(const oned::ShearScene& scene) {
  const std::string start = Dim == 2 ? "bottom" : "back", end = Dim == 2 ? "top" : "front";
  mixed::BoundaryConditions<Dim> conditions = {{"left", mixed::fully_developed<Dim>(0)},
                                               {"right", mixed::fully_developed<Dim>(0)},
                                               {start, {}},
                                               {end, {}}};
  conditions[scene.wall_at_start ? start : end] = mixed::no_slip<Dim>();
  if constexpr (Dim == 3)
    for (const auto* side : {"bottom", "top"}) conditions[side] = mixed::symmetry<Dim>(1);
  return conditions;
}

}  // namespace

template <int Dim>
mixed::MixedSpace<Dim> space_of(const oned::ShearScene& scene, std::span<const double> across,
                                const Thickness& thickness) {
  const double element = scene.length / static_cast<double>(across.size() - 1);
  const auto stream = fem::graded_line(0, thickness.along * element, thickness.along, 1);
  const auto between = fem::graded_line(0, thickness.between * element, thickness.between, 1);
  if constexpr (Dim == 2)
    return {fem::tensor_mesh<2>({stream, across}), conditions_of<2>(scene)};
  else
    return {fem::tensor_mesh<3>({stream, between, across}), conditions_of<3>(scene)};
}

template <int Dim>
mixed::MixedLoad<Dim> load_of(const oned::ShearScene& scene) {
  using fem::Point;
  return {[&scene](const Point<Dim>& x) { return scene.pressure(x[Dim - 1]); },
          [&scene](const Point<Dim>& x) -> Point<Dim> {
            return scene.body_force(x[Dim - 1]) * Point<Dim>::Unit(0);
          }};
}

template <int Dim>
solve::CompensatedVector line_across(const mixed::MixedSpace<Dim>& space,
                                     const solve::CompensatedVector& state, Eigen::Index nodes) {
  const auto stride = static_cast<Eigen::Index>(space.mesh().nodes.size()) / nodes;
  Eigen::VectorXd value(nodes), correction(nodes);
  for (Eigen::Index node = 0; node < nodes; ++node) {  // the last axis is numbered slowest
    const auto index = space.velocity_index(node * stride, 0);
    value[node] = state.value()[index];
    correction[node] = state.correction()[index];
  }
  return {std::move(value), std::move(correction)};
}

template <int Dim>
double largest_pressure(const oned::ShearScene& scene, const mixed::MixedSpace<Dim>& space) {
  double largest = 0;
  for (const auto& position : space.mesh().nodes)
    largest = std::max(largest, scene.pressure(position[Dim - 1]));
  return largest;
}

template <int Dim>
mixed::Departure departure(const oned::ShearScene& scene, const mixed::MixedSpace<Dim>& space,
                           const solve::CompensatedVector& state,
                           const solve::CompensatedVector& velocity) {
  return mixed::departure(space, state, velocity, largest_pressure(scene, space));
}

#define TALUS_FOR(Dim)                                                                          \
  template mixed::MixedSpace<Dim> space_of(const oned::ShearScene&, std::span<const double>,    \
                                           const Thickness&);                                   \
  template mixed::MixedLoad<Dim> load_of(const oned::ShearScene&);                              \
  template double largest_pressure(const oned::ShearScene&, const mixed::MixedSpace<Dim>&);     \
  template solve::CompensatedVector line_across(const mixed::MixedSpace<Dim>&,                  \
                                                const solve::CompensatedVector&, Eigen::Index); \
  template mixed::Departure departure(const oned::ShearScene&, const mixed::MixedSpace<Dim>&,   \
                                      const solve::CompensatedVector&,                          \
                                      const solve::CompensatedVector&);
TALUS_FOR(2)
TALUS_FOR(3)
#undef TALUS_FOR

}  // namespace talus::threed
