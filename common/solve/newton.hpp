// Newton's method with an optional line search on the slope of the energy.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "common/solve/end.hpp"
#include "common/solve/remaining_distance.hpp"

namespace talus::solve {

/// A residual with the two sizes that give its value a meaning, component by component.
struct Residual {
  Eigen::VectorXd value;
  Eigen::VectorXd magnitude;  ///< sum of the absolute values of the contributions
  Eigen::VectorXd round_off;  ///< bound on the rounding error of the value: the computed floor
  /// Ends of the blocks of one kind (momentum, mass), each judged by its own magnitude; empty: one.
  std::vector<Eigen::Index> block_ends = {};
  /// Size of the leading unknowns at which the law still sees rest: where a solution is smaller, or
  /// zero, this is what distances are held against.
  double rest_size = 0;

  /// max|value| / max magnitude, of the worst block: what "converged" is judged by.
  double relative_norm() const { return relative(value); }
  /// max round_off / max magnitude: the floor in the same measure.
  double relative_round_off() const { return relative(round_off); }
  bool is_round_off() const { return (value.array().abs() <= round_off.array()).all(); }
  bool is_finite() const { return value.allFinite() && magnitude.allFinite(); }
  /// Largest component of a state or step among the unknowns of the first block, whose equations
  /// may be stiff and soft at once; those of later blocks (pressures) are multipliers in them,
  /// whose error the residual itself shows.
  double leading_size(const Eigen::VectorXd& x) const {
    return x.head(block_ends.empty() ? x.size() : block_ends.front()).lpNorm<Eigen::Infinity>();
  }

 private:
  double relative(const Eigen::VectorXd& v) const {
    if (v.hasNaN()) return std::numeric_limits<double>::quiet_NaN();  // maxima would lose it
    double worst = 0;
    Eigen::Index start = 0;
    const auto block = [&](Eigen::Index end) {
      const double scale = magnitude.segment(start, end - start).lpNorm<Eigen::Infinity>();
      const double size = v.segment(start, end - start).lpNorm<Eigen::Infinity>();
      worst = std::max(worst, size / std::max(scale, std::numeric_limits<double>::min()));
      start = end;
    };
    for (const Eigen::Index end : block_ends) block(end);
    if (start < v.size()) block(v.size());
    return worst;
  }
};

/// What Newton asks of a problem. A state is also a direction; `linear_solve` linearises about the
/// state last evaluated and returns false if the system is singular or the solution not finite.
template <class P>
concept NewtonProblem = requires(P problem, typename P::State& state, const Eigen::VectorXd& b) {
  { problem.evaluate(state) } -> std::same_as<const Residual&>;
  { problem.linear_solve(b, state) } -> std::same_as<bool>;
  { state.moved(1.0, state) } -> std::same_as<typename P::State>;
  { state.value() } -> std::same_as<const Eigen::VectorXd&>;
};

/// `energy_slope` needs a residual that is the gradient of a convex energy; `residual_norm` halves
/// the step until the Euclidean norm of the residual falls.
enum class LineSearch { none, energy_slope, residual_norm };

struct NewtonOptions {
  double tolerance = 1e-12;  ///< on Residual::relative_norm()
  /// Largest distance to the solution that is left, over the largest unknown of the first block;
  /// infinity: the residual alone is judged, which is enough on the way to another solve.
  double distance = 1e-12;
  int max_iterations = 200;
  int stall_iterations = 40;  ///< iterations without a smaller residual before giving up
  /// Relative residual at which an iterate is beyond hope; the start may lie there.
  double hopeless = std::numeric_limits<double>::infinity();
  LineSearch line_search = LineSearch::energy_slope;
};

struct NewtonIteration {
  double residual = 0;   ///< relative, before the step
  double round_off = 0;  ///< relative, computed floor
  double step = 0;       ///< step length taken from here; 0 in the last record
  int evaluations = 0;   ///< residual evaluations spent on the step
};

struct NewtonSummary {
  End end = End::stagnated;
  std::vector<NewtonIteration> history;  ///< one record for the start and one for each iteration

  int iterations() const { return static_cast<int>(history.size()) - 1; }
  double final_residual() const { return history.back().residual; }
  double round_off_floor() const { return history.back().round_off; }
};

/// A step along a Newton direction: its length, or 0 if none is acceptable.
struct LineSearchResult {
  double step = 0;
  int evaluations = 0;
};

/// Finds a step that lowers a convex energy, from its slope s(t) along the direction.
/// A point where the slope is still negative is lower than the start, whatever the energy; one past
/// the minimum is taken only if its slope is a tenth of the first. Neither needs the energy itself,
/// whose differences cancel near the solution. False position (Illinois) between the two.
LineSearchResult search_energy_slope(double initial_slope,
                                     const std::function<double(double)>& slope);

/// Halves the step from 1 until the norm falls a little (Armijo), down to `smallest`.
LineSearchResult search_residual_norm(double initial_norm,
                                      const std::function<double(double)>& norm,
                                      double smallest = 1e-4);

/// Solves R(state) = 0 in place. Success means both: the residual is small, and so is the distance
/// to the solution, by the steps that led here or else by the next one; at the round-off floor,
/// that steps have come down to rounding too. Every state accepted is recorded; on a failure the
/// state is the last accepted one. `observe` sees each accepted state, the start included. A
/// failure ends as no_steady_state if the problem can certify it (`exceeds_capacity`).
template <NewtonProblem P>
NewtonSummary newton(P& problem, typename P::State& state, const NewtonOptions& options = {},
                     const std::function<void(const typename P::State&)>& observe = {}) {
  NewtonSummary summary;
  typename P::State direction;
  RemainingDistance remaining;
  double best = std::numeric_limits<double>::infinity();
  int since_best = 0;
  const Residual* residual = &problem.evaluate(state);
  for (;;) {
    summary.history.push_back({residual->relative_norm(), residual->relative_round_off()});
    if (observe) observe(state);
    const auto ended = [&](End end) {
      summary.end = end;
      if constexpr (requires { problem.exceeds_capacity(state); })
        if (!is_success(end) && problem.exceeds_capacity(state)) summary.end = End::no_steady_state;
      return summary;
    };
    if (!residual->is_finite()) return ended(End::non_finite);
    const bool is_below_tolerance = residual->relative_norm() <= options.tolerance;
    const bool is_small = is_below_tolerance || residual->is_round_off();
    const End success = is_below_tolerance ? End::converged : End::at_round_off_floor;
    constexpr double safety = 0.1;  // an estimate of the distance is not the distance
    const double solution_size =
        std::max(residual->leading_size(state.value()), residual->rest_size);
    const double near =
        std::isinf(options.distance) ? options.distance : safety * options.distance * solution_size;
    if (is_small && (remaining.bound() <= near || residual->value.isZero(0))) return ended(success);
    since_best = residual->relative_norm() < best ? 0 : since_best + 1;
    best = std::min(best, residual->relative_norm());
    const bool is_hopeless =
        summary.iterations() > 0 && residual->relative_norm() >= options.hopeless;
    if (is_hopeless || since_best >= options.stall_iterations ||
        summary.iterations() >= options.max_iterations)
      return ended(End::stagnated);

    // course 12: Newton
    if (!problem.linear_solve(-residual->value, direction)) return ended(End::linear_solver_failed);
    // end of course 12
    const double size = residual->leading_size(direction.value());
    if (is_small && remaining.bound_before(size) <= near) return ended(success);
    // Rounding is all that is left of the steps: a success as long as it is little.
    constexpr double little = 1e-6;
    const bool is_trusted = size <= little * solution_size;
    if (residual->is_round_off() && remaining.has_stopped_contracting(size))
      return ended(is_trusted ? End::at_round_off_floor : End::stagnated);
    typename P::State trial = state;
    const auto slope_at = [&](double step) -> double {
      // course 12: Newton
      trial = state.moved(step, direction);
      residual = &problem.evaluate(trial);
      return residual->value.dot(direction.value());
      // end of course 12
    };
    LineSearchResult found{1, 1};
    bool is_lost = residual->relative_norm() <= residual->relative_round_off();
    if (options.line_search == LineSearch::none) {
      slope_at(1);
    } else if (options.line_search == LineSearch::residual_norm) {
      const double initial_norm = residual->value.norm();
      found = search_residual_norm(initial_norm, [&](double step) {
        slope_at(step);
        return residual->is_round_off() ? 0 : residual->value.norm();
      });
    } else {
      const double initial_slope = residual->value.dot(direction.value());
      const double rounding = residual->round_off.dot(direction.value().cwiseAbs());
      is_lost = is_lost && std::abs(initial_slope) <= rounding;
      found = search_energy_slope(initial_slope, slope_at);
    }
    if (found.step == 0 && is_lost && !remaining.has_stopped_contracting(size)) {
      slope_at(1);  // rounding hides what the search looks at, but not yet the steps
      found = {1, found.evaluations + 1};
    } else if (found.step == 0) {
      problem.evaluate(state);
      return ended(is_lost && is_trusted ? End::at_round_off_floor : End::line_search_failed);
    }
    remaining.stepped(size, found.step);
    summary.history.back().step = found.step;
    summary.history.back().evaluations = found.evaluations;
    state = std::move(trial);
  }
}

}  // namespace talus::solve
