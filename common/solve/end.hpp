// How a nonlinear solve ends: exactly one of these, for Newton and for the interior point.
#pragma once

#include <string>

namespace talus::solve {

enum class End {
  converged,             ///< residual (or duality gap) below the tolerance
  at_round_off_floor,    ///< residual below what rounding of the iterate allows to reach
  stagnated,             ///< no progress over many iterations, or the iteration limit
  line_search_failed,    ///< no acceptable step along the Newton direction
  linear_solver_failed,  ///< singular or useless factorisation
  non_finite,            ///< NaN or infinity in the residual
  no_steady_state,       ///< the load exceeds what the material can carry
  out_of_memory          ///< told by what is thrown (memory.hpp): no other try takes less
};

/// Every end, in the order of the enumeration.
inline constexpr End all_ends[] = {
    End::converged,          End::at_round_off_floor,   End::stagnated,
    End::line_search_failed, End::linear_solver_failed, End::non_finite,
    End::no_steady_state,    End::out_of_memory};

/// Only the first two ends are success.
inline bool is_success(End end) {
  return end == End::converged || end == End::at_round_off_floor;
}

/// The name used in messages and in summary.json.
std::string name_of(End end);

/// What a user can try after this end; empty for a success.
std::string advice_for(End end);

}  // namespace talus::solve
