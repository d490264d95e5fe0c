// What boundary conditions say about the velocity of every node, also where boundaries meet.
#pragma once

#include <map>

#include "common/flow/boundary_condition.hpp"
#include "common/flow/mesh.hpp"

namespace talus::flow {

/// The prescribed velocities: component i of node n at Dim n + i, zeros included. Where boundaries
/// meet, by the rule of boundary_condition.hpp, whatever their names. Every boundary needs its
/// condition. Throws std::invalid_argument naming two boundaries that contradict each other, or one
/// that prescribes what is not finite.
template <int Dim>
std::map<Eigen::Index, double> prescribed_velocities(const Mesh<Dim>& mesh,
                                                     const BoundaryConditions<Dim>& conditions);

}  // namespace talus::flow
