// Pseudo-arclength continuation: follows a path of solutions R(x, s) = 0 round its folds.
//
// Keller (1977), "Numerical solution of bifurcation and nonlinear eigenvalue problems". A step goes
// σ along the unit tangent (x', s') of the last point and is corrected in the plane across it:
//     R(x, s) = 0,    <x', x - x0> + s'(s - s0)/S² = σ,    <x, y> = Σ w_i² x_i y_i,
// by Newton's method. Each bordered system costs two solves with one factorisation of J:
//     J a = -R,  J b = -dR/ds,  dx = a + b ds,  ds from the second equation.
// The tangent is (b, 1) ds/dσ, and the sign of ds/dσ is that of det J, relative to the start: det J
// changes sign exactly where the path turns in s. The angle with the last tangent, the usual
// choice, turns back where a fold is sharper than the step.
#pragma once

#include "common/solve/path.hpp"

namespace talus::solve {

/// Unit tangent of a path. dx/dσ is kept as (dx/ds)(ds/dσ): a state needs no scaling then.
template <class State>
struct PathTangent {
  State state_derivative = {};  ///< dx/ds
  double parameter_slope = 0;   ///< ds/dσ
  int determinant_sign = 0;
  Eigen::VectorXd squared_weights = {};
  double squared_scale = 1;  ///< S²

  /// Δσ of a displacement: its component along the tangent.
  double along(const Eigen::VectorXd& dx, double ds) const {
    const auto weighted = squared_weights.array() * state_derivative.value().array();
    return parameter_slope * ((weighted * dx.array()).sum() + ds / squared_scale);
  }
  /// Δσ of a displacement: its size.
  double length(const Eigen::VectorXd& dx, double ds) const {
    return std::hypot(weighted_size(squared_weights, dx), ds / std::sqrt(squared_scale));
  }
};

/// The tangent at the state last evaluated, with ds/dσ of the sign `orientation` times that of det
/// J. Nothing if J is singular there.
template <PathProblem P>
std::optional<PathTangent<typename P::State>> path_tangent(P& problem,
                                                           const typename P::State& state,
                                                           int orientation,
                                                           double parameter_scale) {
  PathTangent<typename P::State> tangent;
  if (!problem.linear_solve(-problem.parameter_derivative(), tangent.state_derivative))
    return std::nullopt;
  const Eigen::VectorXd weights = problem.weights(state);
  tangent.squared_weights = weights.cwiseAbs2();
  tangent.squared_scale = parameter_scale * parameter_scale;
  tangent.determinant_sign = problem.determinant_sign();
  tangent.parameter_slope =
      orientation * tangent.determinant_sign / tangent.length(tangent.state_derivative.value(), 1);
  return std::isfinite(tangent.parameter_slope) && tangent.parameter_slope != 0
             ? std::optional(std::move(tangent))
             : std::nullopt;
}

/// A state and parameter reached by a step.
template <class State>
struct PathAdvance {
  State state = {};
  double parameter = 0;
  int corrections = 0;
  double residual = 0;
};

/// Newton on R = 0 and the arclength equation, from the point predicted. Nothing on failure, or if
/// the point found lies further across the tangent than `max_deviation` steps: another branch.
template <PathProblem P>
std::optional<PathAdvance<typename P::State>> arclength_step(
    P& problem, const typename P::State& origin, double parameter,
    const PathTangent<typename P::State>& tangent, double step, const PathOptions& options,
    int& factorisations) {
  const double first = step * tangent.parameter_slope;
  PathAdvance<typename P::State> at{origin.moved(first, tangent.state_derivative),
                                    parameter + first};
  Eigen::VectorXd dx = first * tangent.state_derivative.value();
  typename P::State a, b;
  for (double last = std::numeric_limits<double>::infinity();; ++at.corrections) {
    problem.set_parameter(at.parameter);
    const Residual& residual = problem.evaluate(at.state);
    at.residual = residual.relative_norm();
    if (!residual.is_finite()) return std::nullopt;
    if (at.residual <= options.corrector.tolerance || residual.is_round_off()) break;
    const bool diverges = at.corrections > options.few_corrections && at.residual > 2 * last;
    if (diverges || at.corrections >= options.corrector.max_iterations) return std::nullopt;
    last = at.residual;

    ++factorisations;
    if (!problem.linear_solve(-residual.value, a) ||
        !problem.linear_solve(-problem.parameter_derivative(), b))
      return std::nullopt;
    const double gap = step - tangent.along(dx, at.parameter - parameter);
    const double ds = (gap - tangent.along(a.value(), 0)) / tangent.along(b.value(), 1);
    at.state = at.state.moved(1, a).moved(ds, b);
    at.parameter += ds;
    dx += a.value() + ds * b.value();
  }
  const double distance = tangent.length(dx, at.parameter - parameter);
  return distance <= std::hypot(1, options.max_deviation) * step ? std::optional(std::move(at))
                                                                 : std::nullopt;
}

/// Order in σ of the residual left by a tangent step, from a solution at the state: 2, and 1 if J,
/// dR/ds or their sign is wrong. From steps of `step` and half of it, which must stand clear of
/// rounding and leave curvature to see. The problem is left at the state.
template <PathProblem P>
double predictor_order(P& problem, const typename P::State& state, double step) {
  const double s = problem.parameter();
  const auto left_by = [&](double ds, const typename P::State& derivative) {
    problem.set_parameter(s + ds);
    return problem.evaluate(state.moved(ds, derivative)).value.norm();
  };
  problem.evaluate(state);
  const auto tangent = path_tangent(problem, state, 1, 1);
  double order = std::numeric_limits<double>::quiet_NaN();
  if (tangent) {
    const double ds = step * tangent->parameter_slope;
    order = std::log2(left_by(ds, tangent->state_derivative) /
                      left_by(ds / 2, tangent->state_derivative));
  }
  problem.set_parameter(s);
  problem.evaluate(state);
  return order;
}

/// Follows the path from `start`, whose state is corrected first if it needs to be. The problem is
/// left at the last accepted point, `Path::next`; from there the same path goes on.
template <PathProblem P>
Path<typename P::State> follow_arclength(P& problem, PathStart<typename P::State> start,
                                         const PathOptions& options = {},
                                         const PathObserver<typename P::State>& observe = {}) {
  using State = typename P::State;
  Path<State> path{.next = std::move(start)};
  auto& [state, parameter, direction, step, reference_sign, unused] = path.next;
  step = std::min(step, options.largest_step);

  const NewtonSummary at_start = solve_at(problem, parameter, state, options, path);
  if (!is_success(at_start.end)) return path;
  ++path.pending.factorisations;
  auto tangent = path_tangent(problem, state, 1, options.parameter_scale);
  if (!tangent) return path;
  if (reference_sign == 0) reference_sign = tangent->determinant_sign;
  const int orientation = direction * reference_sign;
  tangent->parameter_slope *= orientation;
  std::optional<PathEnd> end = accept<State>(path,
                                             {.parameter = parameter,
                                              .parameter_slope = tangent->parameter_slope,
                                              .corrections = at_start.iterations(),
                                              .determinant_sign = tangent->determinant_sign,
                                              .residual = at_start.final_residual()},
                                             options, observe);

  // Replaces an advance across the target by a solution on it, unless there is none nearby.
  const auto lands = [&](PathAdvance<State>& at) {
    if (!options.target || !((at.parameter - *options.target) * (parameter - *options.target) < 0))
      return true;
    const double share = (*options.target - parameter) / (at.parameter - parameter);
    const State interpolated = state.moved(share, at.state.moved(-1, state));
    at.state = interpolated;
    at.parameter = *options.target;
    const NewtonSummary landing = solve_at(problem, at.parameter, at.state, options, path);
    at.corrections += landing.iterations();
    at.residual = landing.final_residual();
    return is_success(landing.end) && tangent->length(at.state.moved(-1, interpolated).value(),
                                                      0) <= options.max_deviation * step;
  };

  while (!end) {
    auto at = arclength_step(problem, state, parameter, *tangent, step, options,
                             path.pending.factorisations);
    std::optional<PathTangent<State>> turned;
    if (at && lands(*at)) {
      ++path.pending.factorisations;
      turned = path_tangent(problem, at->state, orientation, options.parameter_scale);
    }
    if (!turned) {
      ++path.pending.failures;
      step /= 2;
      if (step < options.smallest_step) end = PathEnd::step_too_small;
      continue;
    }
    const double travelled =
        tangent->along(at->state.moved(-1, state).value(), at->parameter - parameter);
    const double cosine =
        turned->parameter_slope * tangent->along(turned->state_derivative.value(), 1);
    state = std::move(at->state);
    parameter = at->parameter;
    tangent = std::move(turned);
    step = next_step(step, at->corrections, options);
    end = accept<State>(path,
                        {.parameter = parameter,
                         .parameter_slope = tangent->parameter_slope,
                         .step = travelled,
                         .cosine = cosine,
                         .corrections = at->corrections,
                         .determinant_sign = tangent->determinant_sign,
                         .residual = at->residual},
                        options, observe);
  }
  path.end = *end;
  problem.set_parameter(parameter);
  problem.evaluate(state);
  return path;
}

}  // namespace talus::solve
