// The parts of the cylinder's study; and what is said of their runs, apart from the solves:
// checks and the sentences that rest on them.
#pragma once

#include "verification/cylinder/cylinder_runs.hpp"
#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Below yield on finer and finer meshes.
void cylinder_meshes(Chapter& chapter, const Context& context);
/// Below yield: half and full domain, and the outlet.
void cylinder_outlets(Chapter& chapter, const Context& context);
/// Past yield: paths along the loading, folds, eq. (12) against the control law, what ends a sweep.
void cylinder_paths(Chapter& chapter, const Context& context);

/// U/λr of creep; NaN where it was not found.
double velocity_over_lambda_r(const twod::CylinderMeasures& measures);

/// Creep at a loading on finer and finer meshes.
struct FinerMeshes {
  double loading = 0;
  std::vector<Creep> creeps;
};
/// Of F = 0.01 and 0.04 at λr = 1e-6. `room`: relative distance allowed to another code's numbers.
void judge_meshes(Chapter& chapter, const std::vector<FinerMeshes>& runs, double room);

/// Of F = 0.03 on half and full domain.
void judge_halves(Chapter& chapter, const Creep& half, const Creep& full);

/// Developed and open outlet so many diameters behind the cylinder.
struct OutletPair {
  double place = 0;
  Creep developed, open;
};
/// Of F = 0.044; `all_open`: an outlet that leaves the pressure open as well.
void judge_outlets(Chapter& chapter, const std::vector<OutletPair>& pairs, const Creep& all_open);

/// Where a sweep up the loading goes to: to a flow, and further; the walls alone carry 0.065.
inline constexpr double flowing = 0.054, beyond = 0.07;

/// A way up the loading from creep: round folds or into them up to a flow, or with the primal-dual
/// tangent, which needs fewer and longer steps, until nothing goes on.
struct Sweep {
  rheology::Regularisation law;
  twod::Continuation continuation = twod::Continuation::arclength;
  bool inertia = true;

  bool is_natural() const { return continuation == twod::Continuation::natural; }
  bool goes_beyond() const { return continuation == twod::Continuation::primal_dual; }
  std::string label() const;
};
/// At λr = 1e-6, from F = 0.044.
void judge_sweep(Chapter& chapter, const Sweep& sweep, const Followed& followed);

}  // namespace talus::verification
