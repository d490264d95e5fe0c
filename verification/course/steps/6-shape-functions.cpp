#include "common/fem/lagrange.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_6)
using namespace course;
using namespace talus::fem;

const Eigen::Vector3d point{0.3, -0.6, 0.1};

// Node i + 3j + 9k of the element with 27 nodes.
Eigen::Vector3d node(int a) {
  return {a % 3 - 1., a / 3 % 3 - 1., a / 9 - 1.};
}

double polynomial(const Eigen::Vector3d& x) {
  return x[0] * x[0] * x[1] + 2 * x[2] * x[2] - x[1];
}

BOOST_AUTO_TEST_CASE(each_is_one_at_its_own_node_and_zero_at_the_others) {
  for (const int a : {0, 5, 13, 19})
    for (int b = 0; b < 27; ++b)
      BOOST_TEST(seen(QuadraticBasis<3>(node(a)).values[b]) == (a == b ? 1 : 0));
}

BOOST_AUTO_TEST_CASE(a_quadratic_polynomial_is_reproduced) {
  const QuadraticBasis<3> basis(point);
  double value = 0;
  for (int a = 0; a < 27; ++a) value += basis.values[a] * polynomial(node(a));
  BOOST_TEST(seen(value) == polynomial(point), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(its_gradient_is_too) {
  const QuadraticBasis<3> basis(point);
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (int a = 0; a < 27; ++a) gradient += basis.gradients.col(a) * polynomial(node(a));
  BOOST_TEST(seen(gradient[0]) == 2 * point[0] * point[1], tolerance(1e-12));
  BOOST_TEST(seen(gradient[1]) == point[0] * point[0] - 1, tolerance(1e-12));
  BOOST_TEST(seen(gradient[2]) == 4 * point[2], tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
