// Paths with folds, small enough to be known by formula, for the tests of continuation.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/LU>

#include "common/solve/compensated_vector.hpp"
#include "common/solve/path.hpp"

namespace talus::solve {

inline Eigen::VectorXd constant(Eigen::Index size, double value) {
  return Eigen::VectorXd::Constant(size, value);
}

// A few equations given by their formulas; two members break them on purpose.
struct SmallProblem {
  using State = CompensatedVector;

  std::function<Eigen::VectorXd(const Eigen::VectorXd&, double)> value, by_parameter;
  std::function<Eigen::MatrixXd(const Eigen::VectorXd&, double)> jacobian;
  double magnitude = 1;
  double by_parameter_factor = 1;
  bool forgets_the_sign = false;

  double s = 0;
  Eigen::VectorXd x = {};
  Residual residual = {};
  int sign = 0;

  double parameter() const { return s; }
  void set_parameter(double parameter) { s = parameter; }
  const Residual& evaluate(const State& state) {
    x = state.value();
    residual.value = value(x, s);
    residual.magnitude = constant(x.size(), magnitude);
    residual.round_off = constant(x.size(), 1e-15 * magnitude);
    return residual;
  }
  Eigen::VectorXd parameter_derivative() const { return by_parameter_factor * by_parameter(x, s); }
  bool linear_solve(const Eigen::VectorXd& b, State& direction) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> factors(jacobian(x, s));
    sign = forgets_the_sign ? 1 : factors.determinant() < 0 ? -1 : 1;
    direction = State(Eigen::VectorXd(factors.solve(b)));
    return direction.value().allFinite();
  }
  int determinant_sign() const { return sign; }
  Eigen::VectorXd weights(const State& state) const {
    return constant(state.size(), 1 / std::sqrt(static_cast<double>(state.size())));
  }
};
static_assert(PathProblem<SmallProblem>);

// s = x³ - 3x: an S with folds at s = 2 and s = -2.
inline SmallProblem cubic() {
  return {.value = [](const Eigen::VectorXd& x,
                      double s) { return constant(1, std::pow(x[0], 3) - 3 * x[0] - s); },
          .by_parameter = [](const Eigen::VectorXd&, double) { return constant(1, -1); },
          .jacobian = [](const Eigen::VectorXd& x,
                         double) { return Eigen::MatrixXd::Constant(1, 1, 3 * x[0] * x[0] - 3); },
          .magnitude = 10};
}
inline PathStart<CompensatedVector> cubic_start() {
  return {.state = CompensatedVector(constant(1, -3)), .parameter = -18};
}
inline double cubic_at(double x) {
  return x * x * x - 3 * x;
}

// x² + s² = 1, a closed path.
inline SmallProblem circle() {
  return {.value = [](const Eigen::VectorXd& x,
                      double s) { return constant(1, x[0] * x[0] + s * s - 1); },
          .by_parameter = [](const Eigen::VectorXd&, double s) { return constant(1, 2 * s); },
          .jacobian = [](const Eigen::VectorXd& x,
                         double) { return Eigen::MatrixXd::Constant(1, 1, 2 * x[0]); }};
}

// u'' + s exp(u) = 0, u(±1/2) = 0, by Chebyshev collocation; one fold at s = 3.513830719125...
inline SmallProblem bratu() {
  constexpr Eigen::Index n = 20;
  Eigen::VectorXd t(n + 1);
  for (Eigen::Index i = 0; i <= n; ++i)
    t[i] = 0.5 * std::cos(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(n + 1, n + 1);
  const auto factor = [&](Eigen::Index i) {
    return (i % 2 ? -1. : 1.) * (i == 0 || i == n ? 2 : 1);
  };
  for (Eigen::Index i = 0; i <= n; ++i)
    for (Eigen::Index j = 0; j <= n; ++j)
      if (i != j) slope(i, j) = factor(i) / factor(j) / (t[i] - t[j]);
  for (Eigen::Index i = 0; i <= n; ++i) slope(i, i) = -slope.row(i).sum();
  const Eigen::MatrixXd curvature = (slope * slope).block(1, 1, n - 1, n - 1);
  return {.value =
              [=](const Eigen::VectorXd& u, double s) {
                return Eigen::VectorXd(curvature * u + s * u.array().exp().matrix());
              },
          .by_parameter = [](const Eigen::VectorXd& u,
                             double) { return Eigen::VectorXd(u.array().exp()); },
          .jacobian =
              [=](const Eigen::VectorXd& u, double s) {
                Eigen::MatrixXd tangent = curvature;
                tangent.diagonal() += s * u.array().exp().matrix();
                return tangent;
              },
          .magnitude = 10};
}
// 8 a² at the largest value of a/cosh(a): the solution is u = 2 ln(cosh(a)/cosh(2at)).
inline double bratu_fold() {
  double a = 1.2;
  for (int i = 0; i < 100; ++i) a = 1 / std::tanh(a);
  return 8 * std::pow(a / std::cosh(a), 2);
}

}  // namespace talus::solve
