#include "common/rheology/barker_gray.hpp"

#include <cassert>
#include <cmath>

#include <gsl/gsl_sf_erf.h>

namespace talus::rheology {

BarkerGray::BarkerGray(const FrictionLaw& law) : law_(law) {
  const auto band = law.well_posed_band();
  I1_ = band ? band->first : law.best_posed();
  mu1_ = law.friction(I1_);
  share1_ = I1_ / (law.I0 + I1_);
}

double BarkerGray::friction(const FrictionLaw& law, double I) const {
  if (I > I1_) return law.friction(I);
  return I > 0 ? creep_friction(I) : 0;
}

double BarkerGray::inertial_number(const FrictionLaw& law, double friction) const {
  if (friction > mu1_) return law.inertial_number_at(friction);
  return friction > 0 ? I1_ * std::exp(alpha / (mu1_ * mu1_) - alpha / (friction * friction)) : 0;
}

double BarkerGray::inertial_number_integral(const FrictionLaw& law, double friction) const {
  if (friction <= 0) return 0;
  // ∫ exp(-α/μ²) dμ = μ exp(-α/μ²) - sqrt(πα) erfc(sqrt(α)/μ); GSL's hazard function is the ratio
  // of the exponential to erfc, so that neither underflows.
  const double mu = std::fmin(friction, mu1_), x = std::sqrt(2 * alpha) / mu;
  const double creep = inertial_number(law, mu) * (mu - std::sqrt(2 * alpha) / gsl_sf_hazard(x));
  if (friction <= mu1_) return creep;
  return creep + (law.inertial_number_integral(friction) - law.inertial_number_integral(mu1_));
}

double BarkerGray::well_posedness(const FrictionLaw& law, double I) const {
  if (I > I1_) return law.well_posedness(I);
  const double mu = friction(law, I);
  return well_posedness_indicator(mu, mu * mu / (2 * alpha));
}

Viscosity BarkerGray::evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                               double pressure) const {
  assert(law == law_);
  const double c = law.reference_shear_rate(pressure);
  const double square = shear_rate * shear_rate + lambda_r * lambda_r;
  const double root = std::sqrt(square);
  const double share = root / (c + root);  // I/(I0 + I), which is 1 and no 0/0 at p = 0
  double mu, n;                            // n = d ln μ/d ln I
  if (share > share1_) {
    mu = law.mu_s + law.delta_mu * share;
    n = law.delta_mu * share * (c / (c + root)) / mu;
  } else {
    mu = creep_friction(law.I0 * root / c);
    n = mu * mu / (2 * alpha);
  }
  const double eta_over_p = mu / root;
  return {eta_over_p * pressure, eta_over_p * pressure * (n - 1) * shear_rate / square,
          eta_over_p * (1 - 0.5 * n)};
}

double BarkerGray::creep_friction(double I) const {
  return std::sqrt(alpha / (alpha / (mu1_ * mu1_) - std::log(I / I1_)));
}

}  // namespace talus::rheology
