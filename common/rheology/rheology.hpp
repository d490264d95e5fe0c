// The law the solvers see: friction law, regularisation and pressure regularisation in one value.
#pragma once

#include <algorithm>

#include "common/rheology/friction_law.hpp"
#include "common/rheology/pressure_regularisation.hpp"
#include "common/rheology/regularisation.hpp"

namespace talus::rheology {

/// What the law makes of a shear rate and a total pressure: everything that is asked of a point.
struct LocalState {
  double shear_rate = 0, total_pressure = 0;
  double regularised_pressure = 0;  ///< p_regu, eq. (16)
  double viscosity = 0;
  double inertial_number = 0;
  double well_posedness = 0;  ///< C of the limiting law: ill-posed where it is positive
  bool has_yielded = false;   ///< |τ| > μs p_regu

  double stress() const { return viscosity * shear_rate; }  ///< |τ|
};

/// Make a new one for another friction law: the regularisation is made ready for it once, here.
struct Rheology {
  FrictionLaw law;
  Regularisation regularisation;
  double lambda_r;  ///< regularisation parameter, a shear rate in (9)-(12), a pressure in (16)
  double pressure_floor = 0;  ///< (16) takes this where it is larger than λr: a pressure that means
                              ///< something, such as the weight of a grain
  bool regularises_pressure = true;  ///< else p_regu = max(p, 0)

  Rheology(const FrictionLaw& friction_law = {},
           const Regularisation& of_viscosity = ChauchatMedale{}, double parameter = 1e-6)
      : law(friction_law),
        regularisation(for_law(of_viscosity, friction_law)),
        lambda_r(parameter) {}

  /// p_regu(p_tot), eq. (16).
  RegularisedPressure regularised_pressure(double total_pressure) const {
    return regularise_pressure(total_pressure,
                               regularises_pressure ? std::max(lambda_r, pressure_floor) : 0);
  }

  /// η(|γ|, p_regu(p_tot)) of eq. (9)-(12) with eq. (16), derivatives with respect to |γ| and
  /// p_tot. Every viscosity comes from here; a loop over points visits its `kind` once.
  template <class Kind>
  Viscosity evaluate(const Kind& kind, double shear_rate, const RegularisedPressure& p) const {
    Viscosity v = kind.evaluate(law, lambda_r, shear_rate, p.value);
    v.d_eta_d_pressure *= p.derivative;
    return v;
  }
  Viscosity evaluate(double shear_rate, double total_pressure) const {
    const RegularisedPressure p = regularised_pressure(total_pressure);
    return std::visit([&](const auto& kind) { return evaluate(kind, shear_rate, p); },
                      regularisation);
  }
  LocalState local_state(double shear_rate, double total_pressure) const {
    LocalState at{shear_rate, total_pressure};
    at.regularised_pressure = regularised_pressure(total_pressure).value;
    at.viscosity = evaluate(shear_rate, total_pressure).eta;
    at.inertial_number = law.inertial_number(shear_rate, at.regularised_pressure);
    at.well_posedness = well_posedness(at.inertial_number);
    at.has_yielded = at.stress() > law.mu_s * at.regularised_pressure;
    return at;
  }

  // The friction law that the regularised one tends to as λr → 0: eq. (4) unless it says otherwise.

  /// μ(I).
  double limit_friction(double inertial_number) const {
    return std::visit([&](const auto& kind) { return kind.friction(law, inertial_number); },
                      regularisation);
  }
  /// I(μ): 0 below a yield stress, infinite from μ2 on.
  double limit_inertial_number(double friction) const {
    return std::visit([&](const auto& kind) { return kind.inertial_number(law, friction); },
                      regularisation);
  }
  /// ∫₀^μ I dμ.
  double limit_inertial_number_integral(double friction) const {
    return std::visit(
        [&](const auto& kind) { return kind.inertial_number_integral(law, friction); },
        regularisation);
  }
  /// Friction at which the slope of I(μ) jumps, and with it that of a shear rate.
  double limit_kink() const {
    return std::visit([&](const auto& kind) { return kind.kink(law); }, regularisation);
  }
  /// C of that law: well-posed where C <= 0 (Barker & Gray 2017).
  double well_posedness(double inertial_number) const {
    return std::visit([&](const auto& kind) { return kind.well_posedness(law, inertial_number); },
                      regularisation);
  }
};

/// C of a regularisation's limiting law; a Rheology spares repeated preparation.
inline double well_posedness(const Regularisation& regularisation, const FrictionLaw& law,
                             double inertial_number) {
  return Rheology(law, regularisation).well_posedness(inertial_number);
}

/// What a driving stress does to the material: the limits of existence of a steady flow.
enum class Regime { at_rest, flowing, no_steady_state };

/// Regime of a layer whose largest shear stress over pressure is `stress_ratio` (tan α for the
/// inclined plane, b/(2p) for the chute): at rest up to μs, no steady flow from μ2 on.
inline Regime regime_under(const FrictionLaw& law, double stress_ratio) {
  if (stress_ratio <= law.mu_s) return Regime::at_rest;
  if (stress_ratio >= law.mu_2()) return Regime::no_steady_state;
  return Regime::flowing;
}

/// The same, where without a yield stress nothing is ever at rest.
inline Regime regime_under(const Rheology& rheology, double stress_ratio) {
  const Regime regime = regime_under(rheology.law, stress_ratio);
  const bool creeps = stress_ratio > 0 && !has_yield_stress(rheology.regularisation);
  return regime == Regime::at_rest && creeps ? Regime::flowing : regime;
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
