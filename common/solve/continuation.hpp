// Continuation in the regularisation parameter: a way down from a smooth law, or the fallback when
// Newton fails from where it starts. Natural continuation, constant predictor, in log10 λr.
#pragma once

#include <vector>

#include "common/solve/natural_continuation.hpp"

namespace talus::solve {

struct ContinuationOptions {
  double first = 1e-2;              ///< largest λr, solved first
  double tolerance_on_the_way = 0;  ///< of the solves above the target; 0: the same as there
  double step = 1;                  ///< in log10 λr; halved on a failure
  double smallest_step = 4e-4;      ///< below which the path is given up
  int max_solutions = 100;
};

/// One solve on the way.
struct ContinuationStep {
  double lambda_r = 0;
  End end = End::stagnated;
  int iterations = 0;
};

struct ContinuationSummary {
  NewtonSummary newton;                ///< of the state; on a failure with the end that caused it
  std::vector<ContinuationStep> path;  ///< empty: the direct solve succeeded
  double lambda_r = 0;                 ///< that the state belongs to: the target, on success

  int total_iterations() const {
    if (path.empty()) return newton.iterations();
    int total = 0;
    for (const ContinuationStep& step : path) total += step.iterations;
    return total;
  }
};

/// A problem under a law, by log10 λr; at the λr it came with, to the last digit.
template <NewtonProblem P>
class InLambdaR {
 public:
  using State = typename P::State;
  explicit InLambdaR(P& problem) : problem_(problem), target_(problem.rheology().lambda_r) {}

  double target() const { return std::log10(target_); }
  double lambda_r_at(double parameter) const {
    return parameter == target() ? target_ : std::pow(10, parameter);
  }
  double parameter() const { return std::log10(problem_.rheology().lambda_r); }
  void set_parameter(double parameter) { problem_.set_lambda_r(lambda_r_at(parameter)); }
  const Residual& evaluate(const State& state) { return problem_.evaluate(state); }
  bool linear_solve(const Eigen::VectorXd& b, State& x) { return problem_.linear_solve(b, x); }
  bool exceeds_capacity(const State& state) const requires requires(P& problem) {
    problem.exceeds_capacity(state);
  }
  { return problem_.exceeds_capacity(state); }

 private:
  P& problem_;
  double target_;
};

/// Solves at the problem's own λr by way of λr = `first` downwards in adaptive steps. On a failure
/// `state` is the last solution on the way, or where the first solve left it, and the problem stays
/// at the λr of that state.
template <NewtonProblem P>
ContinuationSummary newton_along_path(P& problem, typename P::State& state,
                                      const NewtonOptions& newton_options = {},
                                      const ContinuationOptions& options = {}) {
  InLambdaR<P> path_problem(problem);
  PathOptions path_options;
  path_options.target = path_problem.target();
  path_options.max_points = options.max_solutions;
  path_options.smallest_step = options.smallest_step;
  path_options.largest_step = options.step;
  path_options.growth = 1;
  path_options.corrector = newton_options;
  path_options.on_the_way = options.tolerance_on_the_way;
  const double first = std::max(std::log10(options.first), path_problem.target());
  auto path = follow_natural(
      path_problem, {.state = state, .parameter = first, .direction = -1, .step = options.step},
      Predictor::constant, path_options);
  ContinuationSummary summary;
  for (const PathAttempt& attempt : path.attempts)
    summary.path.push_back(
        {path_problem.lambda_r_at(attempt.parameter), attempt.end, attempt.iterations});
  state = std::move(path.next.state);
  summary.newton = std::move(path.newton);
  summary.lambda_r = problem.rheology().lambda_r;
  if (path.end != PathEnd::target_reached) {
    const End last = path.attempts.back().end;
    summary.newton.end = is_success(last) ? End::stagnated : last;  // or out of points
  }
  return summary;
}

/// Solves at the problem's own λr; if that fails, again along the path from λr = `first`.
template <NewtonProblem P>
ContinuationSummary newton_with_continuation(P& problem, typename P::State& state,
                                             const NewtonOptions& newton_options = {},
                                             const ContinuationOptions& options = {}) {
  const double target = problem.rheology().lambda_r;
  const typename P::State start = state;
  ContinuationSummary direct{newton(problem, state, newton_options), {}, target};
  if (is_success(direct.newton.end) || target >= options.first) return direct;
  state = start;
  ContinuationSummary summary = newton_along_path(problem, state, newton_options, options);
  summary.path.insert(summary.path.begin(),
                      {target, direct.newton.end, direct.newton.iterations()});
  return summary;
}

}  // namespace talus::solve
