// Velocity-pressure flow as a path in one of its parameters: log10 λr, or the load.
#pragma once

#include <cmath>
#include <stdexcept>

#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {

/// What both have in common. Sizes are relative: velocities by their root mean square, pressures by
/// theirs, which counts less because the velocities are what a fold shows in.
template <int Dim>
class MixedPath {
 public:
  using State = typename MixedFlow<Dim>::State;

  /// `flow` must outlive the path. Throws std::invalid_argument if its linear solver gives no
  /// determinants.
  explicit MixedPath(MixedFlow<Dim>& flow) : flow_(flow) {
    if (flow.linear_solver() != LinearSolver::direct)
      throw std::invalid_argument("a path needs the determinants of a direct linear solver");
  }

  const MixedFlow<Dim>& flow() const { return flow_; }
  const solve::Residual& evaluate(const State& state) {
    state_ = state;
    return flow_.evaluate(state);
  }
  bool linear_solve(const Eigen::VectorXd& b, State& x) { return flow_.linear_solve(b, x); }
  int determinant_sign() const { return flow_.determinant_sign(); }
  Eigen::VectorXd weights(const State& state) const {
    constexpr double pressure_weight = 0.3;
    const Eigen::Index split = flow_.space().velocity_count();
    const Eigen::Index pressures = flow_.space().size() - split;
    Eigen::VectorXd weights(flow_.space().size());
    weights.head(split).setConstant(1 / size_of(state.value().head(split)));
    weights.tail(pressures).setConstant(pressure_weight / size_of(state.value().tail(pressures)));
    return weights;
  }

 protected:
  static double size_of(const Eigen::Ref<const Eigen::VectorXd>& v) {
    return std::max(v.norm(), std::numeric_limits<double>::min());
  }
  MixedFlow<Dim>& flow_;
  State state_;  // last evaluated
};

/// The path of solutions in log10 λr.
template <int Dim>
class RegularisationPath : public MixedPath<Dim> {
 public:
  using MixedPath<Dim>::MixedPath;
  double parameter() const { return std::log10(this->flow_.rheology().lambda_r); }
  void set_parameter(double log_lambda_r) { this->flow_.set_lambda_r(std::pow(10, log_lambda_r)); }
  Eigen::VectorXd parameter_derivative() const {
    return std::log(10.0) * this->flow_.log_lambda_r_derivative(this->state_);
  }
};

/// The path of solutions in the factor of the body force.
template <int Dim>
class LoadPath : public MixedPath<Dim> {
 public:
  using MixedPath<Dim>::MixedPath;
  double parameter() const { return this->flow_.load_factor(); }
  void set_parameter(double factor) { this->flow_.set_load_factor(factor); }
  Eigen::VectorXd parameter_derivative() const { return this->flow_.load_derivative(); }
};

}  // namespace talus::mixed
