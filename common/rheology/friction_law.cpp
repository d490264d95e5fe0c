#include "common/rheology/friction_law.hpp"

#include <cmath>
#include <limits>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_sf_log.h>

namespace talus::rheology {

double FrictionLaw::inertial_number(double shear_rate, double pressure) const {
  if (shear_rate == 0) return 0;  // under no pressure either
  return grain_size * shear_rate / std::sqrt(solid_fraction * pressure);
}

// Written as Δμ I/(I0 + I): the same as eq. (4), and defined at I = 0.
double FrictionLaw::friction(double inertial_number) const {
  // course 1: friction law
  if (std::isinf(inertial_number)) return mu_2();
  return mu_s + delta_mu * inertial_number / (I0 + inertial_number);
  // end of course 1
}

double FrictionLaw::inertial_number_at(double friction) const {
  // course 2: its inverse
  const double excess = friction - mu_s, margin = mu_2() - friction;
  if (excess <= 0) return 0;
  return margin > 0 ? I0 * excess / margin : std::numeric_limits<double>::infinity();
  // end of course 2
}

double FrictionLaw::inertial_number_integral(double friction) const {
  const double excess = friction - mu_s;
  if (excess <= 0) return 0;
  if (excess >= delta_mu) return std::numeric_limits<double>::infinity();
  // -ln(1 - x) - x from GSL: the difference cancels just above yield when written out.
  return -I0 * delta_mu * gsl_sf_log_1plusx_mx(-excess / delta_mu);
}

double FrictionLaw::friction_derivative(double inertial_number) const {
  return delta_mu * I0 / ((I0 + inertial_number) * (I0 + inertial_number));
}

double FrictionLaw::reference_shear_rate(double pressure) const {
  return I0 * std::sqrt(solid_fraction * pressure) / grain_size;
}

double FrictionLaw::dissipation(double shear_rate, double pressure) const {
  const double c = reference_shear_rate(pressure);
  // ln(1+x) - x from GSL: the difference cancels for small x when written out.
  const double viscous = -c * gsl_sf_log_1plusx_mx(shear_rate / c);
  return mu_s * pressure * shear_rate + delta_mu * pressure * viscous;
}

double FrictionLaw::stress(double shear_rate, double pressure) const {
  const double c = reference_shear_rate(pressure);
  return pressure * (mu_s + delta_mu * shear_rate / (c + shear_rate));
}

double FrictionLaw::stress_slope(double shear_rate, double pressure) const {
  const double c = reference_shear_rate(pressure);
  return delta_mu * pressure * c / ((c + shear_rate) * (c + shear_rate));
}

double FrictionLaw::shear_rate(double stress, double pressure) const {
  const double excess = stress - mu_s * pressure;
  if (excess <= 0) return 0;
  const double margin = mu_2() * pressure - stress;
  if (margin <= 0) return std::numeric_limits<double>::infinity();
  return reference_shear_rate(pressure) * excess / margin;
}

double FrictionLaw::complementary_dissipation(double stress, double pressure) const {
  const double t = shear_rate(stress, pressure);
  if (t == 0 || std::isinf(t)) return t;
  return stress * t - dissipation(t, pressure);
}

double FrictionLaw::well_posedness(double inertial_number) const {
  const double mu = friction(inertial_number);
  const double n =
      std::isinf(inertial_number) ? 0 : inertial_number * friction_derivative(inertial_number) / mu;
  return well_posedness_indicator(mu, n);
}

double FrictionLaw::best_posed() const {
  return I0 * std::sqrt(mu_s / mu_2());
}

std::optional<std::pair<double, double>> FrictionLaw::well_posed_band() const {
  gsl_function indicator{
      [](double log_I, void* law) {
        return static_cast<const FrictionLaw*>(law)->well_posedness(std::exp(log_I));
      },
      const_cast<FrictionLaw*>(this)};
  const double middle = std::log(best_posed());
  if (well_posedness(std::exp(middle)) >= 0) return std::nullopt;
  const auto root = [&](double lower, double upper) {
    gsl_root_fsolver* solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    gsl_root_fsolver_set(solver, &indicator, lower, upper);
    for (int i = 0; i < 100; ++i) {
      gsl_root_fsolver_iterate(solver);
      if (gsl_root_test_interval(gsl_root_fsolver_x_lower(solver), gsl_root_fsolver_x_upper(solver),
                                 1e-13, 0) == GSL_SUCCESS)
        break;
    }
    const double x = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return std::exp(x);
  };
  return std::pair{root(middle - 20, middle), root(middle, middle + 20)};
}

}  // namespace talus::rheology
