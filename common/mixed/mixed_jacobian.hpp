// The tangent of velocity-pressure flow, laid out for the Jacobian check.
//
// What is differentiated is the matrix assembled from the element tangents that Newton factors. The
// product without a matrix, which refines its solves, and the condensed solve are held against it.
#pragma once

#include <vector>

#include "common/mixed/mixed_flow.hpp"
#include "common/solve/jacobian_check.hpp"

namespace talus::mixed {

/// R and J about `state`, and how far product and condensed solve are from J; blocks: velocity and
/// pressure. `problem` must outlive the result.
template <int Dim>
solve::JacobianProblem jacobian_problem(MixedFlow<Dim>& problem,
                                        const typename MixedFlow<Dim>::State& state);

/// How far `tangent_product` is from the assembled matrix: the largest |J v - Jv| over |J||v| of
/// its row, v random.
template <int Dim>
double product_error(MixedFlow<Dim>& problem, const typename MixedFlow<Dim>::State& state);

/// How well the condensed system solves, without refinement, the assembled one that it stands for:
/// max|b - A x| over max(|A||x| + |b|) of the same kind of row (momentum, mass), b random. Rounding
/// counts where 1/λp outweighs the viscosity.
template <int Dim>
solve::SystemError condensation_error(MixedFlow<Dim>& problem,
                                      const typename MixedFlow<Dim>::State& state);

/// Checks the tangent of a scene's space and law at states that need no solve: the law alone, at
/// rest, in plug, at yield and in flow under about this pressure, just in flow at a tiny one and in
/// flow at a negative one. Loads only add constants and are left out.
template <int Dim>
std::vector<solve::NamedCheck> check_jacobian(const MixedFlow<Dim>& scene, double pressure);

}  // namespace talus::mixed
