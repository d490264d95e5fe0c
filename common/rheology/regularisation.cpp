#include "common/rheology/regularisation.hpp"

#include <concepts>
#include <utility>

namespace talus::rheology {
namespace {

template <std::size_t... Index>
std::vector<Regularisation> all_alternatives(std::index_sequence<Index...>) {
  return {std::variant_alternative_t<Index, Regularisation>{}...};
}

}  // namespace

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
