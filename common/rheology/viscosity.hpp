#pragma once

namespace talus::rheology {

/// Viscosity η and its first derivatives at one point (stress over shear rate).
struct Viscosity {
  double eta = 0;
  double d_eta_d_shear_rate = 0;
  double d_eta_d_pressure = 0;
};

}  // namespace talus::rheology
