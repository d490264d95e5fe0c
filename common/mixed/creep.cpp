#include "common/mixed/creep.hpp"

#include <algorithm>
#include <limits>

namespace talus::mixed {
namespace {

// Smooth enough for long steps from rest, near enough to the end for few from there.
constexpr double smooth_lambda_r = 0.01, smooth_pressure_floor = 0.1;
constexpr int most_loads = 5;  // tried on the way to one

// For a start only, judged by its residual.
solve::NewtonOptions roughly(solve::NewtonOptions options) {
  options.tolerance = std::max(options.tolerance, 1e-3);
  options.distance = std::numeric_limits<double>::infinity();
  return options;
}

template <int Dim>
void scale_velocities(const MixedSpace<Dim>& space, double factor,
                      solve::CompensatedVector& state) {
  for (Eigen::Index i = 0; i < space.velocity_count(); ++i) state.set(i, factor * state.value()[i]);
}

// Creep asks for no determinants, so that factors may serve several steps; none from before, for
// the answer is to follow from the state alone.
template <int Dim>
solve::NewtonSummary creeping_newton(MixedFlow<Dim>& flow, typename MixedFlow<Dim>::State& state,
                                     const solve::NewtonOptions& options, bool is_primal_dual) {
  const LinearSolver own = flow.linear_solver();
  flow.set_linear_solver(LinearSolver::lagged);
  flow.set_primal_dual(is_primal_dual);
  state.stress.clear();
  const auto newton = solve::newton(flow, state, options);
  flow.set_primal_dual(false);
  flow.set_linear_solver(own);
  return newton;
}

// Newton from rest under a smoother law, as far as a start needs; then, velocities scaled with λr,
// under the flow's own.
template <int Dim>
solve::NewtonSummary creep_from_rest(MixedFlow<Dim>& flow, typename MixedFlow<Dim>::State& state,
                                     const solve::NewtonOptions& options, bool is_primal_dual) {
  const rheology::Rheology own = flow.rheology();
  rheology::Rheology smooth = own;
  smooth.lambda_r = std::max(own.lambda_r, smooth_lambda_r);
  smooth.pressure_floor = std::max(own.pressure_floor, smooth_pressure_floor);
  smooth.regularises_pressure = true;
  state = flow.space().start();
  flow.set_rheology(smooth);
  const auto start = creeping_newton(flow, state, roughly(options), is_primal_dual);
  flow.set_rheology(own);
  if (!solve::is_success(start.end)) return start;
  scale_velocities(flow.space(), own.lambda_r / smooth.lambda_r, state);
  solve::NewtonOptions from_there = options;
  from_there.max_iterations -= start.iterations();
  return creeping_newton(flow, state, from_there, is_primal_dual);
}

}  // namespace

solve::NewtonOptions creep_options() {
  return {.tolerance = 1e-13,
          .distance = 1e-10,
          .max_iterations = 25,
          .stall_iterations = 6,
          .line_search = solve::LineSearch::residual_norm};
}

template <int Dim>
CreepSummary creep_to_load(MixedFlow<Dim>& flow, double load, double load_before,
                           typename MixedFlow<Dim>::State& state,
                           const solve::NewtonOptions& options, bool is_primal_dual) {
  CreepSummary summary;
  const int first = flow.iterations();
  typename MixedFlow<Dim>::State here = state;
  double reached = load_before, step = load - load_before;
  while (summary.loads + summary.failures < most_loads) {
    const int left = first + options.max_iterations - flow.iterations();
    if (left <= 0) break;
    const bool is_last = std::abs(load - reached) <= std::abs(step);
    const double next = is_last ? load : reached + step;
    solve::NewtonOptions attempt = is_last ? options : roughly(options);
    attempt.max_iterations = left;
    flow.set_load_factor(next);
    typename MixedFlow<Dim>::State trial = here;
    if (reached != 0) scale_velocities(flow.space(), next / reached, trial);
    summary.newton = reached == 0 ? creep_from_rest(flow, trial, attempt, is_primal_dual)
                                  : creeping_newton(flow, trial, attempt, is_primal_dual);
    if (!solve::is_success(summary.newton.end)) {
      ++summary.failures;
      step /= 2;
      continue;
    }
    ++summary.loads;
    here = std::move(trial);
    reached = next;
    step = load - reached;
    if (is_last) {
      state = std::move(here);
      return summary;
    }
  }
  flow.set_load_factor(load);
  if (solve::is_success(summary.newton.end))
    summary.newton.end = solve::End::stagnated;  // below it
  return summary;
}

template CreepSummary creep_to_load(MixedFlow<2>&, double, double, MixedFlow<2>::State&,
                                    const solve::NewtonOptions&, bool);
template CreepSummary creep_to_load(MixedFlow<3>&, double, double, MixedFlow<3>::State&,
                                    const solve::NewtonOptions&, bool);

}  // namespace talus::mixed
