// Forces on boundaries from the consistent nodal reactions: as accurate as the solution, where
// integrals of the traction need the stress where it is resolved worst.
#pragma once

#include <set>
#include <string>

#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {

/// Component of the force that the constraint on a boundary exerts on the material, at the state
/// last evaluated.
template <int Dim>
double total_reaction(const MixedFlow<Dim>& flow, const std::string& boundary, int component) {
  const auto& mesh = flow.space().mesh();
  std::set<Eigen::Index> nodes;
  for (const fem::Face& face : mesh.boundaries.at(boundary))
    for (const std::size_t local : fem::face_nodes<Dim>(face.side))
      nodes.insert(mesh.elements[face.element][local]);
  double sum = 0;
  for (const Eigen::Index node : nodes)
    sum += flow.reactions()[flow.space().velocity_index(node, component)];
  return sum;
}

}  // namespace talus::mixed
