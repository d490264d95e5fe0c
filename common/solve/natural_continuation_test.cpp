#include "common/solve/natural_continuation.hpp"

#include <utility>

#include <boost/test/unit_test.hpp>

#include "common/solve/carried_stress.hpp"
#include "common/solve/test_paths.hpp"

BOOST_AUTO_TEST_SUITE(natural_continuation_test)

using namespace talus::solve;
using boost::test_tools::tolerance;
using Eigen::VectorXd;

BOOST_AUTO_TEST_CASE(natural_continuation_fails_at_the_first_fold_whatever_its_predictor) {
  for (const Predictor predictor : {Predictor::constant, Predictor::secant, Predictor::tangent}) {
    SmallProblem problem = cubic();
    const auto path = follow_natural(problem, cubic_start(), predictor, {.target = 18});
    BOOST_CHECK(path.end == PathEnd::step_too_small);
    BOOST_TEST(path.points.back().parameter < 2 + 1e-8);
    BOOST_TEST(path.points.back().parameter > 1.999);
    BOOST_TEST(path.next.state.value()[0] == -1, tolerance(0.05));
    BOOST_TEST(path.total_cost().failures >= 10);
    BOOST_TEST(problem.parameter() == path.next.parameter);
  }
}

BOOST_AUTO_TEST_CASE(a_halved_step_that_does_not_grow_at_once_stops_at_the_same_fold_for_less) {
  std::vector<int> failures;
  for (const bool grows : {true, false}) {
    SmallProblem problem = cubic();
    const auto path = follow_natural(problem, cubic_start(), Predictor::secant,
                                     {.target = 18, .grows_after_failure = grows});
    BOOST_CHECK(path.end == PathEnd::step_too_small);
    BOOST_TEST(path.points.back().parameter == 2, tolerance(1e-3));
    failures.push_back(path.total_cost().failures);
  }
  BOOST_TEST(failures[1] < failures[0]);
}

// The stress of a direction is the parameter it was found at.
struct CarryingProblem : SmallProblem {
  using State = WithStress<std::vector<double>>;
  std::vector<State> starts = {};  // of every solve, and what the path is left with
  bool is_new = false;

  void set_parameter(double parameter) {
    SmallProblem::set_parameter(parameter);
    is_new = true;
  }
  const Residual& evaluate(const State& state) {
    if (std::exchange(is_new, false)) starts.push_back(state);
    return SmallProblem::evaluate(state);
  }
  bool linear_solve(const VectorXd& b, State& direction) {
    direction.stress = {s};
    return SmallProblem::linear_solve(b, direction);
  }
};

BOOST_AUTO_TEST_CASE(a_failed_step_leaves_its_stress_to_the_next_one_but_not_its_velocity) {
  CarryingProblem problem{cubic()};
  const auto path = follow_natural<CarryingProblem>(
      problem, {.state = CarryingProblem::State(cubic_start().state), .parameter = -17},
      Predictor::constant, {.target = 18});
  BOOST_TEST(path.total_cost().failures > 0);
  BOOST_REQUIRE(problem.starts.size() == path.attempts.size() + 1);
  for (std::size_t i = 1; i < path.attempts.size(); ++i) {
    BOOST_REQUIRE(path.attempts[i - 1].iterations > 0);
    BOOST_REQUIRE(problem.starts[i].stress.size() == 1U);
    BOOST_TEST(problem.starts[i].stress[0] == path.attempts[i - 1].parameter);
    if (!is_success(path.attempts[i - 1].end))
      BOOST_TEST((problem.starts[i].value() == problem.starts[i - 1].value()));
  }
}

BOOST_AUTO_TEST_CASE(natural_continuation_lands_on_a_target_before_the_fold) {
  std::vector<int> corrections;
  for (const Predictor predictor : {Predictor::constant, Predictor::secant, Predictor::tangent}) {
    SmallProblem problem = cubic();
    const auto path =
        follow_natural(problem, cubic_start(), predictor, {.target = -2, .largest_step = 0.3});
    BOOST_CHECK(path.end == PathEnd::target_reached);
    BOOST_TEST(path.points.back().parameter == -2);
    BOOST_TEST(path.next.state.value()[0] == -2, tolerance(1e-11));
    corrections.push_back(0);
    for (const PathPoint& point : path.points) corrections.back() += point.corrections;
  }
  BOOST_TEST(corrections[2] <= corrections[1]);
  BOOST_TEST(corrections[1] < corrections[0]);
}

BOOST_AUTO_TEST_CASE(a_start_that_needs_no_correction_is_no_fold) {
  // Nothing is factored there: the sign of det J is the one the start brings along, if any.
  for (const int reference_sign : {0, 1, -1}) {
    SmallProblem problem = cubic();
    auto start = cubic_start();
    start.reference_sign = reference_sign;
    const auto path = follow_natural(problem, start, Predictor::secant, {.target = -2});
    BOOST_CHECK(path.end == PathEnd::target_reached);
    BOOST_TEST(path.points.front().corrections == 0);
    BOOST_TEST(path.points.front().determinant_sign == reference_sign);
    BOOST_TEST(path.points[1].is_fold_passed == (reference_sign == -1));
    for (std::size_t i = 2; i < path.points.size(); ++i) BOOST_TEST(!path.points[i].is_fold_passed);
  }
}

BOOST_AUTO_TEST_SUITE_END()
