#include "common/rheology/regularisation.hpp"

#include <cmath>
#include <concepts>
#include <utility>

namespace talus::rheology {
namespace {

template <std::size_t... Index>
std::vector<Regularisation> all_alternatives(std::index_sequence<Index...>) {
  return {std::variant_alternative_t<Index, Regularisation>{}...};
}

}  // namespace

Viscosity simple_viscous_part(const FrictionLaw& law, double lambda_r, double shear_rate,
                              double pressure) {
  const double c = law.reference_shear_rate(pressure);
  const double width = c + shear_rate + lambda_r;
  const double eta = law.delta_mu * pressure / width;
  // p dc/dp = c/2, so the pressure derivative stays finite as p → 0.
  return {eta, -eta / width, law.delta_mu * (1 - 0.5 * c / width) / width};
}

Viscosity Simple::evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                           double pressure) {
  Viscosity v = simple_viscous_part(law, lambda_r, shear_rate, pressure);
  const double width = shear_rate + lambda_r;
  const double yield = law.mu_s / width;
  v.eta += yield * pressure;
  v.d_eta_d_shear_rate -= yield * pressure / width;
  v.d_eta_d_pressure += yield;
  return v;
}

Viscosity BercovierEngelman::evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                                      double pressure) {
  Viscosity v = simple_viscous_part(law, lambda_r, shear_rate, pressure);
  // course 3: regularisation
  const double square = shear_rate * shear_rate + lambda_r * lambda_r;
  const double yield = law.mu_s / std::sqrt(square);
  v.eta += yield * pressure;
  v.d_eta_d_shear_rate -= yield * pressure * shear_rate / square;
  v.d_eta_d_pressure += yield;
  // end of course 3
  return v;
}

Viscosity Papanastasiou::evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                                  double pressure) {
  Viscosity v = simple_viscous_part(law, lambda_r, shear_rate, pressure);
  const double x = shear_rate / lambda_r;
  double value, slope;  // (1 - e^{-x})/x and its derivative (e^{-x}(1 + x) - 1)/x²
  if (x < 1e-2) {
    // Series: the closed form of the slope loses 2 log10(1/x) digits.
    value = 1 + x * (-1. / 2 + x * (1. / 6 + x * (-1. / 24 + x * (1. / 120 - x / 720))));
    slope = -1. / 2 + x * (1. / 3 + x * (-1. / 8 + x * (1. / 30 + x * (-1. / 144 + x / 840))));
  } else {
    value = -std::expm1(-x) / x;
    slope = (std::exp(-x) - value) / x;
  }
  const double yield = law.mu_s * value / lambda_r;
  v.eta += yield * pressure;
  v.d_eta_d_shear_rate += law.mu_s * pressure * slope / (lambda_r * lambda_r);
  v.d_eta_d_pressure += yield;
  return v;
}

Viscosity ChauchatMedale::evaluate(const FrictionLaw& law, double lambda_r, double shear_rate,
                                   double pressure) {
  const double c = law.reference_shear_rate(pressure);
  const double width = c + shear_rate;
  const double square = shear_rate * shear_rate + lambda_r * lambda_r;
  const double root = std::sqrt(square);
  // width = 0 only where |γ| and p vanish together; friction is then μs.
  const double ratio = width > 0 ? shear_rate / width : 0;
  // course 4: its derivatives
  const double slope = width > 0 ? law.delta_mu * c / (width * width * root) : 0;  // A, eq. (15)
  const double eta_over_p = (law.mu_s + law.delta_mu * ratio) / root;
  return {eta_over_p * pressure, pressure * (slope - eta_over_p * shear_rate / square),
          eta_over_p - 0.5 * slope * shear_rate};
  // end of course 4
}

const std::vector<Regularisation>& regularisations() {
  static const auto all =
      all_alternatives(std::make_index_sequence<std::variant_size_v<Regularisation>>{});
  return all;
}

std::optional<Regularisation> regularisation_named(std::string_view name) {
  for (const Regularisation& candidate : regularisations())
    if (name_of(candidate) == name) return candidate;
  return std::nullopt;
}

Regularisation for_law(const Regularisation& regularisation, const FrictionLaw& law) {
  return std::visit(
      [&]<class Kind>(const Kind& kind) -> Regularisation {
        if constexpr (std::constructible_from<Kind, const FrictionLaw&>)
          return Kind(law);
        else
          return kind;
      },
      regularisation);
}

bool has_yield_stress(const Regularisation& regularisation) {
  return std::visit([](const auto& kind) { return kind.has_yield_stress; }, regularisation);
}

std::string name_of(const Regularisation& regularisation) {
  return std::visit([](const auto& kind) { return std::string(kind.name); }, regularisation);
}

std::string equation_of(const Regularisation& regularisation) {
  return std::visit([](const auto& kind) { return std::string(kind.equation); }, regularisation);
}

std::string regularisation_names() {
  std::string names;
  for (const Regularisation& each : regularisations())
    names += (names.empty() ? "" : ", ") + name_of(each);
  return names;
}

}  // namespace talus::rheology
