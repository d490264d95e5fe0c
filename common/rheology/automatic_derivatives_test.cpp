// η and both of its derivatives at a point, against the equations as they are printed,
// differentiated automatically: no difference quotient, so the limits of the arguments are within
// reach.
#include <cmath>
#include <functional>
#include <map>

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/test/unit_test.hpp>

#include "common/rheology/rheology.hpp"

BOOST_AUTO_TEST_SUITE(automatic_derivatives_test)

using namespace talus;
using namespace talus::rheology;

namespace {

// Of |γ| and p_tot, once each; extended, for what the printed forms cancel.
using Number = boost::math::differentiation::promote<
    boost::math::differentiation::autodiff_fvar<long double, 1>,
    boost::math::differentiation::autodiff_fvar<long double, 1, 1>>;

struct Point {
  FrictionLaw law;
  long double lambda_r;
  Number shear_rate, pressure;  // p_regu

  Number c() const { return law.I0 * sqrt(law.solid_fraction * pressure) / law.grain_size; }
  Number rounded_rate() const { return sqrt(shear_rate * shear_rate + lambda_r * lambda_r); }
  // Δμ p / (c + |γ| + λr)
  Number viscous() const { return law.delta_mu * pressure / (c() + shear_rate + lambda_r); }
};

// (1 - e^{-x})/x
Number decay(const Number& x) {
  if (x > 1e-2L) return (1 - exp(-x)) / x;
  Number sum = 0, term = 1;
  for (int k = 1; k < 12; ++k) {
    term /= k;
    sum += term;
    term *= -x;
  }
  return sum;
}

// μ = sqrt(α/ln(A/I)) up to I1, A = I1 exp(α/μ(I1)²); eq. (4) above (Barker & Gray 2017).
Number barker_gray_friction(const FrictionLaw& law, const Number& I) {
  constexpr long double alpha = 1.9L;
  const auto eq_4 = [&](const auto& at) { return law.mu_s + law.delta_mu * at / (law.I0 + at); };
  const long double I1 = law.well_posed_band()->first, mu1 = eq_4(I1);
  if (I > I1) return eq_4(I);
  return sqrt(alpha / (alpha / (mu1 * mu1) - log(I / I1)));
}

const std::map<std::string, std::function<Number(const Point&)>> equations = {
    {"simple",
     [](const Point& at) {
       return at.law.mu_s * at.pressure / (at.shear_rate + at.lambda_r) + at.viscous();
     }},
    {"bercovier-engelman",
     [](const Point& at) { return at.law.mu_s * at.pressure / at.rounded_rate() + at.viscous(); }},
    {"papanastasiou",
     [](const Point& at) {
       return at.law.mu_s * at.pressure * decay(at.shear_rate / at.lambda_r) / at.lambda_r +
              at.viscous();
     }},
    {"chauchat-medale",
     [](const Point& at) {
       const Number mu = at.law.mu_s + at.law.delta_mu * at.shear_rate / (at.c() + at.shear_rate);
       return mu * at.pressure / at.rounded_rate();
     }},
    {"barker-gray", [](const Point& at) {
       const Number I = at.law.I0 * at.rounded_rate() / at.c();
       return barker_gray_friction(at.law, I) * at.pressure / at.rounded_rate();
     }}};

// Eq. (16), in the form that does not cancel.
Number regularised(const Number& p, long double lambda_r) {
  const Number root = sqrt(p * p + lambda_r * lambda_r);
  return p >= 0 ? (p + root) / 2 : lambda_r * lambda_r / (2 * (root - p));
}

struct Apart {
  double eta, by_shear_rate, by_pressure;
  double worst() const { return std::fmax(eta, std::fmax(by_shear_rate, by_pressure)); }
};

// Relative to η over the distance in which it varies.
Apart apart(const Rheology& rheology, const Viscosity& ours, double shear_rate, double pressure) {
  const auto [rate, total] = boost::math::differentiation::make_ftuple<long double, 1, 1>(
      static_cast<long double>(shear_rate), static_cast<long double>(pressure));
  const Number p = regularised(total, rheology.lambda_r);
  const Number eta = equations.at(name_of(rheology.regularisation))(
      {rheology.law, rheology.lambda_r, Number(rate), p});
  const double c = rheology.law.reference_shear_rate(static_cast<double>(p.derivative(0, 0)));
  const double over_rate = shear_rate + std::fmin(rheology.lambda_r, c);
  const double over_pressure = std::hypot(pressure, rheology.lambda_r);
  const auto relative = [&](double value, long double exact, double distance) {
    return static_cast<double>(std::abs(value - exact) * distance / eta.derivative(0, 0));
  };
  return {relative(ours.eta, eta.derivative(0, 0), 1),
          relative(ours.d_eta_d_shear_rate, eta.derivative(1, 0), over_rate),
          relative(ours.d_eta_d_pressure, eta.derivative(0, 1), over_pressure)};
}

template <class Check>
void at_every_point(const Check& check) {
  FrictionLaw cylinder{.mu_s = 0.4, .delta_mu = 0.25, .I0 = 0.3};
  cylinder.grain_size = 0.1;
  for (const Regularisation& law : regularisations()) {
    BOOST_REQUIRE_MESSAGE(equations.contains(name_of(law)),
                          "write the equation of " << name_of(law) << " here as its source has it");
    for (const FrictionLaw& friction : {FrictionLaw{}, cylinder})
      for (const double lambda_r : {1e-1, 1e-4, 1e-8, 1e-12})
        for (const double shear_rate : {0.0, 1e-300, 1e-3 * lambda_r, 0.009 * lambda_r,
                                        0.011 * lambda_r, lambda_r, 40 * lambda_r, 1e-2, 1.0, 1e6})
          for (const double pressure : {-1e3, -1.0, -lambda_r, 0.0, lambda_r, 1e-3, 1.0, 28.0, 1e6})
            check(Rheology(friction, law, lambda_r), shear_rate, pressure);
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_law_and_its_derivatives_are_those_of_its_equation) {
  double worst = 0;
  at_every_point([&](const Rheology& rheology, double shear_rate, double pressure) {
    const auto found =
        apart(rheology, rheology.evaluate(shear_rate, pressure), shear_rate, pressure).worst();
    worst = std::isnan(found) ? found : std::fmax(worst, found);
    BOOST_TEST(found < 1e-13, name_of(rheology.regularisation)
                                  << ", λr " << rheology.lambda_r << ", |γ| " << shear_rate
                                  << ", p " << pressure);
  });
  BOOST_TEST_MESSAGE("worst " << worst);
}

BOOST_AUTO_TEST_CASE(a_derivative_that_is_a_millionth_off_is_not) {
  for (double Viscosity::*part :
       {&Viscosity::eta, &Viscosity::d_eta_d_shear_rate, &Viscosity::d_eta_d_pressure}) {
    for (const Regularisation& law : regularisations()) {
      const Rheology rheology({}, law, 1e-4);
      Viscosity off = rheology.evaluate(1e-4, 1);
      off.*part *= 1 + 1e-6;
      BOOST_TEST(apart(rheology, off, 1e-4, 1).worst() > 1e-9, name_of(law));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
