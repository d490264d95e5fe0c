// Continuation in the regularisation parameter: a way down from a smooth law, or the fallback when
// Newton fails from where it starts.
#pragma once

#include <vector>

#include "common/solve/newton.hpp"

namespace talus::solve {

struct ContinuationOptions {
  double first = 1e-2;              ///< largest λr, solved first
  double factor = 0.1;              ///< of one step in λr; its logarithm is halved on a failure
  double tolerance_on_the_way = 0;  ///< of the solves above the target; 0: the same as there
  double smallest_log_step = 1e-3;  ///< |Δ ln λr| below which the path is given up
  int max_solves = 100;
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

/// Solves at the problem's own λr by way of λr = `first` downwards in adaptive steps. On a failure
/// `state` is the last solution on the way, or where the first solve left it, and the problem stays
/// at the λr of that state.
template <NewtonProblem P>
ContinuationSummary newton_along_path(P& problem, typename P::State& state,
                                      const NewtonOptions& newton_options = {},
                                      const ContinuationOptions& options = {}) {
  const double target = problem.rheology().lambda_r;
  NewtonOptions on_the_way = newton_options;
  if (options.tolerance_on_the_way > 0) on_the_way.tolerance = options.tolerance_on_the_way;
  on_the_way.distance = std::numeric_limits<double>::infinity();
  ContinuationSummary summary;
  typename P::State accepted = state;
  double lambda_r = std::max(options.first, target), accepted_lambda_r = 0;  // 0: nothing yet
  End last_end = End::stagnated;
  double log_step = -std::log(options.factor);
  for (int solves = 0; solves < options.max_solves; ++solves) {
    problem.set_lambda_r(lambda_r);
    NewtonSummary here = newton(problem, state, lambda_r == target ? newton_options : on_the_way);
    last_end = here.end;
    summary.path.push_back({lambda_r, here.end, here.iterations()});
    if (is_success(here.end) || accepted_lambda_r == 0) {
      summary.newton = std::move(here);
      summary.lambda_r = lambda_r;
    }
    if (is_success(last_end)) {
      accepted = state;
      accepted_lambda_r = lambda_r;
      if (lambda_r == target) return summary;
    } else {
      if (accepted_lambda_r == 0) break;
      state = accepted;
      log_step *= 0.5;
      if (log_step < options.smallest_log_step) break;
    }
    lambda_r = accepted_lambda_r * std::exp(-log_step);
    if (lambda_r < 1.001 * target) lambda_r = target;
  }
  problem.set_lambda_r(summary.lambda_r);
  summary.newton.end = is_success(last_end) ? End::stagnated : last_end;  // or out of solves
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
