#include "common/rheology/barker_gray.hpp"

#include <cmath>

#include <boost/test/unit_test.hpp>
#include <gsl/gsl_integration.h>

#include "common/rheology/rheology.hpp"
#include "common/testing/difference.hpp"

BOOST_AUTO_TEST_SUITE(barker_gray_test)

using namespace talus;
using namespace talus::rheology;
using boost::test_tools::tolerance;

namespace {

const FrictionLaw cylinder_law{.mu_s = 0.4, .delta_mu = 0.25, .I0 = 0.3, .grain_size = 0.1};
const FrictionLaw laws[] = {FrictionLaw{}, cylinder_law};

double quadrature(const std::function<double(double)>& f, double from, double to) {
  gsl_function function{
      [](double x, void* p) { return (*static_cast<const std::function<double(double)>*>(p))(x); },
      const_cast<std::function<double(double)>*>(&f)};
  gsl_integration_workspace* workspace = gsl_integration_workspace_alloc(200);
  double result = 0, error = 0;
  gsl_integration_qag(&function, from, to, 0, 1e-11, 200, GSL_INTEG_GAUSS61, workspace, &result,
                      &error);
  gsl_integration_workspace_free(workspace);
  return result;
}

}  // namespace

BOOST_AUTO_TEST_CASE(creep_ends_where_eq_4_becomes_well_posed) {
  BOOST_TEST(std::abs(BarkerGray(cylinder_law).creep_end() - 0.0264) < 5e-5);
  BOOST_TEST(std::abs(BarkerGray().creep_end() - 0.0197) < 5e-5);
  const FrictionLaw nowhere{.delta_mu = 0.01};  // nowhere well-posed
  BOOST_TEST(BarkerGray(nowhere).creep_end() == nowhere.best_posed());
}

BOOST_AUTO_TEST_CASE(friction_is_the_formula_of_the_paper_and_eq_4_above_it) {
  for (const FrictionLaw& law : laws) {
    const BarkerGray control(law);
    const double I1 = control.creep_end();
    const double A = I1 * std::exp(1.9 / std::pow(law.friction(I1), 2));
    for (const double I : {1e-30, 1e-12, 1e-6, 1e-3, 0.5 * I1, I1})
      BOOST_TEST(control.friction(law, I) == std::sqrt(1.9 / std::log(A / I)), tolerance(1e-14));
    for (const double I : {1.001 * I1, 0.1, 0.8, 10.})
      BOOST_TEST(control.friction(law, I) == law.friction(I));
    BOOST_TEST(control.friction(law, 0) == 0);
  }
}

BOOST_AUTO_TEST_CASE(viscosity_is_that_friction_at_the_rounded_shear_rate) {
  for (const FrictionLaw& law : laws) {
    const BarkerGray control(law);
    for (const double lambda_r : {1e-2, 1e-8})
      for (const double p : {1e-6, 1., 28.})
        for (const double shear_rate : {0., lambda_r, 1e-3, 1.}) {
          const double root = std::hypot(shear_rate, lambda_r);
          const double mu = control.friction(law, law.inertial_number(root, p));
          BOOST_TEST(control.evaluate(law, lambda_r, shear_rate, p).eta == mu * p / root,
                     tolerance(1e-13));
        }
  }
}

BOOST_AUTO_TEST_CASE(friction_is_continuous_at_its_kink_and_its_slope_is_not) {
  for (const FrictionLaw& law : laws) {
    const BarkerGray control(law);
    const double p = 1, rate = control.creep_end() * law.reference_shear_rate(p) / law.I0;
    const Viscosity below = control.evaluate(law, 1e-12, rate * (1 - 1e-10), p);
    const Viscosity above = control.evaluate(law, 1e-12, rate * (1 + 1e-10), p);
    BOOST_TEST(below.eta == above.eta, tolerance(1e-9));
    const auto n = [&](const Viscosity& v) { return 1 + v.d_eta_d_shear_rate * rate / v.eta; };
    BOOST_TEST_MESSAGE("n below and above I1: " << n(below) << ", " << n(above));
    BOOST_TEST(n(below) > 1.02 * n(above));
    BOOST_TEST(n(below) < 1.2 * n(above));
    BOOST_TEST(below.d_eta_d_pressure == below.eta / p * (1 - n(below) / 2), tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(it_is_well_posed_where_eq_4_is_not) {
  for (const FrictionLaw& law : laws) {
    const Rheology control(law, BarkerGray{});
    for (double I = 1e-12; I <= 0.8; I *= 1.1) BOOST_TEST(control.well_posedness(I) <= 0);
    for (const double I : {1e-6, 1e-3, 0.01}) BOOST_TEST(law.well_posedness(I) > 0);
    BOOST_TEST(control.well_posedness(1) > 0);  // too large for both
    BOOST_TEST(well_posedness(BarkerGray{}, law, 0.01) == control.well_posedness(0.01));
    BOOST_TEST(well_posedness(ChauchatMedale{}, law, 0.01) == law.well_posedness(0.01));
  }
}

BOOST_AUTO_TEST_CASE(well_posedness_has_the_slope_of_the_law_itself) {
  const BarkerGray control;
  const FrictionLaw law;
  for (const double I : {1e-6, 1e-3, 0.01, 0.1}) {
    const auto mu = [&](double x) { return control.friction(law, x); };
    const double n = I * testing::difference(mu, I, I / 4) / mu(I);
    BOOST_TEST(control.well_posedness(law, I) == well_posedness_indicator(mu(I), n),
               tolerance(1e-7));
  }
}

BOOST_AUTO_TEST_CASE(the_inverse_law_and_its_integral_are_what_they_say) {
  for (const FrictionLaw& law : laws) {
    const BarkerGray control(law);
    const auto inverse = [&](double mu) { return control.inertial_number(law, mu); };
    for (const double I : {1e-20, 1e-6, 1e-3, 0.02, 0.03, 0.3, 3.})
      BOOST_TEST(inverse(control.friction(law, I)) == I, tolerance(1e-12));
    BOOST_TEST(inverse(0) == 0);
    BOOST_TEST(std::isinf(inverse(law.mu_2())));
    const double kink = control.kink(law);
    for (const double mu : {0.02, 0.2, 0.39, kink, 0.45, 0.6}) {
      const double split = std::min(mu, kink);
      const double integral =
          quadrature(inverse, 0, split) + (mu > split ? quadrature(inverse, split, mu) : 0);
      BOOST_TEST(control.inertial_number_integral(law, mu) == integral, tolerance(1e-10));
    }
    BOOST_TEST(control.inertial_number_integral(law, 0) == 0);
  }
}

BOOST_AUTO_TEST_CASE(nothing_breaks_at_the_smallest_pressure_that_eq_16_leaves) {
  for (const FrictionLaw& law : laws)
    for (const double lambda_r : {1e-2, 1e-8, 1e-15}) {
      const Rheology control(law, BarkerGray{}, lambda_r);
      for (const double total_pressure : {-1., 0., lambda_r * lambda_r / 4, 1.})
        for (const double shear_rate : {0., lambda_r, 1., 1e6}) {
          const Viscosity v = control.evaluate(shear_rate, total_pressure);
          BOOST_TEST(v.eta > 0);
          BOOST_TEST(std::isfinite(v.d_eta_d_shear_rate));
          BOOST_TEST(std::isfinite(v.d_eta_d_pressure));
          BOOST_TEST(v.eta + v.d_eta_d_shear_rate * shear_rate >= -1e-15 * v.eta);
        }
      const Viscosity no_pressure =
          std::get<BarkerGray>(control.regularisation).evaluate(law, lambda_r, 0, 0);
      BOOST_TEST(no_pressure.eta == 0);
      BOOST_TEST(no_pressure.d_eta_d_pressure == law.mu_2() / lambda_r, tolerance(1e-14));
    }
}

BOOST_AUTO_TEST_CASE(a_rheology_prepares_it_for_its_own_law) {
  const Rheology control(cylinder_law, BarkerGray{});
  BOOST_TEST(std::get<BarkerGray>(control.regularisation).creep_end() ==
             BarkerGray(cylinder_law).creep_end());
  BOOST_TEST(control.limit_kink() > BarkerGray().kink({}));
}

BOOST_AUTO_TEST_CASE(only_what_has_a_yield_stress_is_ever_at_rest) {
  const Rheology control({}, BarkerGray{});
  BOOST_CHECK(regime_under(control, 0.3) == Regime::flowing);
  BOOST_CHECK(regime_under(control, 0) == Regime::at_rest);
  BOOST_CHECK(regime_under(control, 0.7) == Regime::no_steady_state);
  BOOST_CHECK(regime_under(Rheology{}, 0.3) == Regime::at_rest);
}

BOOST_AUTO_TEST_SUITE_END()
