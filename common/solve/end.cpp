#include "common/solve/end.hpp"

#include <array>

namespace talus::solve {
namespace {

struct Description {
  const char* name;
  const char* advice;
};

// In the order of the enumeration.
constexpr std::array<Description, std::size(all_ends)> descriptions = {{
    {"converged", ""},
    {"at_round_off_floor", ""},
    {"stagnated",
     "check the tangent with --check-jacobian, try a larger --lambda-r or the other --method"},
    {"line_search_failed",
     "check the tangent with --check-jacobian, or try --method interior-point"},
    {"linear_solver_failed",
     "try a mesh graded less; by Newton --line-search energy-slope or a larger --lambda-r"},
    {"non_finite",
     "try a mesh graded less; by Newton --line-search energy-slope or a larger --lambda-r"},
    {"no_steady_state", "lower the load below its limit"},
    {"out_of_memory", "try fewer elements, or a machine with more memory"},
}};

const Description& description_of(End end) {
  return descriptions[static_cast<std::size_t>(end)];
}

}  // namespace

std::string name_of(End end) {
  return description_of(end).name;
}

std::string advice_for(End end) {
  return description_of(end).advice;
}

}  // namespace talus::solve
