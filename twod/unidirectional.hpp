// Chute and inclined plane once more, as velocity-pressure flow in the plane: x along the stream,
// the scene's own coordinate across. The solution is the unidirectional one, with no dynamic
// pressure and no cross-flow: a check of the richer model by the poorer.
#pragma once

#include <span>

#include "common/flow/dense_flow.hpp"
#include "common/flow/extrusion.hpp"
#include "oned/bagnold.hpp"
#include "oned/chute.hpp"

namespace talus::twod {

/// Flow enters and leaves fully developed; the static pressure is the scene's.
struct Unidirectional {
  oned::ShearScene scene;
  flow::BoundaryConditions<2> conditions;
};

/// Half of the chute, symmetric at y = 0.
Unidirectional in_the_plane(const oned::Chute& chute);
/// A free surface at z = H.
Unidirectional in_the_plane(const oned::Bagnold& bagnold);

/// So many elements as long as they are wide on average along the stream, the given boundaries
/// across.
flow::DenseSpace<2> space_of(const Unidirectional& flow, std::span<const double> across,
                             int along = 2);
/// Static pressure and driving force. `flow` must outlive the load.
flow::DenseLoad<2> load_of(const Unidirectional& flow);

/// How far a state is from the unidirectional one with these velocities (nodes across); pressure
/// relative to the largest static one.
using flow::Departure;
Departure departure(const Unidirectional& flow, const flow::DenseSpace<2>& space,
                    const solve::CompensatedVector& state,
                    const solve::CompensatedVector& velocity);

}  // namespace talus::twod
