#include "common/rheology/friction_law.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_2)
using namespace course;

const talus::rheology::FrictionLaw law;

BOOST_AUTO_TEST_CASE(it_undoes_the_friction_law) {
  // Half of the rise of friction is reached at I0, a quarter at a third of it.
  BOOST_TEST(seen(law.inertial_number_at(law.mu_s + law.delta_mu / 2)) == law.I0, tolerance(1e-12));
  BOOST_TEST(seen(law.inertial_number_at(law.mu_s + law.delta_mu / 4)) == law.I0 / 3,
             tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(below_the_yield_stress_nothing_flows) {
  BOOST_TEST(seen(law.inertial_number_at(0.2)) == 0);
  BOOST_TEST(seen(law.inertial_number_at(law.mu_s)) == 0);
}

BOOST_AUTO_TEST_CASE(no_flow_is_fast_enough_beyond_the_largest_friction) {
  BOOST_TEST(seen(law.inertial_number_at(law.mu_2())) == infinity);
  BOOST_TEST(seen(law.inertial_number_at(0.9)) == infinity);
}

BOOST_AUTO_TEST_SUITE_END()
