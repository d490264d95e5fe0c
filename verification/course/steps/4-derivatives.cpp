#include "common/rheology/regularisation.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_4)
using namespace course;
using namespace talus::rheology;

const FrictionLaw law;
constexpr double lambda_r = 1e-2, pressure = 2;

Viscosity at(double shear_rate, double p = pressure) {
  return ChauchatMedale::evaluate(law, lambda_r, shear_rate, p);
}

BOOST_AUTO_TEST_CASE(the_viscosity_is_that_of_equation_12) {
  const double c = law.reference_shear_rate(pressure);
  BOOST_TEST(seen(at(0.3).eta) ==
                 (law.mu_s + law.delta_mu * 0.3 / (c + 0.3)) * pressure / std::hypot(0.3, lambda_r),
             tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_slope_in_the_shear_rate_is_a_derivative) {
  for (const double rate : {3e-3, 1e-2, 0.2, 1.}) {
    const double h = 1e-4 * rate;
    BOOST_TEST(seen(at(rate).d_eta_d_shear_rate) == (at(rate + h).eta - at(rate - h).eta) / (2 * h),
               tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(the_slope_in_the_pressure_is_a_derivative) {
  for (const double rate : {1e-2, 0.5})
    BOOST_TEST(seen(at(rate).d_eta_d_pressure) ==
                   (at(rate, pressure + 1e-4).eta - at(rate, pressure - 1e-4).eta) / 2e-4,
               tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(at_rest_without_pressure_all_is_finite) {
  const Viscosity rest = at(0, 0);
  BOOST_TEST(seen(rest.eta) == 0);
  BOOST_TEST(seen(rest.d_eta_d_shear_rate) == 0);
  BOOST_TEST(seen(rest.d_eta_d_pressure) == law.mu_s / lambda_r, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
