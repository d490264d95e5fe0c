#include "common/solve/path.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_16)
using namespace course;
using namespace talus::solve;

// Points of a path whose parameter is s(σ), a step of `length` apart, at an angle of this cosine.
std::optional<double> fold(double s0, double slope0, double s1, double slope1, double length,
                           double cosine) {
  const PathPoint before{.parameter = s0, .parameter_slope = slope0};
  const PathPoint after{
      .parameter = s1, .parameter_slope = slope1, .step = length, .cosine = cosine};
  return fold_between(before, after);
}

BOOST_AUTO_TEST_CASE(the_top_of_a_parabola_is_found) {
  // s = 1 - (σ - 0.4)² from 0 to 1
  const auto top = fold(0.84, 0.8, 0.64, -1.2, 1, 1);
  BOOST_TEST_REQUIRE(top.has_value());
  BOOST_TEST(seen(*top) == 1, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(that_of_a_cubic_too_in_any_length) {
  // s = σ - σ³ from 0 to 1.2: its top at 1/sqrt(3)
  const auto top = fold(0, 1, 1.2 - 1.728, 1 - 3 * 1.44, 1.2, 1);
  BOOST_TEST_REQUIRE(top.has_value());
  BOOST_TEST(seen(*top) == 2 / (3 * std::sqrt(3.)), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(slopes_are_measured_along_the_tangent_before) {
  const auto top = fold(0.84, 0.8, 0.64, -1.2 * 0.8, 1, 0.8);
  BOOST_TEST_REQUIRE(top.has_value());
  BOOST_TEST(seen(*top) == 1, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(where_the_slope_keeps_its_sign_there_is_none) {
  BOOST_TEST(seen(fold(0, 1, 0.8, 0.6, 1, 1).has_value()) == 0);
  BOOST_TEST(seen(fold(0, 1, 0.8, -0.6, 1, -0.1).has_value()) == 0);
}

BOOST_AUTO_TEST_SUITE_END()
