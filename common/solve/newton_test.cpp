#include "common/solve/newton.hpp"

#include <cmath>
#include <set>

#include <boost/test/unit_test.hpp>

#include "common/solve/test_problems.hpp"

BOOST_AUTO_TEST_SUITE(newton_test)

using namespace talus::solve;
using boost::test_tools::tolerance;

namespace {

CompensatedVector at(const Eigen::VectorXd& value) {
  return CompensatedVector(value);
}
CompensatedVector at(double value) {
  return at(Eigen::VectorXd::Constant(1, value));
}
Eigen::VectorXd one(double value) {
  return Eigen::VectorXd::Constant(1, value);
}

// Energies log cosh w, w⁴, the integral of arctan w, (2/3)|w|^{3/2} and w ln w - w.
ConvexProblem log_cosh() {
  return {.slope = [](double w) { return std::tanh(w); },
          .curvature = [](double w) { return 1 / (std::cosh(w) * std::cosh(w)); },
          .load = Eigen::Vector3d(0.3, -0.5, 0.7),
          .coupling = Eigen::Matrix3d{{0.2, -0.1, 0}, {-0.1, 0.2, -0.1}, {0, -0.1, 0.2}}};
}
ConvexProblem quartic(double load) {
  return {.slope = [](double w) { return 4 * w * w * w; },
          .curvature = [](double w) { return 12 * w * w; },
          .load = one(load)};
}
ConvexProblem arctangent() {
  return {.slope = [](double w) { return std::atan(w); },
          .curvature = [](double w) { return 1 / (1 + w * w); },
          .load = one(0.5)};
}
ConvexProblem square_root() {
  return {.slope = [](double w) { return std::copysign(std::sqrt(std::abs(w)), w); },
          .curvature = [](double w) { return 0.5 / std::sqrt(std::abs(w)); },
          .load = one(0)};
}
ConvexProblem logarithm() {
  return {.slope = [](double w) { return std::log(w); },
          .curvature = [](double w) { return 1 / w; },
          .load = one(0)};
}

// A residual whose rounding is of this size, of the magnitude, and is known to be.
struct Noisy : ConvexProblem {
  Noisy(ConvexProblem exact, double size) : ConvexProblem(std::move(exact)), noise(size) {
    unit_round_off = size;
  }
  double noise;
  const Residual& evaluate(const State& state) {
    ConvexProblem::evaluate(state);
    for (Eigen::Index i = 0; i < w.size(); ++i)
      residual.value[i] += 0.5 * noise * residual.magnitude[i] * std::sin(1e15 * w[i]);
    return residual;
  }
};

constexpr NewtonOptions full_steps{.line_search = LineSearch::none};
constexpr NewtonOptions by_residual{.line_search = LineSearch::residual_norm};

}  // namespace

BOOST_AUTO_TEST_CASE(convergence_is_quadratic) {
  const auto order_of = [](ConvexProblem problem, CompensatedVector state) {
    const NewtonSummary summary = newton(problem, state, {.tolerance = 1e-14});
    BOOST_TEST(is_success(summary.end));
    std::vector<double> logs;
    for (const NewtonIteration& record : summary.history)
      if (record.residual < 0.1 && record.residual > 1e-13)
        logs.push_back(std::log(record.residual));
    BOOST_REQUIRE(logs.size() >= 3);
    const double* last = &logs.back();
    return (last[0] - last[-1]) / (last[-1] - last[-2]);
  };
  const double log_cosh_order = order_of(log_cosh(), CompensatedVector(3));
  BOOST_TEST(log_cosh_order > 1.8);
  BOOST_TEST(log_cosh_order < 3.2);  // tanh'' vanishes at 0: the order may rise towards 3
  const double quartic_order = order_of(quartic(2), at(1.5));
  BOOST_TEST(quartic_order > 1.8);
  BOOST_TEST(quartic_order < 2.2);
}

BOOST_AUTO_TEST_CASE(a_frozen_tangent_converges_linearly_only) {
  ConvexProblem problem = quartic(2);
  problem.tangent_factor = 2;
  CompensatedVector state = at(1.5);
  const NewtonSummary summary = newton(problem, state);
  BOOST_TEST(is_success(summary.end));
  BOOST_TEST(summary.iterations() > 30);
}

BOOST_AUTO_TEST_CASE(converged_means_the_solution) {
  ConvexProblem problem = quartic(2);
  CompensatedVector state = at(1.5);
  const NewtonSummary summary = newton(problem, state);
  BOOST_CHECK(summary.end == End::converged);
  BOOST_TEST(summary.final_residual() <= 1e-12);
  BOOST_TEST(state.value()[0] == std::cbrt(0.5), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_floor_ends_the_solve_where_rounding_hides_the_residual) {
  Noisy problem{quartic(2), 1e-8};
  for (const NewtonOptions& options : {NewtonOptions{}, by_residual}) {
    CompensatedVector state = at(1.5);
    const NewtonSummary summary = newton(problem, state, options);
    BOOST_CHECK(summary.end == End::at_round_off_floor);
    BOOST_TEST(summary.final_residual() <= summary.round_off_floor());
    BOOST_TEST(summary.final_residual() > 1e-12);  // else the tolerance would have ended it
    BOOST_TEST(state.value()[0] == std::cbrt(0.5), tolerance(1e-7));
  }
}

BOOST_AUTO_TEST_CASE(a_floor_that_hides_the_answer_too_is_no_success) {
  Noisy problem{quartic(2), 1e-3};
  for (const NewtonOptions& options : {NewtonOptions{}, by_residual}) {
    CompensatedVector state = at(1.5);
    BOOST_TEST(!is_success(newton(problem, state, options).end));
  }
}

BOOST_AUTO_TEST_CASE(a_small_residual_is_no_success_while_the_steps_are_large) {
  // The second force is 1e-12 of the first long before its unknown is found: two thirds of the way
  // a step. Where the residual alone is judged that passes for a solution.
  ConvexProblem problem = quartic(2);
  problem.load = Eigen::Vector2d(2, 2e-15);
  problem.coupling = Eigen::Matrix2d::Zero();
  for (const double distance : {1e-12, 1e-6, 1e-3, std::numeric_limits<double>::infinity()}) {
    for (LineSearch search : {LineSearch::none, LineSearch::residual_norm}) {
      CompensatedVector state = at(Eigen::Vector2d(1.5, 1));
      BOOST_TEST(
          is_success(newton(problem, state, {.distance = distance, .line_search = search}).end));
      const double error = std::abs(state.value()[1] - std::cbrt(5e-16)) / std::cbrt(0.5);
      if (std::isfinite(distance))
        BOOST_TEST(error <= distance);
      else
        BOOST_TEST(error > 1e-5);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_loose_tolerance_is_kept_by_the_answer) {
  for (const double loose : {1e-1, 1e-2, 1e-3, 1e-5}) {
    ConvexProblem problem = arctangent();
    CompensatedVector state = at(30);
    BOOST_TEST(is_success(newton(problem, state, {.tolerance = loose, .distance = loose}).end));
    BOOST_TEST(state.value()[0] == std::tan(0.5), tolerance(loose));
  }
}

BOOST_AUTO_TEST_CASE(a_solution_to_set_out_from_is_left_as_it_is) {
  ConvexProblem problem = quartic(2);
  CompensatedVector state = at(1.5);
  BOOST_REQUIRE(is_success(newton(problem, state).end));
  const Eigen::VectorXd before = state.value();
  const NewtonSummary again = newton(problem, state);
  BOOST_TEST(is_success(again.end));
  BOOST_TEST(again.iterations() == 0);
  BOOST_TEST((state.value() == before));
}

BOOST_AUTO_TEST_CASE(a_slope_below_its_own_rounding_is_the_floor_too) {
  // The second unknown's rounding hides both slopes; the first alone is clear of its own.
  struct HalfRounded : ConvexProblem {
    Residual rounded;
    const Residual& evaluate(const State& state) {
      rounded = ConvexProblem::evaluate(state);
      rounded.round_off << 0, 10;
      return rounded;
    }
  };
  HalfRounded problem{{.slope = [](double w) { return w; },
                       .curvature = [](double) { return 1.; },
                       .load = Eigen::Vector2d(1, 1),
                       .tangent_factor = -1},
                      {}};
  CompensatedVector near = at(Eigen::Vector2d(1 + 1e-8, 1 + 1e-8));
  BOOST_CHECK(newton(problem, near).end == End::at_round_off_floor);
  CompensatedVector far(2);  // nothing is known of the answer there
  BOOST_CHECK(newton(problem, far).end == End::line_search_failed);
}

BOOST_AUTO_TEST_CASE(the_iteration_limit_ends_in_stagnation) {
  ConvexProblem problem = quartic(2);
  CompensatedVector state = at(1.5);
  const NewtonSummary summary = newton(problem, state, {.max_iterations = 2});
  BOOST_CHECK(summary.end == End::stagnated);
  BOOST_TEST(summary.iterations() == 2);
}

BOOST_AUTO_TEST_CASE(a_cycle_ends_in_stagnation_and_the_line_search_breaks_it) {
  ConvexProblem problem = square_root();  // full steps go from w to -w for ever
  CompensatedVector state = at(1);
  NewtonOptions options = full_steps;
  options.stall_iterations = 7;
  const NewtonSummary cycle = newton(problem, state, options);
  BOOST_CHECK(cycle.end == End::stagnated);
  BOOST_TEST(cycle.iterations() == 7);
  BOOST_TEST(std::abs(state.value()[0]) == 1);

  state = at(1);
  BOOST_TEST(is_success(newton(problem, state).end));
  BOOST_TEST(std::abs(state.value()[0]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(full_steps_diverge_where_the_line_search_converges) {
  ConvexProblem problem = arctangent();
  CompensatedVector state = at(30);
  BOOST_TEST(!is_success(newton(problem, state, full_steps).end));
  state = at(30);
  NewtonOptions watched = full_steps;
  watched.hopeless = 0.1;  // the start, however large its residual, has a step
  const NewtonSummary given_up = newton(problem, state, watched);  // sooner
  BOOST_CHECK(given_up.end == End::stagnated);
  BOOST_TEST(given_up.iterations() == 1);
  state = at(30);
  BOOST_TEST(is_success(newton(problem, state).end));
  BOOST_TEST(state.value()[0] == std::tan(0.5), tolerance(1e-11));
}

BOOST_AUTO_TEST_CASE(an_ascent_direction_fails_the_line_search_and_keeps_the_state) {
  ConvexProblem problem = log_cosh();
  problem.tangent_factor = -1;
  const Eigen::Vector3d start(0.1, 0.2, 0.3);
  for (const NewtonOptions& options : {NewtonOptions{}, by_residual}) {
    CompensatedVector state = at(start);
    const NewtonSummary summary = newton(problem, state, options);
    BOOST_CHECK(summary.end == End::line_search_failed);
    BOOST_TEST(summary.iterations() == 0);
    BOOST_TEST((state.value() == start));
  }
}

BOOST_AUTO_TEST_CASE(a_singular_tangent_fails_the_linear_solver_and_keeps_the_state) {
  ConvexProblem problem = quartic(2);
  CompensatedVector state = at(0);
  const NewtonSummary summary = newton(problem, state);
  BOOST_CHECK(summary.end == End::linear_solver_failed);
  BOOST_TEST(state.value()[0] == 0);
}

BOOST_AUTO_TEST_CASE(leaving_the_range_of_numbers_is_said_and_the_line_search_stays_inside) {
  ConvexProblem problem = logarithm();  // the full step from 10 ends below zero
  CompensatedVector state = at(10);
  BOOST_CHECK(newton(problem, state, full_steps).end == End::non_finite);
  state = at(10);
  BOOST_TEST(is_success(newton(problem, state).end));
  BOOST_TEST(state.value()[0] == 1, tolerance(1e-11));
  state = at(-1);
  BOOST_CHECK(newton(problem, state).end == End::non_finite);
}

BOOST_AUTO_TEST_CASE(every_accepted_state_is_observed_once_and_recorded) {
  for (const auto& [problem_of, start] :
       {std::pair{&logarithm, 10.}, {&arctangent, 30.}, {&square_root, 1.}}) {
    ConvexProblem problem = problem_of();
    CompensatedVector state = at(start);
    std::vector<double> seen;
    const NewtonSummary summary = newton(
        problem, state, {}, [&](const CompensatedVector& w) { seen.push_back(w.value()[0]); });
    BOOST_REQUIRE(seen.size() == summary.history.size());
    BOOST_TEST(seen.front() == start);
    BOOST_TEST(seen.back() == state.value()[0]);
    BOOST_TEST(std::set<double>(seen.begin(), seen.end()).size() == seen.size());
    BOOST_TEST(summary.history.back().step == 0);
    for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
      BOOST_TEST(summary.history[i].step > 0);
      BOOST_TEST(summary.history[i].evaluations >= 1);
      const Residual& there = problem.evaluate(at(seen[i]));
      BOOST_TEST(summary.history[i].residual == there.relative_norm(), tolerance(1e-12));
    }
  }
}

BOOST_AUTO_TEST_CASE(halving_the_step_until_the_residual_falls_converges_where_full_steps_do_not) {
  ConvexProblem problem = arctangent();
  CompensatedVector state = at(30);
  const NewtonSummary summary = newton(problem, state, by_residual);
  BOOST_TEST(is_success(summary.end));
  BOOST_TEST(state.value()[0] == std::tan(0.5), tolerance(1e-11));
  for (std::size_t i = 1; i < summary.history.size(); ++i)
    BOOST_TEST(summary.history[i].residual < summary.history[i - 1].residual);
  BOOST_TEST(summary.history.front().step == std::exp2(1 - summary.history.front().evaluations));
}

BOOST_AUTO_TEST_SUITE_END()
