// The linearisations of the flow problems, laid out for the Jacobian check.
#pragma once

#include "common/shear/interior_point.hpp"
#include "common/shear/shear_flow.hpp"
#include "common/solve/jacobian_check.hpp"

namespace talus::shear {

/// R(w) and K w of the regularised problem about `state`, and how well its system is solved;
/// blocks: skeleton nodes, interior nodes.
/// `problem` and `space` must outlive the result.
template <int Dim>
solve::JacobianProblem jacobian_problem(ShearFlow<Dim>& problem, const CrossSection<Dim>& space,
                                        const typename ShearFlow<Dim>::State& state);

/// The optimality system of the interior point about `state`, unknowns (velocity, t, z, τ) against
/// rows (equilibrium, law, product, alignment).
template <int Dim>
solve::JacobianProblem jacobian_problem(const InteriorPoint<Dim>& problem,
                                        const CrossSection<Dim>& space,
                                        const ConeState<Dim>& state);

/// How well `newton_step` solves the linearised system it eliminates: the largest component of
/// residual + linearised(step), relative to the residual's largest in the same kind of row.
template <int Dim>
double elimination_error(InteriorPoint<Dim>& problem, const ConeState<Dim>& state);

}  // namespace talus::shear
