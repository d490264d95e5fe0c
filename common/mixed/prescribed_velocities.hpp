// What boundary conditions say about the velocity of every node, also where boundaries meet.
#pragma once

#include <map>

#include "common/fem/mesh.hpp"
#include "common/mixed/boundary_condition.hpp"

namespace talus::mixed {

/// The prescribed velocities: component i of node n at Dim n + i, zeros included. Where boundaries
/// meet, by the rule of boundary_condition.hpp, whatever their names. Every boundary needs its
/// condition. Throws std::invalid_argument naming two boundaries that contradict each other, or one
/// that prescribes what is not finite.
template <int Dim>
std::map<Eigen::Index, double> prescribed_velocities(const fem::Mesh<Dim>& mesh,
                                                     const BoundaryConditions<Dim>& conditions);

}  // namespace talus::mixed
