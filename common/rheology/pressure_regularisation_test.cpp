#include "common/rheology/pressure_regularisation.hpp"

#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/rheology/rheology.hpp"
#include "common/testing/difference.hpp"

BOOST_AUTO_TEST_SUITE(pressure_regularisation_test)

using namespace talus;
using namespace talus::rheology;
using boost::test_tools::tolerance;

namespace {

double printed_formula(double p, double lambda_r) {
  return 0.5 * (p + std::sqrt(p * p + lambda_r * lambda_r));
}

}  // namespace

// The paper's slip on eq. (16): the limit for p < 0 is λr²/(4|p|), and the printed form loses it.
BOOST_AUTO_TEST_CASE(the_printed_formula_cancels_to_zero_and_ours_keeps_its_digits) {
  BOOST_TEST(printed_formula(-1, 1e-8) == 0);
  for (const double p : {-1., -28., -1e3})
    for (const double lambda_r : {1e-8, 1e-10})
      BOOST_TEST(regularise_pressure(p, lambda_r).value == lambda_r * lambda_r / (4 * -p),
                 tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(both_forms_agree_where_nothing_cancels) {
  for (const double lambda_r : {1e-2, 1e-6})
    for (const double share : {-1., -0.3, 0., 0.3, 1., 100.})
      BOOST_TEST(regularise_pressure(share * lambda_r, lambda_r).value ==
                     printed_formula(share * lambda_r, lambda_r),
                 tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(the_two_forms_meet_at_zero_pressure) {
  constexpr double lambda_r = 1e-6, tiny = 1e-300;
  BOOST_TEST(regularise_pressure(0, lambda_r).value == lambda_r / 2);
  BOOST_TEST(regularise_pressure(-tiny, lambda_r).value == lambda_r / 2);
  BOOST_TEST(regularise_pressure(0, lambda_r).derivative == 0.5);
  BOOST_TEST(regularise_pressure(-tiny, lambda_r).derivative == 0.5);
}

BOOST_AUTO_TEST_CASE(its_derivative_is_the_derivative_and_lies_between_0_and_1) {
  for (const double lambda_r : {1e-2, 1e-8})
    for (const double p : {-28., -1., -1e-9, 0., 1e-9, 1., 28.})
      BOOST_TEST_CONTEXT("p " << p << ", λr " << lambda_r) {
        const RegularisedPressure regularised = regularise_pressure(p, lambda_r);
        const auto value = [&](double q) { return regularise_pressure(q, lambda_r).value; };
        BOOST_TEST(regularised.derivative == testing::difference(value, p, std::hypot(p, lambda_r)),
                   tolerance(1e-9));
        BOOST_TEST(regularised.value > 0);
        BOOST_TEST(regularised.derivative > 0);
        BOOST_TEST(regularised.derivative <= 1);  // 1 by rounding at large pressure
      }
  BOOST_TEST(regularise_pressure(1, 1e-2).derivative < 1);
}

BOOST_AUTO_TEST_CASE(without_lambda_r_it_is_the_positive_part) {
  BOOST_TEST(regularise_pressure(3, 0).value == 3);
  BOOST_TEST(regularise_pressure(-3, 0).value == 0);
  BOOST_TEST(regularise_pressure(0, 0).derivative == 0.5);
}

BOOST_AUTO_TEST_CASE(the_chain_rule_reaches_the_total_pressure) {
  for (const Regularisation& regularisation : regularisations())
    for (const double lambda_r : {1e-2, 1e-8})
      for (const double shear_rate : {0., lambda_r, 0.1})
        for (const double p : {-1., 0., 1e-9, 1.})
          BOOST_TEST_CONTEXT(name_of(regularisation) << ", λr " << lambda_r << ", shear rate "
                                                     << shear_rate << ", p " << p) {
            const Rheology rheology{{}, regularisation, lambda_r};
            const auto eta = [&](double q) { return rheology.evaluate(shear_rate, q).eta; };
            const Viscosity v = rheology.evaluate(shear_rate, p);
            BOOST_TEST(std::isfinite(v.eta));
            BOOST_TEST(v.eta > 0);
            BOOST_TEST(v.d_eta_d_pressure == testing::difference(eta, p, std::hypot(p, lambda_r)),
                       tolerance(1e-9));
          }
}

BOOST_AUTO_TEST_CASE(the_pressure_may_have_a_floor_of_its_own) {
  Rheology rheology{{}, ChauchatMedale{}, 1e-6};
  const double own = rheology.evaluate(0.1, -1).eta;
  BOOST_TEST(rheology.regularised_pressure(-1).value == regularise_pressure(-1, 1e-6).value);
  rheology.pressure_floor = 1e-2;
  BOOST_TEST(rheology.regularised_pressure(-1).value == regularise_pressure(-1, 1e-2).value);
  BOOST_TEST(rheology.evaluate(0.1, -1).eta > 1e7 * own);
  const Viscosity floored = rheology.evaluate(0.1, 1e-3);
  const auto eta = [&](double q) { return rheology.evaluate(0.1, q).eta; };
  BOOST_TEST(floored.d_eta_d_pressure == testing::difference(eta, 1e-3, 1e-2), tolerance(1e-9));
  rheology.lambda_r = 0.1;  // larger than the floor
  BOOST_TEST(rheology.regularised_pressure(-1).value == regularise_pressure(-1, 0.1).value);
}

BOOST_AUTO_TEST_CASE(a_pressure_that_is_not_regularised_carries_no_friction_where_it_is_negative) {
  for (const Regularisation& regularisation : regularisations()) {
    Rheology rheology{{}, regularisation, 1e-6};
    rheology.regularises_pressure = false;
    for (const double p : {-1., 0.}) {
      const Viscosity none = rheology.evaluate(0.1, p);
      BOOST_TEST(none.eta == 0);
      BOOST_TEST(std::isfinite(none.d_eta_d_pressure));
    }
    BOOST_TEST(rheology.evaluate(0.1, 1).eta > 0);
    rheology.regularises_pressure = true;
    BOOST_TEST(rheology.evaluate(0.1, -1).eta > 0);
  }
}

BOOST_AUTO_TEST_CASE(regimes_change_at_mu_s_and_mu_2) {
  const FrictionLaw law;
  BOOST_CHECK(regime_under(law, 0) == Regime::at_rest);
  BOOST_CHECK(regime_under(law, law.mu_s) == Regime::at_rest);
  BOOST_CHECK(regime_under(law, std::nextafter(law.mu_s, 1)) == Regime::flowing);
  BOOST_CHECK(regime_under(law, std::nextafter(law.mu_2(), 0)) == Regime::flowing);
  BOOST_CHECK(regime_under(law, law.mu_2()) == Regime::no_steady_state);
  BOOST_CHECK(regime_under(law, 10) == Regime::no_steady_state);
}

BOOST_AUTO_TEST_CASE(regimes_have_names_of_their_own) {
  BOOST_TEST(name_of(Regime::at_rest) == "at_rest");
  BOOST_TEST(name_of(Regime::flowing) == "flowing");
  BOOST_TEST(name_of(Regime::no_steady_state) == "no_steady_state");
}

// Where nothing presses (16) leaves a pressure of λr/2, and with it a yield stress.
BOOST_AUTO_TEST_CASE(yield_is_judged_by_the_regularised_pressure) {
  const Rheology law({}, ChauchatMedale{}, 0.1);
  const double yield = law.law.mu_s * 0.05;  // at p = 0
  for (const auto& [rate, has_yielded] : {std::pair{0.01, false}, {0.05, false}, {10., true}}) {
    const LocalState at = law.local_state(rate, 0);
    BOOST_TEST((at.stress() > yield) == has_yielded);
    BOOST_TEST(at.has_yielded == has_yielded);
  }
}

BOOST_AUTO_TEST_SUITE_END()
