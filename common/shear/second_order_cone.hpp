// The second-order cone {(s, v): |v| <= s}.
#pragma once

#include <cmath>
#include <limits>

namespace talus::shear {

/// Largest α with |v + α dv| <= s + α ds, for |v| < s; infinity if there is none.
/// The smaller positive root of a α² + 2b α + c, in the form that does not cancel near the
/// boundary.
template <class Vector>
double step_to_cone(double s, const Vector& v, double ds, const Vector& dv) {
  // course 14: step to the cone
  const double norm = v.norm();
  const double c = (s - norm) * (s + norm);
  const double b = s * ds - v.dot(dv);
  const double dv_norm = dv.norm();
  const double a = (ds - dv_norm) * (ds + dv_norm);
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::numeric_limits<double>::infinity();
  const double denominator = -b + std::sqrt(discriminant);
  return denominator > 0 ? c / denominator : std::numeric_limits<double>::infinity();
  // end of course 14
}

}  // namespace talus::shear
