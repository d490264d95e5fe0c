#include <Eigen/Core>

#include "common/shear/second_order_cone.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_14)
using namespace course;
using talus::shear::step_to_cone;

Eigen::Vector2d v(double x, double y) {
  return {x, y};
}

BOOST_AUTO_TEST_CASE(it_ends_on_the_boundary) {
  BOOST_TEST(seen(step_to_cone(1, v(0, 0), -1, v(0, 0))) == 1, tolerance(1e-14));
  const double step = seen(step_to_cone(1, v(0.3, 0.2), -0.1, v(0.5, -0.4)));
  BOOST_TEST((v(0.3, 0.2) + step * v(0.5, -0.4)).norm() == 1 - 0.1 * step, tolerance(1e-12));
  BOOST_TEST(step > 0);
}

BOOST_AUTO_TEST_CASE(the_first_of_two_ways_out_is_taken) {
  BOOST_TEST(seen(step_to_cone(1, v(0.5, 0), 0, v(1, 0))) == 0.5, tolerance(1e-14));
  BOOST_TEST(seen(step_to_cone(1, v(0.5, 0), 0, v(-1, 0))) == 1.5, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(inwards_there_is_no_end) {
  BOOST_TEST(seen(step_to_cone(1, v(0.5, 0), 1, v(0.2, 0.1))) == infinity);
  BOOST_TEST(seen(step_to_cone(1, v(0.5, 0), 0, v(0, 0))) == infinity);
}

BOOST_AUTO_TEST_CASE(near_the_boundary_nothing_cancels) {
  const double gap = 0x1p-50;
  BOOST_TEST(seen(step_to_cone(1, v(1 - gap, 0), 0, v(3, 4))) == gap / 3, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
