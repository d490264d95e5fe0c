#include "common/rheology/friction_law.hpp"

#include <cmath>
#include <limits>

#include <boost/test/unit_test.hpp>

#include "common/testing/difference.hpp"

BOOST_AUTO_TEST_SUITE(friction_law_test)

using namespace talus;
using boost::test_tools::tolerance;
using rheology::FrictionLaw;

namespace {

constexpr double pressures[] = {1e-6, 1, 28};
constexpr double shear_rates_over_c[] = {0, 1e-6, 1e-2, 1, 50};

FrictionLaw cylinder_law() {
  return {.mu_s = 0.4, .delta_mu = 0.25, .I0 = 0.3, .grain_size = 0.1};
}

// Calls check(law, pressure, shear rate, c) over both sets of parameters and all regimes of flow.
template <class Check>
void for_every_state(const Check& check) {
  for (const FrictionLaw& law : {FrictionLaw{}, cylinder_law()})
    for (const double p : pressures)
      for (const double ratio : shear_rates_over_c) {
        const double c = law.reference_shear_rate(p);
        BOOST_TEST_CONTEXT("d* " << law.grain_size << ", p " << p << ", rate/c " << ratio) {
          check(law, p, ratio * c, c);
        }
      }
}

}  // namespace

BOOST_AUTO_TEST_CASE(friction_rises_from_mu_s_to_mu_2) {
  const FrictionLaw law;
  BOOST_TEST(law.friction(0) == law.mu_s);
  BOOST_TEST(law.friction(law.I0) == law.mu_s + law.delta_mu / 2, tolerance(1e-15));
  BOOST_TEST(law.friction(0.1) == 0.383 + 0.26 / (0.279 / 0.1 + 1), tolerance(1e-15));  // eq. (4)
  BOOST_TEST(law.friction(1e3) < law.mu_2());
  BOOST_TEST(law.friction(1e12) == law.mu_2(), tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(friction_derivative_is_the_derivative) {
  const FrictionLaw law;
  for (const double I : {0., 1e-3, 0.279, 10.}) {
    const auto friction = [&](double x) { return law.friction(x); };
    BOOST_TEST(law.friction_derivative(I) == testing::difference(friction, I, law.I0 + I),
               tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(the_inverse_law_inverts_friction_and_its_integral_is_the_integral) {
  const FrictionLaw law;
  for (const double I : {1e-4, 1e-2, 0.279, 10.}) {
    const double mu = law.friction(I);
    BOOST_TEST(law.inertial_number_at(mu) == I, tolerance(1e-11));
    const auto integral = [&](double x) { return law.inertial_number_integral(x); };
    const double room = std::min(mu - law.mu_s, law.mu_2() - mu);
    BOOST_TEST(testing::difference(integral, mu, room) == I, tolerance(1e-8));
  }
  for (const double mu : {0., 0.3, law.mu_s}) {
    BOOST_TEST(law.inertial_number_at(mu) == 0);
    BOOST_TEST(law.inertial_number_integral(mu) == 0);
  }
  BOOST_TEST(std::isinf(law.inertial_number_at(law.mu_2())));
  BOOST_TEST(std::isinf(law.inertial_number_integral(law.mu_2())));
}

BOOST_AUTO_TEST_CASE(grain_size_enters_the_inertial_number_linearly) {
  FrictionLaw law;
  const double I = law.inertial_number(2, 3);
  BOOST_TEST(I == 2 / std::sqrt(0.6 * 3), tolerance(1e-15));
  const double stress = law.stress(2, 3);
  law.grain_size = 0.1;
  BOOST_TEST(law.inertial_number(2, 3) == 0.1 * I, tolerance(1e-15));
  BOOST_TEST(law.stress(20, 3) == stress, tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(stress_is_friction_times_pressure) {
  for_every_state([](const FrictionLaw& law, double p, double shear_rate, double) {
    BOOST_TEST(law.stress(shear_rate, p) == p * law.friction(law.inertial_number(shear_rate, p)),
               tolerance(1e-14));
  });
}

BOOST_AUTO_TEST_CASE(stress_is_the_slope_of_the_dissipation_and_has_the_slope_it_says) {
  for_every_state([](const FrictionLaw& law, double p, double shear_rate, double c) {
    const auto dissipation = [&](double t) { return law.dissipation(t, p); };
    const auto stress = [&](double t) { return law.stress(t, p); };
    BOOST_TEST(
        law.stress(shear_rate, p) == testing::difference(dissipation, shear_rate, c + shear_rate),
        tolerance(1e-9));
    BOOST_TEST(
        law.stress_slope(shear_rate, p) == testing::difference(stress, shear_rate, c + shear_rate),
        tolerance(1e-8));
  });
}

BOOST_AUTO_TEST_CASE(shear_rate_inverts_stress) {
  for_every_state([](const FrictionLaw& law, double p, double shear_rate, double c) {
    // Stress holds the shear rate to an ulp of μs p over the slope.
    BOOST_TEST(std::abs(law.shear_rate(law.stress(shear_rate, p), p) - shear_rate) <=
               1e-15 * law.mu_2() * p / law.stress_slope(shear_rate, p) + 1e-14 * c);
  });
}

BOOST_AUTO_TEST_CASE(nothing_moves_up_to_yield_and_nothing_holds_from_mu_2_on) {
  const FrictionLaw law;
  const double p = 28, infinity = std::numeric_limits<double>::infinity();
  for (const double tau : {0., 0.5 * law.mu_s * p, law.mu_s * p}) {
    BOOST_TEST(law.shear_rate(tau, p) == 0);
    BOOST_TEST(law.complementary_dissipation(tau, p) == 0);
  }
  for (const double tau : {law.mu_2() * p, 2 * law.mu_2() * p}) {
    BOOST_TEST(law.shear_rate(tau, p) == infinity);
    BOOST_TEST(law.complementary_dissipation(tau, p) == infinity);
  }
  BOOST_TEST(std::isfinite(law.shear_rate(law.mu_2() * p * (1 - 1e-12), p)));
}

BOOST_AUTO_TEST_CASE(dissipation_and_its_complement_obey_fenchel_and_young) {
  for_every_state([](const FrictionLaw& law, double p, double shear_rate, double c) {
    const double own = law.stress(shear_rate, p);
    const double size = own * (shear_rate + c);
    const auto excess = [&](double tau) {
      return law.dissipation(shear_rate, p) + law.complementary_dissipation(tau, p) -
             tau * shear_rate;
    };
    BOOST_TEST(std::abs(excess(own)) <= 1e-14 * size);
    for (const double share : {0.01, 0.3, 0.7, 0.99}) {
      const double tau = share * law.mu_2() * p;
      BOOST_TEST(excess(tau) >= -1e-14 * size);
      if (shear_rate > 0 && std::abs(tau - own) > 0.01 * own) BOOST_TEST(excess(tau) > 0);
    }
  });
}

BOOST_AUTO_TEST_CASE(well_posed_bands_are_those_of_barker_and_others) {
  const auto band = FrictionLaw{}.well_posed_band();
  BOOST_REQUIRE(band.has_value());
  BOOST_TEST(std::abs(band->first - 0.0197) < 5e-5);
  BOOST_TEST(std::abs(band->second - 0.846) < 5e-4);
  const FrictionLaw coarse{.mu_s = 0.4, .delta_mu = 0.25, .I0 = 0.3};
  const auto cylinder = coarse.well_posed_band();
  BOOST_REQUIRE(cylinder.has_value());
  BOOST_TEST(std::abs(cylinder->first - 0.0264) < 5e-5);
  BOOST_TEST(std::abs(cylinder->second - 0.806) < 5e-4);
  BOOST_TEST((cylinder_law().well_posed_band() == cylinder), "the band is one of I, not of d*");
}

BOOST_AUTO_TEST_CASE(the_band_is_where_the_indicator_changes_sign) {
  const FrictionLaw law;
  const auto [lower, upper] = *law.well_posed_band();
  BOOST_TEST(law.well_posedness(lower * (1 - 1e-6)) > 0);
  BOOST_TEST(law.well_posedness(lower * (1 + 1e-6)) < 0);
  BOOST_TEST(law.well_posedness(upper * (1 - 1e-6)) < 0);
  BOOST_TEST(law.well_posedness(upper * (1 + 1e-6)) > 0);
}

BOOST_AUTO_TEST_CASE(a_law_of_almost_constant_friction_is_nowhere_well_posed) {
  const FrictionLaw law{.delta_mu = 0.01};
  BOOST_TEST(!law.well_posed_band().has_value());
  for (const double I : {1e-4, 1e-2, 0.1, 0.279, 1., 10.}) BOOST_TEST(law.well_posedness(I) > 0);
}

// Where nothing presses the limits of I are taken: at rest none, in shear all there is.
BOOST_AUTO_TEST_CASE(without_pressure_inertial_number_friction_and_posedness_have_their_limits) {
  const FrictionLaw law;
  BOOST_TEST(law.inertial_number(0, 0) == 0);
  const double unbounded = law.inertial_number(1, 0);
  BOOST_TEST(std::isinf(unbounded));
  BOOST_TEST(law.friction(unbounded) == law.mu_2());
  BOOST_TEST(law.well_posedness(unbounded) == law.well_posedness(1e12), tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(n_is_largest_at_the_best_posed_inertial_number) {
  for (const FrictionLaw& law : {FrictionLaw{}, cylinder_law()}) {
    const auto n = [&](double log_I) {
      const double I = std::exp(log_I);
      return I * law.friction_derivative(I) / law.friction(I);
    };
    const double best = std::log(law.best_posed());
    BOOST_TEST(std::abs(testing::difference(n, best, 1)) < 1e-9 * n(best));
    BOOST_TEST(n(best) > n(best - 0.1));
    BOOST_TEST(n(best) > n(best + 0.1));
  }
}

BOOST_AUTO_TEST_SUITE_END()
