// The tangent of velocity-pressure flow, laid out for the Jacobian check.
#pragma once

#include "common/flow/dense_flow.hpp"
#include "common/solve/jacobian_check.hpp"

namespace talus::flow {

/// R and J v about `state`; blocks: velocity and pressure. `problem` must outlive the result.
template <int Dim>
solve::JacobianProblem jacobian_problem(DenseFlow<Dim>& problem,
                                        const solve::CompensatedVector& state);

/// How well `linear_solve` solves the system it condenses: max|b - J x| / max|b| for a random b.
template <int Dim>
double condensation_error(DenseFlow<Dim>& problem, const solve::CompensatedVector& state);

}  // namespace talus::flow
