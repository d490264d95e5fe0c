// Solving chute and inclined plane in velocity and pressure, in the plane or in space.
#pragma once

#include <memory>

#include "oned/solver.hpp"
#include "threed/unidirectional.hpp"

namespace talus::threed {

/// As on a line, but by Newton alone: in full steps from rest, for there is no energy to search
/// along, and a search along the norm of the residual gives up in plugs where full steps arrive. If
/// they fail, by continuation in λr, searching.
struct UnidirectionalOptions : oned::SolveOptions {
  mixed::PenaltyOptions penalty = {};
};

/// The problem that is solved; scene and space must outlive it.
template <int Dim>
mixed::MixedFlow<Dim> problem_of(const oned::ShearScene& scene, const mixed::MixedSpace<Dim>& space,
                                 const UnidirectionalOptions& options);

template <int Dim>
struct UnidirectionalSolution {
  std::unique_ptr<mixed::MixedSpace<Dim>> space;
  typename mixed::MixedFlow<Dim>::State state;
  /// The line across where the flow enters, as a solution of the one-dimensional model, with its
  /// quadrature points; the end, Newton's record and the CPU time with it.
  oned::Solution line;
  /// Largest velocity across the stream at the nodes, in sqrt(gL), and |p_dyn| at the quadrature
  /// points, in φρgL; how far u is from that of the line anywhere, relative to its largest.
  double cross_flow = 0, dynamic_pressure = 0, change_along = 0;
  int factorisations = 0;
  Eigen::Index unknowns = 0, condensed = 0;
  double factor_entries = 0;
};

/// Solves on elements with these boundaries across, as thick as `thinnest`. The load limits are the
/// caller's business, as on a line.
template <int Dim>
UnidirectionalSolution<Dim> solve_unidirectional(const oned::ShearScene& scene,
                                                 std::span<const double> across,
                                                 const UnidirectionalOptions& options);

/// Checks the tangent of a scene on this mesh; see mixed::check_jacobian.
template <int Dim>
std::vector<solve::NamedCheck> check_unidirectional(const oned::ShearScene& scene,
                                                    std::span<const double> across,
                                                    const UnidirectionalOptions& options);

}  // namespace talus::threed
