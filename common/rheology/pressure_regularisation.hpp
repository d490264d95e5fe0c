// Pressure regularisation, eq. (16): a positive pressure for the viscosity from any total pressure.
#pragma once

#include <cmath>

namespace talus::rheology {

struct RegularisedPressure {
  double value = 0;       ///< p_regu > 0
  double derivative = 0;  ///< dp_regu/dp_tot, in (0, 1)
};

/// p_regu = (p + sqrt(p² + λr²))/2, eq. (16).
/// For p < 0 the printed form cancels to exactly 0 in floating point (p = -1, λr = 1e-8) although
/// the limit is λr²/(4|p|); the conjugate form λr²/(2(sqrt(p² + λr²) - p)) does not cancel.
inline RegularisedPressure regularise_pressure(double total_pressure, double lambda_r) {
  // course 5: positive pressure
  const double root = std::hypot(total_pressure, lambda_r);
  const double value = total_pressure >= 0 ? 0.5 * (total_pressure + root)
                                           : 0.5 * lambda_r * (lambda_r / (root - total_pressure));
  return {value, root > 0 ? value / root : 0.5};
  // end of course 5
}

}  // namespace talus::rheology
