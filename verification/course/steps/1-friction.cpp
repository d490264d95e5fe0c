#include "common/rheology/friction_law.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_1)
using namespace course;

const talus::rheology::FrictionLaw law;

BOOST_AUTO_TEST_CASE(at_rest_friction_is_static) {
  BOOST_TEST(seen(law.friction(0)) == law.mu_s, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(half_of_the_rise_is_reached_at_I0) {
  BOOST_TEST(seen(law.friction(law.I0)) == 0.513, tolerance(1e-14));
  BOOST_TEST(seen(law.friction(0.1)) == 0.383 + 0.026 / 0.379, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(infinitely_fast_flow_has_the_largest_friction) {
  BOOST_TEST(seen(law.friction(1e9)) == law.mu_2(), tolerance(1e-9));
  BOOST_TEST(seen(law.friction(infinity)) == law.mu_2(), tolerance(1e-14));
}

BOOST_AUTO_TEST_SUITE_END()
