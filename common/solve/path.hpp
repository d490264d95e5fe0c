// The path of solutions of R(x, s) = 0 in a parameter s: what is recorded of it, and what the two
// ways to follow it share (arclength.hpp, natural_continuation.hpp).
//
// A path is measured with the length σ, dσ² = Σ (w_i dx_i)² + (ds/S)²: the problem gives the
// weights w, the options the scale S of the parameter. A fold is a point where ds/dσ changes its
// sign.
#pragma once

#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/solve/newton.hpp"

namespace talus::solve {

/// A problem in a parameter, which takes effect at the next `evaluate`.
template <class P>
concept ParameterProblem = NewtonProblem<P> && requires(P problem, double s) {
  { problem.parameter() } -> std::same_as<double>;
  problem.set_parameter(s);
};

/// What a tangent of the path asks for as well. `linear_solve` keeps its factors for further
/// right-hand sides at one state.
template <class P>
concept PathProblem = ParameterProblem<P> && requires(P problem, const typename P::State& state) {
  /// dR/ds at the state last evaluated.
  { problem.parameter_derivative() } -> std::convertible_to<Eigen::VectorXd>;
  /// Sign of det J of the tangent last factored.
  { problem.determinant_sign() } -> std::same_as<int>;
  /// w: sqrt(Σ (w_i x_i)²) is the dimensionless size of a direction x at the state.
  { problem.weights(state) } -> std::convertible_to<Eigen::VectorXd>;
};

enum class PathEnd {
  target_reached,  ///< the last point lies exactly on the target parameter
  left_bounds,     ///< the last point lies outside [lower, upper]
  stopped,         ///< the observer had seen enough
  out_of_points,   ///< as many points as were asked for
  step_too_small,  ///< no step above the smallest one succeeded
  start_failed     ///< no solution at the start, or its tangent is singular
};

std::string name_of(PathEnd end);

/// One of Newton's solves at a fixed parameter.
struct PathAttempt {
  double parameter = 0;
  End end = End::stagnated;
  int iterations = 0;
};

struct PathCost {
  int failures = 0;        ///< steps tried in vain
  int factorisations = 0;  ///< those of steps in vain included
};

/// One accepted point.
struct PathPoint {
  double parameter = 0;
  double parameter_slope = 0;  ///< ds/dσ; natural continuation: S in its direction
  double step = 0;             ///< Δσ along the tangent of the last point; 0 at the start
  double cosine = 1;         ///< of this tangent to the last one, in the last point's weights; < 0:
                             ///< sharper than the step resolves, or oriented wrongly
  int corrections = 0;       ///< Newton iterations of the accepted step
  PathCost cost = {};        ///< since the last point
  int determinant_sign = 0;  ///< of J; 0: not known
  bool is_fold_passed = false;           ///< det J changed its sign since the last point
  double residual = 0;                   ///< relative
  std::vector<double> observation = {};  ///< left to the observer
};

/// Where and how to set out; also where a path stands, so that it can be resumed. Reversed: negate
/// the direction.
template <class State>
struct PathStart {
  State state = {};
  double parameter = 0;
  int direction = 1;                 ///< sign of ds where det J has the reference sign
  double step = 0.1;                 ///< first Δσ to try
  int reference_sign = 0;            ///< of det J; 0: its sign at this start
  std::optional<State> secant = {};  ///< natural continuation only: Δx/Δs of the last step
};

template <class State>
struct Path {
  PathEnd end = PathEnd::start_failed;
  std::vector<PathPoint> points = {};  ///< the start included
  PathStart<State> next = {};          ///< at the last point accepted
  PathCost pending = {};               ///< spent after it, in vain
  std::vector<PathAttempt> attempts = {};
  NewtonSummary newton = {};  ///< natural continuation: of the last point, or of a failed start

  PathCost total_cost() const {
    PathCost total = pending;
    for (const PathPoint& point : points) {
      total.failures += point.cost.failures;
      total.factorisations += point.cost.factorisations;
    }
    return total;
  }
};

struct PathOptions {
  std::optional<double> target = {};  ///< parameter to land on
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double parameter_scale = 1;  ///< S, in units of the parameter
  int max_points = 300;
  double smallest_step = 1e-6, largest_step = 0.5;  ///< Δσ
  int few_corrections = 3, many_corrections = 6;    ///< the step grows up to, shrinks from here
  double growth = 1.5;                              ///< factor for both; a failure halves the step
  bool grows_after_failure = true;  ///< natural continuation: also a step that was halved
  double max_deviation = 2;         ///< correction of a predicted state, over the step
  /// Of every point, full steps: a path needs none shorter, it shortens its own. The distance to
  /// the solution counts at the target only.
  NewtonOptions corrector = {.tolerance = 1e-10,
                             .distance = std::numeric_limits<double>::infinity(),
                             .max_iterations = 10,
                             .stall_iterations = std::numeric_limits<int>::max(),
                             .line_search = LineSearch::none};
  double on_the_way = 0;  ///< natural continuation to a target: tolerance of the points before it
};

/// Sees every accepted point, with the problem evaluated there, as where the path goes on from, and
/// may fill `observation`. Returning false ends the path.
template <class State>
using PathObserver = std::function<bool(const PathStart<State>&, PathPoint&)>;

/// The step to take after one with that many corrections.
double next_step(double step, int corrections, const PathOptions& options);

/// Parameter at the fold between two consecutive points of an arclength path: extremum of the cubic
/// through values and slopes, error O(step⁴). Nothing if the step did not resolve the fold.
std::optional<double> fold_between(const PathPoint& before, const PathPoint& after);
/// Parameters of all folds passed and resolved, in order.
std::vector<double> fold_parameters(std::span<const PathPoint> points);

/// sqrt(Σ (w_i x_i)²) from the squares of the weights.
inline double weighted_size(const Eigen::VectorXd& squared_weights, const Eigen::VectorXd& x) {
  return std::sqrt((squared_weights.array() * x.array().square()).sum());
}

/// Appends an accepted point, with what was spent for it, after the observer has seen it; returns
/// why the path ends there, if it does.
template <class State>
std::optional<PathEnd> accept(Path<State>& path, PathPoint point, const PathOptions& options,
                              const PathObserver<State>& observe) {
  point.cost = std::exchange(path.pending, {});
  point.is_fold_passed =
      !path.points.empty() && point.determinant_sign * path.points.back().determinant_sign < 0;
  const bool goes_on = !observe || observe(path.next, point);
  path.points.push_back(std::move(point));
  const double s = path.points.back().parameter;
  if (path.points.size() > 1 && options.target && s == *options.target)
    return PathEnd::target_reached;
  if (s < options.lower || s > options.upper) return PathEnd::left_bounds;
  if (!goes_on) return PathEnd::stopped;
  if (std::ssize(path.points) >= options.max_points) return PathEnd::out_of_points;
  return std::nullopt;
}

/// Solves R(x, s) = 0 in place at a fixed parameter. The factorisations are added to the path's.
template <ParameterProblem P>
NewtonSummary solve_at(P& problem, double parameter, typename P::State& state,
                       const PathOptions& options, Path<typename P::State>& path) {
  problem.set_parameter(parameter);
  NewtonOptions corrector = options.corrector;
  if (options.target && parameter != *options.target) {
    corrector.tolerance = std::max(corrector.tolerance, options.on_the_way);
    corrector.distance = std::numeric_limits<double>::infinity();
  }
  NewtonSummary summary = newton(problem, state, corrector);
  path.pending.factorisations += summary.iterations();
  path.attempts.push_back({parameter, summary.end, summary.iterations()});
  return summary;
}

}  // namespace talus::solve
