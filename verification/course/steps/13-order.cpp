#include <vector>

#include "verification/course/step.hpp"
#include "verification/harness/fit.hpp"

BOOST_AUTO_TEST_SUITE(step_13)
using namespace course;
using talus::verification::fitted_order;

BOOST_AUTO_TEST_CASE(a_power_is_found) {
  const std::vector<double> h{0.5, 0.25, 0.1, 0.02};
  std::vector<double> error;
  for (const double each : h) error.push_back(3 * std::pow(each, 2.5));
  BOOST_TEST(seen(fitted_order(h, error)) == 2.5, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(two_meshes_give_their_own_order) {
  BOOST_TEST(seen(fitted_order({1, 0.5}, {8, 1})) == 3, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(noise_is_averaged_by_least_squares) {
  const double e = std::exp(1.);
  BOOST_TEST(seen(fitted_order({1, e, e * e}, {1, e * e, e * e * e})) == 1.5, tolerance(1e-12));
  BOOST_TEST(seen(fitted_order({1, e, e * e, e * e * e}, {1, e, 1, e})) == 0.2, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(units_do_not_matter) {
  BOOST_TEST(seen(fitted_order({1000, 500, 250}, {0.04, 0.01, 0.0025})) == 2, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
