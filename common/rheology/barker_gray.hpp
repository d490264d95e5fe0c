// The control law: partially regularised μ(I), well-posed at low I, and without a yield stress.
#pragma once

#include <string_view>

#include "common/rheology/friction_law.hpp"
#include "common/rheology/viscosity.hpp"

namespace talus::rheology {

/// Barker & Gray (2017), J. Fluid Mech. 828, 5-32:
///     μ(I) = sqrt(α / ln(A/I)) for I <= I1,  eq. (4) above,  A = I1 exp(α/μ(I1)²),
/// I1 the lower end of the band where eq. (4) is well-posed. μ(0) = 0: it creeps under any load.
/// λr enters as |γ| → sqrt(|γ|² + λr²), in I and in η = μ p/|γ|.
///
/// A value belongs to the friction law it was made from; finding I1 takes some microseconds.
class BarkerGray {
 public:
  static constexpr std::string_view name = "barker-gray";
  static constexpr std::string_view equation = "(Barker & Gray)";
  static constexpr bool has_yield_stress = false;
  static constexpr double alpha = 1.9;  ///< C <= 0 as I → 0 needs α <= 2

  /// Where eq. (4) is nowhere well-posed, I1 is where it is nearest to it.
  explicit BarkerGray(const FrictionLaw& law = {});

  double creep_end() const { return I1_; }  ///< I1

  double friction(const FrictionLaw& law, double I) const;
  /// I(μ): positive for every μ > 0, infinite from μ2 on.
  double inertial_number(const FrictionLaw& law, double friction) const;
  /// ∫₀^μ I dμ.
  double inertial_number_integral(const FrictionLaw& law, double friction) const;
  /// μ(I1), where the slope of I(μ) jumps, by a few per cent.
  double kink(const FrictionLaw&) const { return mu1_; }
  double well_posedness(const FrictionLaw& law, double I) const;

  Viscosity evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                     double pressure) const;

 private:
  // μ for 0 < I <= I1, from ln(A/I) = α/μ1² - ln(I/I1): A itself may overflow.
  double creep_friction(double I) const;

  FrictionLaw law_;
  double I1_, mu1_, share1_;  // I1, μ(I1), I1/(I0 + I1)
};

}  // namespace talus::rheology
