#include <cmath>

#include "common/solve/test_problems.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_12)
using namespace course;
using namespace talus::solve;

Eigen::VectorXd loads(double first, double second) {
  return Eigen::Vector2d(first, second);
}

NewtonSummary solved(ConvexProblem& problem, CompensatedVector& w, LineSearch search) {
  const NewtonSummary summary = newton(problem, w, {.line_search = search});
  seen(summary.iterations());
  for (const NewtonIteration& each : summary.history) seen(each.residual);
  return summary;
}

BOOST_AUTO_TEST_CASE(a_linear_problem_takes_one_step) {
  ConvexProblem problem{[](double w) { return 2 * w; }, [](double) { return 2.; }, loads(3, -4)};
  CompensatedVector w(2);
  const NewtonSummary summary = solved(problem, w, LineSearch::none);
  BOOST_TEST(seen(w.value()[0]) == 1.5, tolerance(1e-12));
  BOOST_TEST(w.value()[1] == -2, tolerance(1e-12));
  BOOST_TEST(summary.history.size() >= 2);
  BOOST_TEST(summary.history[1].residual < 1e-12);
}

BOOST_AUTO_TEST_CASE(near_the_solution_digits_double) {
  ConvexProblem problem{[](double w) { return w + w * w * w; },
                        [](double w) { return 1 + 3 * w * w; }, loads(2, 10)};
  CompensatedVector w(2);
  const NewtonSummary summary = solved(problem, w, LineSearch::none);
  BOOST_TEST(is_success(summary.end));
  BOOST_TEST(w.value()[0] == 1, tolerance(1e-12));
  BOOST_TEST(w.value()[1] == 2, tolerance(1e-12));
  for (std::size_t k = 1; k < summary.history.size(); ++k) {
    const double before = summary.history[k - 1].residual;
    if (before < 0.1) BOOST_TEST(summary.history[k].residual < before * before + 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(a_line_search_holds_a_step_that_overshoots) {
  ConvexProblem problem{[](double w) { return std::atan(w); },
                        [](double w) { return 1 / (1 + w * w); }, loads(0, 0)};
  CompensatedVector w(loads(20, 20));
  const NewtonSummary summary = solved(problem, w, LineSearch::energy_slope);
  BOOST_TEST(is_success(summary.end));
  BOOST_TEST(w.value().norm() < 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
