#include "common/mixed/layer.hpp"

#include <algorithm>
#include <cmath>

namespace talus::mixed {
namespace {

// What a linear pressure coefficient of an element is a slope over: its size.
template <int Dim>
double pressure_length(const MixedSpace<Dim>& space, std::size_t element) {
  const auto middle = space.mesh().elements[element][MixedSpace<Dim>::interior];
  const fem::Point<Dim> x = space.mesh().nodes[static_cast<std::size_t>(middle)],
                        e = fem::Point<Dim>::Unit(0);
  return 1 / space.pressure_basis(element, e, x + e)[1];
}

}  // namespace

fem::Mesh<3> extruded_mesh(const fem::Mesh<2>& plane, std::span<const double> boundaries) {
  const std::size_t layers = boundaries.size() - 1;
  const auto count = static_cast<Eigen::Index>(plane.nodes.size());
  fem::Mesh<3> mesh;
  for (std::size_t level = 0; level <= 2 * layers; ++level) {
    const double place = 0.5 * (boundaries[level / 2] + boundaries[(level + 1) / 2]);
    for (const auto& node : plane.nodes) mesh.nodes.emplace_back(node[0], node[1], place);
    mesh.fixed.insert(mesh.fixed.end(), plane.fixed.begin(), plane.fixed.end());
  }
  for (std::size_t layer = 0; layer < layers; ++layer) {
    const std::size_t below = mesh.elements.size();
    for (const auto& element : plane.elements) {
      auto& extruded = mesh.elements.emplace_back();
      for (std::size_t a = 0; a < extruded.size(); ++a)
        extruded[a] = element[a % element.size()] +
                      count * static_cast<Eigen::Index>(2 * layer + a / element.size());
    }
    for (const auto& [name, faces] : plane.boundaries)
      for (const fem::Face& face : faces)
        mesh.boundaries[name].push_back({below + face.element, face.side});
  }
  for (std::size_t e = 0; e < plane.elements.size(); ++e) {
    mesh.boundaries["back"].push_back({e, 4});
    mesh.boundaries["front"].push_back({mesh.elements.size() - plane.elements.size() + e, 5});
  }
  return mesh;
}

MixedSpace<3>::State extruded_state(const MixedSpace<2>& plane,
                                    const solve::CompensatedVector& state,
                                    const MixedSpace<3>& space) {
  Eigen::VectorXd value = Eigen::VectorXd::Zero(space.size()), correction = value;
  const auto nodes = static_cast<Eigen::Index>(plane.mesh().nodes.size());
  for (Eigen::Index node = 0; 3 * node < space.velocity_count(); ++node)
    for (int i = 0; i < 2; ++i) {
      const auto from = plane.velocity_index(node % nodes, i), to = space.velocity_index(node, i);
      value[to] = state.value()[from];
      correction[to] = state.correction()[from];
    }
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    const std::size_t below = e % plane.element_count();
    const double stretch = pressure_length(space, e) / pressure_length(plane, below);
    for (int k = 0; k < MixedSpace<2>::pressures; ++k)
      value[space.pressure_index(e, k)] =
          (k == 0 ? 1 : stretch) * state.value()[plane.pressure_index(below, k)];
  }
  return {std::move(value), std::move(correction)};
}

Departure departure_from_plane(const MixedSpace<2>& plane, const solve::CompensatedVector& of_plane,
                               const MixedSpace<3>& space, const solve::CompensatedVector& state) {
  Departure farthest;
  double largest_velocity = 0, largest_pressure = 0;
  const auto nodes = static_cast<Eigen::Index>(plane.mesh().nodes.size());
  for (Eigen::Index node = 0; 3 * node < space.velocity_count(); ++node) {
    for (int i = 0; i < 2; ++i) {
      const double expected = of_plane.value()[plane.velocity_index(node % nodes, i)];
      const double found = state.value()[space.velocity_index(node, i)];
      largest_velocity = std::max(largest_velocity, std::abs(expected));
      farthest.velocity = std::max(farthest.velocity, std::abs(found - expected));
    }
    farthest.cross_flow =
        std::max(farthest.cross_flow, std::abs(state.value()[space.velocity_index(node, 2)]));
  }
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : fem::gauss_rule<3>(3)) {
      const double expected =
          plane.values_at(of_plane, e % plane.element_count(), point.position.head<2>()).pressure;
      const double found = space.values_at(state, e, point.position).pressure;
      largest_pressure = std::max(largest_pressure, std::abs(expected));
      farthest.pressure = std::max(farthest.pressure, std::abs(found - expected));
    }
  return {farthest.velocity / largest_velocity, farthest.cross_flow / largest_velocity,
          farthest.pressure / largest_pressure};
}

}  // namespace talus::mixed
