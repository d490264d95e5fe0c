#include "common/rheology/barker_gray.hpp"

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

}  // namespace talus::rheology
