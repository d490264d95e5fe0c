#include "common/solve/end.hpp"

namespace talus::solve {

std::string name_of(End end) {
  switch (end) {
    case End::converged: return "converged";
    case End::at_round_off_floor: return "at_round_off_floor";
    case End::stagnated: return "stagnated";
    case End::line_search_failed: return "line_search_failed";
    case End::linear_solver_failed: return "linear_solver_failed";
    case End::non_finite: return "non_finite";
    case End::no_steady_state: return "no_steady_state";
  }
  return {};
}

std::string advice_for(End end) {
  switch (end) {
    case End::converged:
    case End::at_round_off_floor: return {};
    case End::stagnated:
      return "try the energy line search, a larger --lambda-r or --method interior-point";
    case End::line_search_failed:
      return "check the tangent with --check-jacobian, or try --method interior-point";
    case End::linear_solver_failed: return "try a larger --lambda-r or a coarser mesh";
    case End::non_finite: return "try the energy line search or a larger --lambda-r";
    case End::no_steady_state: return "lower the load below its limit";
  }
  return {};
}

}  // namespace talus::solve
