// A small problem for the tests of Newton's method and of continuation.
#pragma once

#include <functional>
#include <limits>

#include <Eigen/LU>

#include "common/solve/compensated_vector.hpp"
#include "common/solve/newton.hpp"

namespace talus::solve {

/// Minimise Σ energy(w_i) + w·Aw/2 - f·w over a few unknowns.
struct ConvexProblem {
  using State = CompensatedVector;

  std::function<double(double)> slope, curvature;                              ///< of the energy
  Eigen::VectorXd load;                                                        ///< f
  Eigen::MatrixXd coupling = Eigen::MatrixXd::Zero(load.size(), load.size());  ///< A
  double tangent_factor = 1;                                       ///< -1 breaks the tangent
  double unit_round_off = std::numeric_limits<double>::epsilon();  ///< claimed, of the magnitude

  // Of the state last evaluated.
  Eigen::VectorXd w = {};
  Residual residual = {};

  const Residual& evaluate(const State& state) {
    w = state.value();
    const Eigen::VectorXd forces = w.unaryExpr(slope);
    residual.value = forces + coupling * w - load;
    residual.magnitude = forces.cwiseAbs() + coupling.cwiseAbs() * w.cwiseAbs() + load.cwiseAbs();
    residual.round_off = unit_round_off * residual.magnitude;
    return residual;
  }

  bool linear_solve(const Eigen::VectorXd& b, State& x) {
    Eigen::MatrixXd tangent = coupling;
    tangent.diagonal() += w.unaryExpr(curvature);
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(tangent_factor * tangent);
    if (!factors.isInvertible()) return false;
    const Eigen::VectorXd solution = factors.solve(b);
    x = State(solution);
    return solution.allFinite();
  }
};

}  // namespace talus::solve
