#include "twod/least_resistance.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

namespace talus::twod {
namespace {

// By the depth h: r; the momentum m = r² h sin φ, φ the angle of the curve to the vertical; and the
// integral. Euler & Lagrange: m' = 2 r h / cos φ.
int slopes(double h, const double y[], double slope[], void*) {
  const double weight = y[0] * y[0] * h, sine = y[1] / weight;
  if (!(std::abs(sine) < 1)) return GSL_EDOM;
  const double cosine = std::sqrt((1 - sine) * (1 + sine));
  slope[0] = sine / cosine;
  slope[1] = 2 * y[0] * h / cosine;
  slope[2] = weight / cosine;
  return GSL_SUCCESS;
}

// The curve that starts at this radius of the surface; cut short where it turns level.
ZoneCurve shoot(double surface_radius, double height) {
  constexpr int samples = 200;
  gsl_odeiv2_system system{slopes, nullptr, 3, nullptr};
  const std::unique_ptr<gsl_odeiv2_driver, decltype(&gsl_odeiv2_driver_free)> driver(
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-6, 1e-13, 1e-13),
      &gsl_odeiv2_driver_free);
  double h = 1e-6 * height;  // there m = r h², to first order
  std::array<double, 3> y{surface_radius, surface_radius * h * h,
                          surface_radius * surface_radius * h * h / 2};
  ZoneCurve curve{{0}, {surface_radius}, surface_radius};
  for (int i = 1; i <= samples; ++i) {
    if (gsl_odeiv2_driver_apply(driver.get(), &h, height * i / samples, y.data()) != GSL_SUCCESS)
      return curve;
    curve.depth.push_back(h);
    curve.radius.push_back(y[0]);
    curve.integral = y[2];
  }
  return curve;
}

}  // namespace

ZoneCurve least_resistance(double height) {
  gsl_error_handler_t* const handler = gsl_set_error_handler_off();
  // The radius at the bottom grows with that at the surface, or the curve turns level on its way.
  const auto misses = [&](const ZoneCurve& curve) {
    return curve.depth.back() < height ? -1 : curve.radius.back() - 1;
  };
  double low = 0, high = 1;
  // From the outside in, so that of several curves the outermost is found.
  for (double radius = 1; radius > 0; radius -= 1. / 256)
    if (misses(shoot(radius, height)) < 0) {
      low = radius;
      break;
    } else {
      high = radius;
    }
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = 0.5 * (low + high);
    (misses(shoot(middle, height)) < 0 ? low : high) = middle;
  }
  const ZoneCurve curve = shoot(high, height);
  gsl_set_error_handler(handler);
  if (curve.depth.back() < height || std::abs(curve.radius.back() - 1) > 1e-6)
    throw std::domain_error("least_resistance: no open zone at this height");
  return curve;
}

}  // namespace talus::twod
