// The law the solvers see: friction law, regularisation and pressure regularisation in one value.
#pragma once

#include "common/rheology/friction_law.hpp"
#include "common/rheology/pressure_regularisation.hpp"
#include "common/rheology/regularisation.hpp"

namespace talus::rheology {

struct Rheology {
  FrictionLaw law;
  Regularisation regularisation = ChauchatMedale{};
  double lambda_r =
      1e-6;  ///< regularisation parameter, a shear rate in (9)-(12), a pressure in (16)

  /// η(|γ|, p_regu(p_tot)) of eq. (9)-(12) with eq. (16), derivatives with respect to |γ| and
  /// p_tot.
  Viscosity evaluate(double shear_rate, double total_pressure) const {
    const RegularisedPressure p = regularise_pressure(total_pressure, lambda_r);
    Viscosity v =
        std::visit([&](auto kind) { return kind.evaluate(law, lambda_r, shear_rate, p.value); },
                   regularisation);
    v.d_eta_d_pressure *= p.derivative;
    return v;
  }
};

/// What a driving stress does to the material: the limits of existence of a steady flow.
enum class Regime { at_rest, flowing, no_steady_state };

/// Regime of a layer whose largest shear stress over pressure is `stress_ratio` (tan α for the
/// inclined plane, b/(2p) for the chute): at rest up to μs, no steady flow from μ2 on.
inline Regime regime_under(const FrictionLaw& law, double stress_ratio) {
  if (stress_ratio <= law.mu_s) return Regime::at_rest;
  if (stress_ratio >= law.mu_2()) return Regime::no_steady_state;
  return Regime::flowing;
}

inline std::string name_of(Regime regime) {
  switch (regime) {
    case Regime::at_rest:
      return "at_rest";
    case Regime::flowing:
      return "flowing";
    case Regime::no_steady_state:
      return "no_steady_state";
  }
  return {};
}

}  // namespace talus::rheology
