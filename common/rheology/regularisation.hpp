// The regularised granular viscosities, eq. (9)-(12) and a control law: η(|γ|, p) with both
// derivatives, and the friction law that each tends to as λr → 0.
//
// Adding a regularisation is one struct, its formula in regularisation.cpp and one name in
// `Regularisation`: the programs, the Jacobian checks, the studies and the charts then know it. A
// formula that changes recompiles its own file.
#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/rheology/barker_gray.hpp"
#include "common/rheology/friction_law.hpp"
#include "common/rheology/viscosity.hpp"

namespace talus::rheology {

/// What eq. (9)-(12) tend to as λr → 0: eq. (4), whose yield stress μs p they round off.
struct YieldStressLimit {
  static constexpr bool has_yield_stress = true;
  static double friction(const FrictionLaw& law, double I) { return law.friction(I); }
  static double inertial_number(const FrictionLaw& law, double friction) {
    return law.inertial_number_at(friction);
  }
  static double inertial_number_integral(const FrictionLaw& law, double friction) {
    return law.inertial_number_integral(friction);
  }
  /// Friction at which the slope of I(μ) jumps.
  static double kink(const FrictionLaw& law) { return law.mu_s; }
  static double well_posedness(const FrictionLaw& law, double I) { return law.well_posedness(I); }
};

/// Second term of eq. (9)-(11): Δμ p / (c + |γ| + λr), c = I0 sqrt(φp)/d*.
Viscosity simple_viscous_part(const FrictionLaw& law, double lambda_r, double shear_rate,
                              double pressure);

/// Eq. (9), after Frigaard & Nouar (2005).
struct Simple : YieldStressLimit {
  static constexpr std::string_view name = "simple";
  static constexpr std::string_view equation = "(9)";
  static Viscosity evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                            double pressure);
};

/// Eq. (10), after Bercovier & Engelman (1980).
struct BercovierEngelman : YieldStressLimit {
  static constexpr std::string_view name = "bercovier-engelman";
  static constexpr std::string_view equation = "(10)";
  static Viscosity evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                            double pressure);
};

/// Eq. (11), after Papanastasiou (1987). Defined at |γ| = 0: (1 - e^{-x})/x → 1.
struct Papanastasiou : YieldStressLimit {
  static constexpr std::string_view name = "papanastasiou";
  static constexpr std::string_view equation = "(11)";
  static Viscosity evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                            double pressure);
};

/// Eq. (12), the paper's own; its derivatives are eq. (15).
struct ChauchatMedale : YieldStressLimit {
  static constexpr std::string_view name = "chauchat-medale";
  static constexpr std::string_view equation = "(12)";
  static Viscosity evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                            double pressure);
};

/// What a regularisation must offer: a member that is missing is told in one line.
template <class Kind>
consteval bool is_whole() {
  static_assert(
      requires { std::string_view(Kind::name); }, "a regularisation needs a name");
  static_assert(
      requires { std::string_view(Kind::equation); },
      "a regularisation needs an equation: its number, or its source");
  static_assert(
      requires { bool(Kind::has_yield_stress); },
      "a regularisation needs has_yield_stress; derive from YieldStressLimit if it has one");
  static_assert(
      requires(const Kind& kind, const FrictionLaw& law, double number) {
        { kind.evaluate(law, number, number, number) } -> std::same_as<Viscosity>;
      },
      "a regularisation needs evaluate(law, lambda_r, shear_rate, pressure), a Viscosity");
  static_assert(
      requires(const Kind& kind, const FrictionLaw& law, double number) {
        double(kind.friction(law, number));
        double(kind.inertial_number(law, number));
        double(kind.inertial_number_integral(law, number));
        double(kind.kink(law));
        double(kind.well_posedness(law, number));
      },
      "a regularisation needs the members of YieldStressLimit, for the law that it tends to");
  return true;
}

template <class... Kinds>
requires(is_whole<Kinds>() && ...) using Registry = std::variant<Kinds...>;

/// All there are. One that depends on the friction law is made from it, once (`for_law`).
using Regularisation =
    Registry<Simple, BercovierEngelman, Papanastasiou, ChauchatMedale, BarkerGray>;

/// The regularisation made ready for a friction law; `Rheology` does it.
Regularisation for_law(const Regularisation& regularisation, const FrictionLaw& law);
/// Whether it rounds off a yield stress, below which nothing moves as λr → 0.
bool has_yield_stress(const Regularisation& regularisation);

/// All regularisations, those of the paper first and in its order.
const std::vector<Regularisation>& regularisations();
/// The regularisation of that name, if there is one.
std::optional<Regularisation> regularisation_named(std::string_view name);
std::string name_of(const Regularisation& regularisation);
/// The equation that defines it, or its source, in parentheses.
std::string equation_of(const Regularisation& regularisation);
/// Names joined with ", ", for messages.
std::string regularisation_names();

}  // namespace talus::rheology
