#include "common/rheology/regularisation.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_3)
using namespace course;
using namespace talus::rheology;

const FrictionLaw law;
constexpr double lambda_r = 1e-2, pressure = 2;

Viscosity at(double shear_rate, double p = pressure) {
  return BercovierEngelman::evaluate(law, lambda_r, shear_rate, p);
}

BOOST_AUTO_TEST_CASE(at_rest_the_viscosity_is_that_of_the_plug) {
  const double viscous = simple_viscous_part(law, lambda_r, 0, pressure).eta;
  BOOST_TEST(seen(at(0).eta - viscous) == law.mu_s * pressure / lambda_r, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(in_flow_the_yield_stress_is_that_of_the_law) {
  const double viscous = simple_viscous_part(law, lambda_r, 0.5, pressure).eta;
  BOOST_TEST(seen((at(0.5).eta - viscous) * 0.5) == law.mu_s * pressure, tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(the_slope_in_the_shear_rate_is_a_derivative) {
  for (const double rate : {3e-3, 1e-2, 0.2}) {
    const double h = 1e-4 * rate;
    BOOST_TEST(seen(at(rate).d_eta_d_shear_rate) == (at(rate + h).eta - at(rate - h).eta) / (2 * h),
               tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(the_slope_in_the_pressure_is_a_derivative) {
  BOOST_TEST(seen(at(1e-2).d_eta_d_pressure) ==
                 (at(1e-2, pressure + 1e-4).eta - at(1e-2, pressure - 1e-4).eta) / 2e-4,
             tolerance(1e-6));
}

BOOST_AUTO_TEST_SUITE_END()
