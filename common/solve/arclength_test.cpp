#include "common/solve/arclength.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <boost/test/unit_test.hpp>

#include "common/solve/natural_continuation.hpp"
#include "common/solve/test_paths.hpp"

BOOST_AUTO_TEST_SUITE(arclength_test)

using namespace talus::solve;
using boost::test_tools::tolerance;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

BOOST_AUTO_TEST_CASE(both_folds_of_an_s_are_passed_and_the_target_is_met_exactly) {
  SmallProblem problem = cubic();
  const auto path = follow_arclength(problem, cubic_start(), {.target = 18});
  BOOST_CHECK(path.end == PathEnd::target_reached);
  BOOST_TEST(path.points.back().parameter == 18);
  BOOST_TEST(path.next.state.value()[0] == 3, tolerance(1e-11));
  BOOST_TEST(problem.parameter() == 18);
  const std::vector<double> folds = fold_parameters(path.points);
  BOOST_REQUIRE(folds.size() == 2);
  BOOST_TEST(folds[0] == 2, tolerance(1e-2));
  BOOST_TEST(folds[1] == -2, tolerance(1e-2));
  int passed = 0;
  for (const PathPoint& point : path.points) passed += point.is_fold_passed;
  BOOST_TEST(passed == 2);
  BOOST_TEST(path.total_cost().factorisations >= 2 * static_cast<int>(path.points.size()) - 2);
}

BOOST_AUTO_TEST_CASE(every_point_lies_on_the_path_and_the_observer_s_numbers_are_kept) {
  SmallProblem problem = circle();
  const auto path = follow_arclength<SmallProblem>(
      problem, {.state = CompensatedVector(constant(1, 1)), .parameter = 0}, {.max_points = 100},
      [](const auto& at, PathPoint& point) {
        point.observation = {at.state.value()[0]};
        return true;
      });
  BOOST_CHECK(path.end == PathEnd::out_of_points);
  BOOST_TEST(path.points.size() == 100);
  double last_angle = -1e-300, turned = 0;
  int folds = 0;
  for (const PathPoint& point : path.points) {
    const double x = point.observation.at(0);
    BOOST_TEST(std::abs(std::hypot(x, point.parameter) - 1) < 1e-10);
    BOOST_TEST(point.parameter_slope == x, tolerance(1e-9));
    const double angle = std::atan2(point.parameter, x);
    const double turn = std::remainder(angle - last_angle, 2 * std::numbers::pi);
    BOOST_TEST(turn > 0);  // once round and round again, never back
    turned += turn;
    last_angle = angle;
    folds += point.is_fold_passed;
  }
  BOOST_TEST(turned > 4 * std::numbers::pi);
  BOOST_TEST(folds == static_cast<int>(std::floor(turned / std::numbers::pi + 0.5)));
}

BOOST_AUTO_TEST_CASE(the_fold_of_bratu_s_problem_is_found_to_nine_digits) {
  BOOST_TEST(bratu_fold() == 3.513830719, tolerance(1e-9));
  std::vector<double> errors;
  for (const double step : {0.05, 0.025, 0.0125}) {
    SmallProblem problem = bratu();
    PathOptions options{.max_points = 1000, .largest_step = step};
    options.corrector.tolerance = 1e-13;
    const auto path = follow_arclength<SmallProblem>(
        problem,
        {.state = CompensatedVector(VectorXd(constant(19, 0))), .parameter = 3, .step = step},
        options, [](const auto& at, PathPoint&) { return at.state.value()[9] < 3; });
    BOOST_CHECK(path.end == PathEnd::stopped);
    const std::vector<double> folds = fold_parameters(path.points);
    BOOST_REQUIRE(folds.size() == 1);
    errors.push_back(std::abs(folds[0] - bratu_fold()));
  }
  BOOST_TEST_MESSAGE("errors of the fold " << errors[0] << ", " << errors[1] << ", " << errors[2]);
  BOOST_TEST(errors[2] < 3e-9);
  BOOST_TEST(errors[0] > 30 * errors[2]);  // O(step⁴), less where the fold lies mid-step
}

BOOST_AUTO_TEST_CASE(the_unit_of_the_parameter_does_not_matter) {
  SmallProblem problem = cubic(), in_hundredths = cubic();
  in_hundredths.value = [whole = problem.value](const VectorXd& x, double s) {
    return whole(x, 100 * s);
  };
  in_hundredths.by_parameter = [](const VectorXd&, double) { return constant(1, -100); };
  PathStart<CompensatedVector> start = cubic_start();
  start.parameter /= 100;
  const auto path = follow_arclength(problem, cubic_start(), {.target = 18});
  const auto same =
      follow_arclength(in_hundredths, start, {.target = 0.18, .parameter_scale = 0.01});
  BOOST_REQUIRE(same.points.size() == path.points.size());
  for (std::size_t i = 0; i < path.points.size(); ++i)
    BOOST_TEST(std::abs(100 * same.points[i].parameter - path.points[i].parameter) < 1e-8);
  const auto other = follow_arclength(in_hundredths, start, {.target = 0.18});
  BOOST_TEST(other.points.size() != path.points.size());
}

BOOST_AUTO_TEST_CASE(a_path_that_is_resumed_is_the_same_path) {
  SmallProblem problem = cubic();
  const auto whole = follow_arclength(problem, cubic_start(), {.target = 18});
  SmallProblem another = cubic();
  const auto first = follow_arclength<SmallProblem>(
      another, cubic_start(), {.target = 18},
      [](const auto&, PathPoint& point) { return point.parameter_slope > 0; });
  BOOST_CHECK(first.end == PathEnd::stopped);  // between the folds
  const auto rest = follow_arclength(another, first.next, {.target = 18});
  BOOST_CHECK(rest.end == PathEnd::target_reached);
  BOOST_REQUIRE(first.points.size() + rest.points.size() == whole.points.size() + 1);
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    const std::size_t taken = first.points.size();
    const PathPoint& point = i < taken ? first.points[i] : rest.points[i + 1 - taken];
    BOOST_TEST(point.parameter == whole.points[i].parameter);
    BOOST_TEST(point.step == whole.points[i].step);
  }
}

BOOST_AUTO_TEST_CASE(a_path_that_is_reversed_goes_back_over_its_folds) {
  SmallProblem problem = cubic();
  auto there = follow_arclength(problem, cubic_start(), {.target = 18});
  there.next.direction *= -1;
  const auto back = follow_arclength(problem, there.next, {.target = -18});
  BOOST_CHECK(back.end == PathEnd::target_reached);
  BOOST_TEST(back.next.state.value()[0] == -3, tolerance(1e-11));
  BOOST_TEST(fold_parameters(back.points).size() == 2);
}

BOOST_AUTO_TEST_CASE(orientation_by_a_wrong_determinant_turns_back_at_the_fold) {
  SmallProblem problem = cubic();
  problem.forgets_the_sign = true;
  double largest = -3;
  const auto path = follow_arclength<SmallProblem>(
      problem, cubic_start(), {.target = 18, .max_points = 200}, [&](const auto& at, PathPoint&) {
        largest = std::max(largest, at.state.value()[0]);
        return true;
      });
  BOOST_CHECK(path.end != PathEnd::target_reached);
  BOOST_TEST(largest < 0);  // one step past the fold at x = -1, and back
  BOOST_TEST(std::ranges::any_of(path.points, [](const auto& point) { return point.cosine < 0; }));
}

BOOST_AUTO_TEST_CASE(a_wrong_tangent_lowers_the_order_of_the_predictor) {
  struct Case {
    SmallProblem problem;
    double parameter;
    VectorXd guess;
  };
  for (auto& [problem, parameter, state] :
       {Case{cubic(), -18, constant(1, -3)}, Case{bratu(), 1, constant(19, 0)}}) {
    SmallProblem whole = problem;
    whole.set_parameter(parameter);
    CompensatedVector solution(state);
    BOOST_REQUIRE(is_success(newton(whole, solution, {.line_search = LineSearch::none}).end));
    BOOST_TEST(std::abs(predictor_order(whole, solution, 1e-2) - 2) < 0.05);
    for (const double factor : {-1., 0.9, 1.1}) {
      SmallProblem broken = whole;
      broken.by_parameter_factor = factor;
      BOOST_TEST(std::abs(predictor_order(broken, solution, 1e-2) - 1) < 0.3);
    }
  }
}

BOOST_AUTO_TEST_CASE(arclength_goes_on_from_where_natural_continuation_stopped) {
  SmallProblem problem = cubic();
  const auto stuck = follow_natural(problem, cubic_start(), Predictor::tangent, {.target = 18});
  auto start = stuck.next;
  start.step = 0.1;
  const auto path = follow_arclength(problem, start, {.target = 18});
  BOOST_CHECK(path.end == PathEnd::target_reached);
  BOOST_TEST(path.next.state.value()[0] == 3, tolerance(1e-11));
}

BOOST_AUTO_TEST_CASE(every_other_end_is_met_for_its_reason) {
  SmallProblem problem = cubic();
  BOOST_CHECK(follow_arclength(problem, cubic_start(), {.lower = -20, .upper = 0}).end ==
              PathEnd::left_bounds);
  // Nowhere a solution: the start fails, and so does a start on a fold, where J is singular.
  SmallProblem none = circle();
  BOOST_CHECK(follow_arclength<SmallProblem>(
                  none, {.state = CompensatedVector(constant(1, 1)), .parameter = 2})
                  .end == PathEnd::start_failed);
  BOOST_CHECK(follow_arclength<SmallProblem>(
                  none, {.state = CompensatedVector(constant(1, 0)), .parameter = 1})
                  .end == PathEnd::start_failed);
  // A path that ends: the residual is no number beyond s = 0.
  SmallProblem broken = cubic();
  broken.value = [whole = broken.value](const VectorXd& x, double s) {
    return s > 0 ? constant(1, std::nan("")) : whole(x, s);
  };
  const auto path = follow_arclength(broken, cubic_start(), {.target = 18});
  BOOST_CHECK(path.end == PathEnd::step_too_small);
  BOOST_TEST(path.total_cost().failures > 10);
  BOOST_TEST(std::abs(path.points.back().parameter) < 1e-5);
}

BOOST_AUTO_TEST_CASE(a_target_between_two_folds_is_met_on_the_branch_the_path_is_on) {
  SmallProblem problem = cubic();
  auto path = follow_arclength(problem, cubic_start(), {.target = 0});
  BOOST_TEST(path.next.state.value()[0] == -std::sqrt(3.), tolerance(1e-11));
  path = follow_arclength(problem, path.next, {.target = 0});
  BOOST_TEST(std::abs(path.next.state.value()[0]) < 1e-11);
  path = follow_arclength(problem, path.next, {.target = 0});
  BOOST_TEST(path.next.state.value()[0] == std::sqrt(3.), tolerance(1e-11));
}

BOOST_AUTO_TEST_SUITE_END()
