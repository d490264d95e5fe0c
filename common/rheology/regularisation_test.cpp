#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <boost/test/unit_test.hpp>

#include "common/rheology/rheology.hpp"
#include "common/testing/difference.hpp"

BOOST_AUTO_TEST_SUITE(regularisation_test)

using namespace talus;
using namespace talus::rheology;
using boost::test_tools::tolerance;

namespace {

constexpr double lambdas[] = {1e-2, 1e-6};
constexpr double pressures[] = {1e-6, 1, 28};

Viscosity evaluate(const Regularisation& regularisation, double lambda_r, double shear_rate,
                   double pressure) {
  return std::visit(
      [&](const auto& kind) {
        return kind.evaluate(FrictionLaw{}, lambda_r, shear_rate, pressure);
      },
      regularisation);
}

// Calls check(regularisation, λr, pressure) over the registry.
template <class Check>
void for_every_law(const Check& check) {
  for (const Regularisation& regularisation : regularisations())
    for (const double lambda_r : lambdas)
      for (const double p : pressures)
        BOOST_TEST_CONTEXT(name_of(regularisation) << ", λr " << lambda_r << ", p " << p) {
          check(regularisation, lambda_r, p);
        }
}

// The larger error of the two derivatives, in units of η over the scale on which it varies.
template <class Kind>
double derivative_error(const Kind& kind, double lambda_r, double shear_rate, double pressure) {
  const FrictionLaw law;
  const Viscosity v = kind.evaluate(law, lambda_r, shear_rate, pressure);
  const double scale = shear_rate + std::min(lambda_r, law.reference_shear_rate(pressure));
  const double by_shear_rate = testing::difference(
      [&](double s) { return kind.evaluate(law, lambda_r, s, pressure).eta; }, shear_rate, scale);
  const double by_pressure =
      testing::difference([&](double p) { return kind.evaluate(law, lambda_r, shear_rate, p).eta; },
                          pressure, pressure);
  return std::max(std::abs(v.d_eta_d_shear_rate - by_shear_rate) * scale,
                  std::abs(v.d_eta_d_pressure - by_pressure) * pressure) /
         v.eta;
}

constexpr double largest_derivative_error = 1e-10;

// Broken on purpose: eq. (15) without the pressure in c, and with a derivative 1e-6 too large.
struct WithoutPressureInC : ChauchatMedale {
  static Viscosity evaluate(const FrictionLaw& law, double lambda_r, double shear_rate, double p) {
    Viscosity v = ChauchatMedale::evaluate(law, lambda_r, shear_rate, p);
    v.d_eta_d_pressure = v.eta / p;
    return v;
  }
};
struct SlightlyTooSteep : Simple {
  static Viscosity evaluate(const FrictionLaw& law, double lambda_r, double shear_rate, double p) {
    Viscosity v = Simple::evaluate(law, lambda_r, shear_rate, p);
    v.d_eta_d_shear_rate *= 1 + 1e-6;
    return v;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(both_derivatives_agree_with_differences) {
  for_every_law([](const Regularisation& regularisation, double lambda_r, double p) {
    for (const double shear_rate :
         {0., 1e-3 * lambda_r, lambda_r, 10 * lambda_r, 1e3 * lambda_r, 1.})
      BOOST_TEST_CONTEXT("shear rate " << shear_rate) {
        const double error = std::visit(
            [&](const auto& kind) { return derivative_error(kind, lambda_r, shear_rate, p); },
            regularisation);
        BOOST_TEST(error < largest_derivative_error);
      }
  });
}

BOOST_AUTO_TEST_CASE(wrong_derivatives_are_caught) {
  BOOST_TEST(derivative_error(WithoutPressureInC{}, 1e-2, 1, 28) > 100 * largest_derivative_error);
  BOOST_TEST(derivative_error(SlightlyTooSteep{}, 1e-6, 1e-6, 1) > 100 * largest_derivative_error);
}

BOOST_AUTO_TEST_CASE(flow_recovers_the_friction_law_as_lambda_r_vanishes) {
  const FrictionLaw law;
  for (const Regularisation& regularisation : regularisations())
    for (const double lambda_r : {1e-2, 1e-4, 1e-6, 1e-8})
      for (const double shear_rate : {0.1, 1.})
        BOOST_TEST_CONTEXT(name_of(regularisation) << ", λr " << lambda_r) {
          const double I = law.inertial_number(shear_rate, 28);
          const double eta =
              Rheology(law, regularisation, lambda_r).limit_friction(I) * 28 / shear_rate;
          const double error = evaluate(regularisation, lambda_r, shear_rate, 28).eta / eta - 1;
          BOOST_TEST(error < 1e-15);  // no regularisation is stiffer than the law
          BOOST_TEST(error > -1.001 * lambda_r / shear_rate - 1e-15);
        }
}

BOOST_AUTO_TEST_CASE(viscosity_at_rest_is_finite_and_positive) {
  for_every_law([](const Regularisation& regularisation, double lambda_r, double p) {
    const double eta = evaluate(regularisation, lambda_r, 0, p).eta;
    BOOST_TEST(std::isfinite(eta));
    if (!has_yield_stress(regularisation)) {  // then its friction is that of the rate λr
      const Rheology rheology({}, regularisation, lambda_r);
      const double I = rheology.law.inertial_number(lambda_r, p);
      BOOST_TEST(eta == rheology.limit_friction(I) * p / lambda_r, tolerance(1e-14));
      return;
    }
    const double yield_part = FrictionLaw{}.mu_s * p / lambda_r;
    BOOST_TEST(eta >= yield_part * (1 - 1e-15));
    BOOST_TEST(eta <= yield_part * (1 + FrictionLaw{}.delta_mu / FrictionLaw{}.mu_s));
  });
}

BOOST_AUTO_TEST_CASE(stress_grows_with_shear_rate) {
  for_every_law([](const Regularisation& regularisation, double lambda_r, double p) {
    double previous = 0;
    for (double shear_rate = 1e-3 * lambda_r; shear_rate < 1e3; shear_rate *= 1.3) {
      const double stress = evaluate(regularisation, lambda_r, shear_rate, p).eta * shear_rate;
      BOOST_TEST(stress >= previous * (1 - 1e-15));
      BOOST_TEST(stress < FrictionLaw{}.mu_2() * p);
      previous = stress;
    }
  });
}

BOOST_AUTO_TEST_CASE(stress_is_strictly_monotone_wherever_its_slope_stands_clear_of_rounding) {
  for_every_law([](const Regularisation& regularisation, double lambda_r, double p) {
    for (const double shear_rate : {0., lambda_r, 10 * lambda_r, 0.1, 1.}) {
      const Viscosity v = evaluate(regularisation, lambda_r, shear_rate, p);
      BOOST_TEST(v.eta + v.d_eta_d_shear_rate * shear_rate > 0);
    }
  });
}

BOOST_AUTO_TEST_CASE(the_paper_s_own_derivatives_are_eq_15_as_printed) {
  const FrictionLaw law;
  for (const double lambda_r : lambdas)
    for (const double p : pressures)
      for (const double shear_rate : {0.5 * lambda_r, 3 * lambda_r, 0.2}) {
        const double c = law.I0 * std::sqrt(law.solid_fraction * p);
        const double square = shear_rate * shear_rate + lambda_r * lambda_r;
        const double A = law.delta_mu * c / (std::pow(c + shear_rate, 2) * std::sqrt(square));
        const Viscosity v = ChauchatMedale::evaluate(law, lambda_r, shear_rate, p);
        BOOST_TEST(v.d_eta_d_pressure == v.eta / p - 0.5 * A * shear_rate, tolerance(1e-13));
        BOOST_TEST(v.d_eta_d_shear_rate == -(v.eta * shear_rate / square - A * p),
                   tolerance(1e-12));
      }
}

// The paper calls eq. (11) "not definite" at |γ| = 0: a slip, its limit is plain.
BOOST_AUTO_TEST_CASE(papanastasiou_is_exact_at_zero_shear_rate) {
  const FrictionLaw law;
  const double lambda_r = 1e-6, p = 28;
  const double width = law.reference_shear_rate(p) + lambda_r;
  const Viscosity v = Papanastasiou::evaluate(law, lambda_r, 0, p);
  BOOST_TEST(v.eta == law.mu_s * p / lambda_r + law.delta_mu * p / width, tolerance(1e-15));
  BOOST_TEST(v.d_eta_d_shear_rate ==
                 -law.mu_s * p / (2 * lambda_r * lambda_r) - law.delta_mu * p / (width * width),
             tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(papanastasiou_series_meets_the_closed_form) {
  const FrictionLaw law;
  constexpr double p = 28, lambda_r = 1, series_ends = 1e-2;
  const double below = std::nextafter(series_ends, 0), above = series_ends;
  const Viscosity series = Papanastasiou::evaluate(law, lambda_r, below, p);
  const Viscosity closed = Papanastasiou::evaluate(law, lambda_r, above, p);
  BOOST_TEST(series.eta == closed.eta, tolerance(1e-14));
  BOOST_TEST(series.d_eta_d_shear_rate == closed.d_eta_d_shear_rate, tolerance(1e-12));
  for (const double x : {1e-5, 1e-3, 9.9e-3}) {  // extended precision affords the closed form
    const long double reference = -std::expm1(-static_cast<long double>(x)) / x;
    const double viscous = simple_viscous_part(law, lambda_r, x, p).eta;
    BOOST_TEST(Papanastasiou::evaluate(law, lambda_r, x, p).eta - viscous ==
                   static_cast<double>(law.mu_s * p * reference),
               tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(names_are_unique_and_found) {
  std::set<std::string> names, equations;
  for (const Regularisation& regularisation : regularisations()) {
    names.insert(name_of(regularisation));
    equations.insert(equation_of(regularisation));
    const auto found = regularisation_named(name_of(regularisation));
    BOOST_REQUIRE(found.has_value());
    BOOST_TEST(found->index() == regularisation.index());
    BOOST_TEST(regularisation_names().find(name_of(regularisation)) != std::string::npos);
  }
  BOOST_TEST(names.size() == regularisations().size());
  BOOST_TEST(equations.size() == regularisations().size());
}

BOOST_AUTO_TEST_CASE(an_unknown_name_finds_nothing) {
  BOOST_TEST(!regularisation_named("foo").has_value());
  BOOST_TEST(!regularisation_named("").has_value());
}

BOOST_AUTO_TEST_SUITE_END()
