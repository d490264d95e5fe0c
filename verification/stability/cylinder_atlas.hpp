// Paths in λr past yield, and what is said of them, apart from the solves.
#pragma once

#include "verification/cylinder/cylinder_runs.hpp"
#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// A way down in λr.
struct WayDown {
  std::string label;
  twod::Continuation continuation = twod::Continuation::arclength;
  bool regularises_pressure = true;
  double pressure_floor = 0;
  bool in_quick_run = true;
};
/// Arclength and primal-dual first, which are compared.
const std::vector<WayDown>& ways_down();

/// From λr = 0.1 down to 1e-6 at F = 0.054.
struct LambdaPath {
  rheology::Regularisation law;
  WayDown way;
  int around = 0;
  Followed followed;
};
void judge_atlas(Chapter& chapter, const std::vector<LambdaPath>& paths);

/// Of one law at F = 0.052: as usual, and under other penalties.
struct PenaltyPaths {
  struct Tried {
    mixed::PenaltyOptions penalty;
    Followed followed;
  };
  rheology::Regularisation law;
  Followed usual;
  std::vector<Tried> tried;
};
void judge_penalties(Chapter& chapter, const PenaltyPaths& paths);

}  // namespace talus::verification
