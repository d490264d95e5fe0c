// Unidirectional flow as velocity-pressure flow: on a tensor mesh whose first axis is the stream,
// the velocity of the cross-section at every place along it and no dynamic pressure.
#pragma once

#include "common/mixed/mixed_space.hpp"

namespace talus::mixed {

/// The state with these velocities along the stream; `velocity` holds one value for every node of
/// the cross-section, numbered as in the tensor mesh of the other axes.
template <int Dim>
typename MixedSpace<Dim>::State extruded(const MixedSpace<Dim>& space,
                                         const solve::CompensatedVector& velocity);

/// How far a state is from such a flow: relative to its largest velocity, and for pressure, taken
/// at the quadrature points, to `largest_pressure`.
struct Departure {
  double velocity = 0, cross_flow = 0, pressure = 0;
};
template <int Dim>
Departure departure(const MixedSpace<Dim>& space, const solve::CompensatedVector& state,
                    const solve::CompensatedVector& velocity, double largest_pressure);

}  // namespace talus::mixed
