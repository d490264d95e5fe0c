#include "common/solve/compensated_vector.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(compensated_vector_test)

using namespace talus::solve;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

CompensatedVector constant(Eigen::Index size, double value) {
  return CompensatedVector(Eigen::VectorXd::Constant(size, value));
}

}  // namespace

BOOST_AUTO_TEST_CASE(increments_far_below_an_ulp_are_kept_and_plain_loses_them) {
  constexpr double increment = 1e-3 * epsilon;
  constexpr int steps = 1000;
  CompensatedVector kept(2);
  CompensatedVector lost(2, Precision::plain);
  for (CompensatedVector* v : {&kept, &lost}) v->set(0, 1);
  const CompensatedVector unit = [] {
    CompensatedVector v(2);
    v.set(0, 1);
    return v;
  }();
  for (int i = 0; i < steps; ++i) {
    kept = kept.moved(increment, unit);
    lost = lost.moved(increment, unit);
  }
  BOOST_TEST(kept.value()[0] == 1 + epsilon);
  BOOST_TEST(lost.value()[0] == 1);
  kept.set(1, 1);
  const auto sum = static_cast<double>(kept.difference(0, 1));
  BOOST_TEST(sum == steps * increment, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(differences_of_nearby_values_are_exact) {
  CompensatedVector v = constant(4, 0.1);
  v.set_relative(1, 0, 1e-30);
  v.set_relative(2, 1, 3e-25);
  v.set_relative(3, 0, -1e-20);
  BOOST_TEST(static_cast<double>(v.difference(1, 0)) == 1e-30);
  BOOST_TEST(static_cast<double>(v.difference(0, 3)) == 1e-20);
  BOOST_TEST(static_cast<double>(v.difference(2, 0)) == 3e-25 + 1e-30,
             boost::test_tools::tolerance(1e-15));
  BOOST_TEST(v.value()[2] == 0.1);
}

BOOST_AUTO_TEST_CASE(a_move_by_a_step_keeps_the_rounding_of_the_product) {
  constexpr double step = 1. / 3, direction = 0.7, start = 1.1;
  const CompensatedVector moved = constant(1, start).moved(step, constant(1, direction));
  // Extended precision holds the 106-bit sum only in part: compare what the double left over.
  const long double exact = start + static_cast<long double>(step) * direction;
  CompensatedVector both(2);
  both = CompensatedVector(Eigen::Vector2d(start, moved.value()[0]))
             .moved(step, CompensatedVector(Eigen::Vector2d(direction, 0)));
  const long double rest = both.difference(0, 1);
  BOOST_TEST(rest != 0);
  BOOST_TEST(static_cast<double>(exact - moved.value()[0]) == static_cast<double>(rest),
             boost::test_tools::tolerance(1e-2));
  BOOST_TEST(moved.value()[0] == static_cast<double>(exact));
}

BOOST_AUTO_TEST_CASE(a_plain_vector_is_ordinary_arithmetic) {
  const CompensatedVector direction = constant(1, 0.7);
  CompensatedVector plain(1, Precision::plain);
  plain.set(0, 1.1);
  BOOST_TEST(plain.moved(0.3, direction).value()[0] == 1.1 + 0.3 * 0.7);
  BOOST_CHECK(plain.moved(0.3, direction).precision() == Precision::plain);
  plain.set_relative(0, 0, 1e-30);
  BOOST_TEST(plain.value()[0] == 1.1);
}

BOOST_AUTO_TEST_CASE(a_step_back_returns_to_the_start) {
  const CompensatedVector start = constant(1, 1.1), direction = constant(1, 1e5);
  const CompensatedVector back = start.moved(1. / 3, direction).moved(-1. / 3, direction);
  BOOST_TEST(back.value()[0] == 1.1);
  CompensatedVector plain(1, Precision::plain);
  plain.set(0, 1.1);
  BOOST_TEST(plain.moved(1. / 3, direction).moved(-1. / 3, direction).value()[0] != 1.1);
}

BOOST_AUTO_TEST_CASE(resolution_is_that_of_one_or_of_two_doubles) {
  BOOST_TEST(CompensatedVector(1, Precision::plain).resolution() == epsilon);
  BOOST_TEST(CompensatedVector(1).resolution() == epsilon * epsilon);
}

BOOST_AUTO_TEST_CASE(zero_and_set_forget_the_correction) {
  CompensatedVector v = constant(2, 1);
  v.set_relative(0, 1, 1e-20);
  v.set(0, 1);
  BOOST_TEST(static_cast<double>(v.difference(0, 1)) == 0);
  v.set_relative(0, 1, 1e-20);
  v.set_zero();
  BOOST_TEST(static_cast<double>(v.difference(0, 1)) == 0);
  BOOST_TEST(v.value().norm() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
