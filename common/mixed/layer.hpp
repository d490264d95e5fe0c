// Plane flow in space: an extruded mesh, and on it the flow that is the same at every place along
// the new axis.
#pragma once

#include <span>

#include "common/mixed/extrusion.hpp"

namespace talus::mixed {

/// The elements of a plane mesh between these boundaries along a third axis (increasing, two or
/// more), a node in the middle of each; nodes and elements layer by layer, in the order of the
/// plane mesh. Boundaries keep their names; the ends of the new axis are "back" and "front".
fem::Mesh<3> extruded_mesh(const fem::Mesh<2>& plane, std::span<const double> boundaries);

/// A state of plane flow on the extruded mesh: its velocities and pressures in every layer, no
/// velocity along the new axis.
MixedSpace<3>::State extruded_state(const MixedSpace<2>& plane,
                                    const solve::CompensatedVector& state,
                                    const MixedSpace<3>& space);

/// How far a state is from a plane one: relative to the largest velocity of the plane flow, and for
/// pressure, taken at the quadrature points, to its largest pressure; `cross_flow` is the velocity
/// along the new axis.
Departure departure_from_plane(const MixedSpace<2>& plane, const solve::CompensatedVector& of_plane,
                               const MixedSpace<3>& space, const solve::CompensatedVector& state);

}  // namespace talus::mixed
