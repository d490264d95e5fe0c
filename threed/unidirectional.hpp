// Chute and inclined plane once more, as velocity-pressure flow in the plane or in space: the first
// axis along the stream, the last one the scene's own across it; in space the second lies between
// them, and nothing changes along it. The solution is the unidirectional one, with no dynamic
// pressure and no cross-flow: a check of the richer model by the poorer.
#pragma once

#include <span>

#include "common/mixed/extrusion.hpp"
#include "common/mixed/mixed_flow.hpp"
#include "oned/shear_scene.hpp"

namespace talus::threed {

/// Elements along the stream and between the two planes of symmetry, each as long as those across
/// are on average.
struct Thickness {
  int along = 1, between = 1;
};
/// Two along in the plane, so that the flow may change there; in space one and one, as the paper.
template <int Dim>
inline constexpr Thickness thinnest{.along = Dim == 2 ? 2 : 1};

/// Flow enters and leaves fully developed; no slip at the scene's wall. The end without stress is
/// free, which for the middle of the chute is the same as symmetry: there is no dynamic pressure.
template <int Dim>
mixed::MixedSpace<Dim> space_of(const oned::ShearScene& scene, std::span<const double> across,
                                const Thickness& thickness = thinnest<Dim>);
/// Static pressure and driving force of a scene, which must outlive the load.
template <int Dim>
mixed::MixedLoad<Dim> load_of(const oned::ShearScene& scene);

/// Static, at the nodes.
template <int Dim>
double largest_pressure(const oned::ShearScene& scene, const mixed::MixedSpace<Dim>& space);

/// The velocities along the stream of one line across, where the flow enters.
template <int Dim>
solve::CompensatedVector line_across(const mixed::MixedSpace<Dim>& space,
                                     const solve::CompensatedVector& state, Eigen::Index nodes);

/// How far a state is from the unidirectional one with these velocities (nodes across); pressure
/// relative to the largest static one.
template <int Dim>
mixed::Departure departure(const oned::ShearScene& scene, const mixed::MixedSpace<Dim>& space,
                           const solve::CompensatedVector& state,
                           const solve::CompensatedVector& velocity);

}  // namespace talus::threed
