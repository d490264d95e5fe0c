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
  NewtonSummary newton;                ///< of the last solve at the target
  std::vector<ContinuationStep> path;  ///< empty: the direct solve succeeded

  int total_iterations() const {
    if (path.empty()) return newton.iterations();
    int total = 0;
    for (const ContinuationStep& step : path) total += step.iterations;
    return total;
  }
};

/// Solves at the problem's own λr by way of λr = `first` downwards in adaptive steps. On a failure
/// `state` is the last accepted one; the problem is left at the target λr.
template <NewtonProblem P>
ContinuationSummary newton_along_path(P& problem, typename P::State& state,
                                      const NewtonOptions& newton_options = {},
                                      const ContinuationOptions& options = {}) {
  const double target = problem.rheology().lambda_r;
  NewtonOptions on_the_way = newton_options;
  if (options.tolerance_on_the_way > 0) on_the_way.tolerance = options.tolerance_on_the_way;
  ContinuationSummary summary;
  typename P::State accepted = state;
  double lambda_r = std::max(options.first, target), accepted_lambda_r = 0;  // 0: nothing yet
  double log_step = -std::log(options.factor);
  for (int solves = 0; solves < options.max_solves; ++solves) {
    problem.set_lambda_r(lambda_r);
    summary.newton = newton(problem, state, lambda_r == target ? newton_options : on_the_way);
    summary.path.push_back({lambda_r, summary.newton.end, summary.newton.iterations()});
    if (is_success(summary.newton.end)) {
      accepted = state;
      accepted_lambda_r = lambda_r;
      if (lambda_r == target) return summary;
    } else {
      state = accepted;
      log_step *= 0.5;
      if (accepted_lambda_r == 0 || log_step < options.smallest_log_step) break;
    }
    lambda_r = accepted_lambda_r * std::exp(-log_step);
    if (lambda_r < 1.001 * target) lambda_r = target;
  }
  state = accepted;
  problem.set_lambda_r(target);
  if (is_success(summary.newton.end)) summary.newton.end = End::stagnated;  // ran out of solves
  return summary;
}

/// Solves at the problem's own λr; if that fails, again along the path from λr = `first`.
template <NewtonProblem P>
ContinuationSummary newton_with_continuation(P& problem, typename P::State& state,
                                             const NewtonOptions& newton_options = {},
                                             const ContinuationOptions& options = {}) {
  const double target = problem.rheology().lambda_r;
  const typename P::State start = state;
  ContinuationSummary direct{newton(problem, state, newton_options), {}};
  if (is_success(direct.newton.end) || target >= options.first) return direct;
  state = start;
  ContinuationSummary summary = newton_along_path(problem, state, newton_options, options);
  summary.path.insert(summary.path.begin(),
                      {target, direct.newton.end, direct.newton.iterations()});
  return summary;
}

}  // namespace talus::solve
