// Creep: what a law with a yield stress does below yield because it is regularised. Velocities go
// with λr and the stress does not depend on it, so no path in λr is needed to come there: Newton's
// method does, from a load nearby or from rest by way of a smoother law.
#pragma once

#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {

/// Newton's options for creep: few iterations, for a load that does not creep must not cost much.
solve::NewtonOptions creep_options();

/// How a load was come to.
struct CreepSummary {
  solve::NewtonSummary newton;  ///< the last one; a success only at the load itself
  int loads = 0;                ///< solved, this one included; more than one: a ladder
  int failures = 0;             ///< loads tried in vain
};

/// Comes to a load at the flow's own λr from the creep under `load_before`, or from rest if that is
/// 0: at once, else by way of the load half way, and so on. Newton's tangent is
/// primal-dual unless told not to be; `options.max_iterations` is for all of it. From rest it
/// begins under a smoother law: a larger λr, and a floor under the pressure of eq. (16). The flow
/// is left at `load`; the state as it was if it failed.
template <int Dim>
CreepSummary creep_to_load(MixedFlow<Dim>& flow, double load, double load_before,
                           typename MixedFlow<Dim>::State& state,
                           const solve::NewtonOptions& options = creep_options(),
                           bool is_primal_dual = true);

}  // namespace talus::mixed
