#include "common/rheology/pressure_regularisation.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_5)
using namespace course;
using talus::rheology::regularise_pressure;

BOOST_AUTO_TEST_CASE(a_large_pressure_stays_as_it_is) {
  BOOST_TEST(seen(regularise_pressure(3, 1e-3).value) == 3 + 2.5e-7 / 3, tolerance(1e-12));
  BOOST_TEST(seen(regularise_pressure(0, 1e-3).value) == 5e-4, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_negative_one_becomes_small_and_positive) {
  BOOST_TEST(seen(regularise_pressure(-1, 0.5).value) == (std::sqrt(1.25) - 1) / 2,
             tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(nothing_cancels) {
  BOOST_TEST(seen(regularise_pressure(-1, 1e-8).value) / 2.5e-17 == 1, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_slope_is_a_derivative) {
  for (const double p : {-0.3, 0.1, 2.})
    BOOST_TEST(
        seen(regularise_pressure(p, 0.2).derivative) ==
            (regularise_pressure(p + 1e-5, 0.2).value - regularise_pressure(p - 1e-5, 0.2).value) /
                2e-5,
        tolerance(1e-7));
  BOOST_TEST(seen(regularise_pressure(0, 0).derivative) == 0.5);
}

BOOST_AUTO_TEST_SUITE_END()
