// Natural continuation: the parameter itself is stepped, and Newton solves at each. It ends at the
// first fold, where no solution lies ahead; the records are those of arclength continuation, so
// that the two can be compared.
#pragma once

#include "common/solve/path.hpp"

namespace talus::solve {

/// First guess of a step: the last state; moved as the last step was; or along dx/ds, for one
/// factorisation more.
enum class Predictor { constant, secant, tangent };

/// Follows the path from `start` in its direction, Δs = S Δσ. A step is refused if Newton fails or,
/// where states have a size, moves the state by more than `largest_step`: a jump to another branch.
/// The problem is left at the last accepted point, `Path::next`. A determinant's sign is that of
/// Newton's last factorisation, or of the predictor's; before there is any, the reference sign of
/// the start. A tangent is only to be had of a PathProblem.
template <ParameterProblem P>
Path<typename P::State> follow_natural(P& problem, PathStart<typename P::State> start,
                                       Predictor predictor, const PathOptions& options = {},
                                       const PathObserver<typename P::State>& observe = {}) {
  using State = typename P::State;
  Path<State> path{.next = std::move(start)};
  auto& [state, parameter, direction, step, known_sign, secant] = path.next;
  step = std::min(step, options.largest_step);

  // The state changes by `derivative` a unit of the parameter; false if J is singular.
  std::optional<State> derivative = secant;
  const auto predict = [&] {
    if (predictor == Predictor::constant) derivative.reset();
    if constexpr (PathProblem<P>) {
      if (predictor != Predictor::tangent) return true;
      ++path.pending.factorisations;
      return problem.linear_solve(-problem.parameter_derivative(), derivative.emplace());
    }
    return true;
  };
  const auto jumps = [&](const State& moved) {
    if constexpr (PathProblem<P>)
      return !(weighted_size(problem.weights(state).cwiseAbs2(), moved.value()) <=
               options.largest_step);
    return false;
  };
  const auto accepted = [&](double travelled, NewtonSummary newton) {
    if constexpr (PathProblem<P>)
      if (newton.iterations() > 0 || predictor == Predictor::tangent)
        known_sign = problem.determinant_sign();  // else it is of a matrix before this path
    path.newton = std::move(newton);
    return accept<State>(path,
                         {.parameter = parameter,
                          .parameter_slope = direction * options.parameter_scale,
                          .step = travelled,
                          .corrections = path.newton.iterations(),
                          .determinant_sign = known_sign,
                          .residual = path.newton.final_residual()},
                         options, observe);
  };

  path.newton = solve_at(problem, parameter, state, options, path);
  if (!is_success(path.newton.end) || !predict()) return path;
  std::optional<PathEnd> end = accepted(0, path.newton);
  if (options.target == parameter) end = PathEnd::target_reached;

  std::optional<State> in_vain;  // where the last attempt from here ended
  while (!end) {
    double ds = direction * options.parameter_scale * step;
    const bool lands = options.target && (parameter - *options.target) * direction < 0 &&
                       (parameter + ds - *options.target) * direction >= 0;
    if (lands) ds = *options.target - parameter;
    State trial = derivative ? state.moved(ds, *derivative) : state;
    if constexpr (requires { trial.learn_from(*in_vain); })
      if (in_vain) trial.learn_from(*in_vain);
    const double next = lands ? *options.target : parameter + ds;
    NewtonSummary newton = solve_at(problem, next, trial, options, path);
    const State moved = trial.moved(-1, state);
    if (!is_success(newton.end) || jumps(moved)) {
      ++path.pending.failures;
      in_vain = std::move(trial);
      step /= 2;
      if (step < options.smallest_step) end = PathEnd::step_too_small;
      continue;
    }
    in_vain.reset();
    secant = moved.moved(1 / ds - 1, moved);
    derivative = secant;
    state = std::move(trial);
    parameter = next;
    const double travelled = std::abs(ds) / options.parameter_scale;
    const double next_one = next_step(step, newton.iterations(), options);
    const bool was_halved = path.pending.failures > 0;
    step = was_halved && !options.grows_after_failure ? std::min(step, next_one) : next_one;
    if (!predict()) end = PathEnd::step_too_small;
    const std::optional<PathEnd> reached = accepted(travelled, std::move(newton));
    if (reached) end = reached;
  }
  path.end = *end;
  problem.set_parameter(parameter);
  problem.evaluate(state);
  return path;
}

}  // namespace talus::solve
