// The friction law μ(I), eq. (4), and the dissipation it implies.
//
// Everything here is dimensionless: lengths in L, stress in φρgL, velocity in sqrt(gL), shear rate
// in sqrt(g/L). Pressure is the total pressure and must be positive.
#pragma once

#include <optional>
#include <utility>

namespace talus::rheology {

/// μ(I) = μs + Δμ / (I0/I + 1), eq. (4); defaults from Jop et al. (2005), section 3.1 of the paper.
struct FrictionLaw {
  double mu_s = 0.383;          ///< static friction coefficient
  double delta_mu = 0.26;       ///< μ2 - μs
  double I0 = 0.279;            ///< inertial number at which half of Δμ is reached
  double solid_fraction = 0.6;  ///< φ
  double grain_size = 1.0;      ///< d* = d/L

  double mu_2() const { return mu_s + delta_mu; }

  /// I = d*|γ| / sqrt(φp).
  double inertial_number(double shear_rate, double pressure) const;
  /// μ(I), eq. (4).
  double friction(double inertial_number) const;
  /// I(μ), the inverse of eq. (4): 0 up to μs, infinite from μ2 on.
  double inertial_number_at(double friction) const;
  /// ∫₀^μ I dμ: with it, velocity profiles under a constant pressure are closed formulas.
  double inertial_number_integral(double friction) const;
  /// dμ/dI.
  double friction_derivative(double inertial_number) const;

  /// c = I0 sqrt(φp) / d*: the shear rate at which I = I0.
  double reference_shear_rate(double pressure) const;

  /// D(|γ|, p) = ∫₀^|γ| μ p ds = μs p |γ| + Δμ p (|γ| - c ln(1 + |γ|/c)): dissipation potential.
  double dissipation(double shear_rate, double pressure) const;
  /// D' = μ(I) p: shear stress in flow.
  double stress(double shear_rate, double pressure) const;
  /// D'' = Δμ p c / (c + |γ|)².
  double stress_slope(double shear_rate, double pressure) const;

  /// The shear rate that carries `stress`: 0 up to μs p, infinite from μ2 p on (eq. (25)).
  double shear_rate(double stress, double pressure) const;
  /// D*(τ, p) = sup_t (τt - D(t, p)): 0 up to μs p, infinite from μ2 p on.
  double complementary_dissipation(double stress, double pressure) const;

  /// C = 4n² - 4n + μ²(1 - n/2)², n = I μ'(I)/μ: well-posed where C <= 0 (Barker & Gray 2017).
  double well_posedness(double inertial_number) const;
  /// The interval of I on which C <= 0; nothing where there is none.
  std::optional<std::pair<double, double>> well_posed_band() const;
  /// I0 sqrt(μs/μ2): where n is largest, and C smallest but for the slow growth of μ.
  double best_posed() const;

  bool operator==(const FrictionLaw&) const = default;
};

/// C of any law from its friction and n = I μ'(I)/μ.
inline double well_posedness_indicator(double friction, double n) {
  return 4 * n * n - 4 * n + friction * friction * (1 - n / 2) * (1 - n / 2);
}

}  // namespace talus::rheology
