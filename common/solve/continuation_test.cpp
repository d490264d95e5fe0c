#include "common/solve/continuation.hpp"

#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/solve/test_problems.hpp"

BOOST_AUTO_TEST_SUITE(continuation_test)

using namespace talus::solve;
using boost::test_tools::tolerance;

namespace {

// A block on a rough table under the force f < 1: minimise sqrt(w² + λr²) - f w, as eq. (10) does.
// Full Newton steps from |w| > λr multiply w/λr by itself; from smaller w they converge.
class RegularisedFriction : public ConvexProblem {
 public:
  struct Parameters {
    double lambda_r;
  };

  explicit RegularisedFriction(double lambda_r)
      : ConvexProblem{.slope = {}, .curvature = {}, .load = Eigen::VectorXd::Constant(1, 0.2)} {
    set_lambda_r(lambda_r);
  }
  Parameters rheology() const { return {lambda_r_}; }
  void set_lambda_r(double lambda_r) {
    lambda_r_ = lambda_r;
    slope = [=](double x) { return x / std::hypot(x, lambda_r); };
    curvature = [=](double x) {
      return lambda_r * lambda_r / std::pow(std::hypot(x, lambda_r), 3);
    };
  }
  double solution() const { return 0.2 * lambda_r_ / std::sqrt(1 - 0.2 * 0.2); }

 private:
  double lambda_r_ = 0;
};

constexpr NewtonOptions full_steps{.line_search = LineSearch::none};

CompensatedVector start() {
  return CompensatedVector(Eigen::VectorXd::Constant(1, 0.5));
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_direct_solve_leaves_no_path) {
  RegularisedFriction problem(1);
  CompensatedVector state = start();
  const ContinuationSummary summary = newton_with_continuation(problem, state, full_steps);
  BOOST_TEST(is_success(summary.newton.end));
  BOOST_TEST(summary.path.empty());
  BOOST_TEST(summary.total_iterations() == summary.newton.iterations());
}

BOOST_AUTO_TEST_CASE(a_failed_direct_solve_falls_back_and_reports_its_path) {
  constexpr double target = 1e-5;
  RegularisedFriction problem(target);
  CompensatedVector direct = start();
  BOOST_REQUIRE(!is_success(newton(problem, direct, full_steps).end));

  CompensatedVector state = start();
  const ContinuationSummary summary =
      newton_with_continuation(problem, state, full_steps, {.first = 10});
  BOOST_CHECK(summary.newton.end == End::converged);
  BOOST_TEST(state.value()[0] == problem.solution(), tolerance(1e-10));
  BOOST_TEST(problem.rheology().lambda_r == target);
  BOOST_TEST(summary.lambda_r == target);

  BOOST_TEST(summary.path.front().lambda_r == target);
  BOOST_TEST(!is_success(summary.path.front().end));
  BOOST_TEST(summary.path[1].lambda_r == 10);
  BOOST_TEST(summary.path.back().lambda_r == target);
  BOOST_TEST(is_success(summary.path.back().end));
  int iterations = 0, failures = 0;
  double accepted = summary.path[1].lambda_r;
  for (std::size_t i = 1; i < summary.path.size(); ++i) {
    iterations += summary.path[i].iterations;
    BOOST_TEST(summary.path[i].lambda_r <= accepted);
    if (is_success(summary.path[i].end))
      accepted = summary.path[i].lambda_r;
    else
      ++failures;
  }
  BOOST_TEST(failures >= 1);  // a factor of ten is too much here: the step had to be halved
  BOOST_TEST(summary.total_iterations() == iterations + summary.path.front().iterations);
}

BOOST_AUTO_TEST_CASE(a_path_need_not_be_followed_closely_to_end_at_the_same_point) {
  constexpr double target = 1e-5;
  int tight_iterations = 0;
  for (const double tolerance_on_the_way : {0., 1e-2}) {
    RegularisedFriction problem(target);
    CompensatedVector state(1);
    const ContinuationSummary summary = newton_along_path(
        problem, state, full_steps, {.first = 10, .tolerance_on_the_way = tolerance_on_the_way});
    BOOST_CHECK(summary.newton.end == End::converged);
    BOOST_TEST(state.value()[0] == problem.solution(), tolerance(1e-10));
    BOOST_TEST(summary.path.front().lambda_r == 10);
    BOOST_TEST(summary.path.back().lambda_r == target);
    if (tolerance_on_the_way == 0)
      tight_iterations = summary.total_iterations();
    else
      BOOST_TEST(summary.total_iterations() < tight_iterations);
  }
}

BOOST_AUTO_TEST_CASE(a_path_that_breaks_ends_honestly_at_the_last_state_it_reached) {
  constexpr double target = 1e-5;
  RegularisedFriction problem(target);
  CompensatedVector state = start();
  const ContinuationSummary summary =
      newton_with_continuation(problem, state, full_steps, {.first = 10, .smallest_step = 0.6});
  BOOST_TEST(!is_success(summary.newton.end));
  BOOST_TEST(!is_success(summary.path.back().end));
  // State, residual and λr are of one problem: that of the last solution.
  BOOST_TEST(summary.lambda_r == 10);
  BOOST_TEST(problem.rheology().lambda_r == 10);
  BOOST_TEST(state.value()[0] == RegularisedFriction(10).solution(), tolerance(1e-10));
  BOOST_TEST(summary.newton.final_residual() == problem.evaluate(state).relative_norm());
}

BOOST_AUTO_TEST_CASE(running_out_of_solves_is_no_success) {
  constexpr double target = 1e-5;
  RegularisedFriction problem(target);
  CompensatedVector state = start();
  const ContinuationSummary summary =
      newton_with_continuation(problem, state, full_steps, {.first = 10, .max_solutions = 1});
  BOOST_TEST(is_success(summary.path.back().end));  // at λr = 10, not at the target
  BOOST_CHECK(summary.newton.end == End::stagnated);
  BOOST_TEST(summary.lambda_r == 10);
  BOOST_TEST(problem.rheology().lambda_r == 10);
  BOOST_TEST(summary.newton.final_residual() == problem.evaluate(state).relative_norm());
}

BOOST_AUTO_TEST_CASE(nothing_is_tried_above_the_first_lambda_r_and_a_failure_there_ends_it) {
  RegularisedFriction problem(1e-5);
  CompensatedVector state = start();
  const ContinuationSummary above =
      newton_with_continuation(problem, state, full_steps, {.first = 1e-6});
  BOOST_TEST(!is_success(above.newton.end));
  BOOST_TEST(above.path.empty());

  state = start();
  const ContinuationSummary at_first =
      newton_with_continuation(problem, state, full_steps, {.first = 1e-3});
  BOOST_TEST(!is_success(at_first.newton.end));
  BOOST_TEST(at_first.path.size() == 2);
  BOOST_TEST(at_first.lambda_r == 1e-3);  // where Newton left it
  BOOST_TEST(problem.rheology().lambda_r == 1e-3);
  BOOST_TEST(at_first.newton.history.size() == at_first.path.back().iterations + 1u);
}

BOOST_AUTO_TEST_SUITE_END()
