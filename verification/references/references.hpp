// What others find, each number with its source: what a scene is held against where nothing exact
// is known.
#pragma once

#include <string>
#include <vector>

#include "verification/harness/reference.hpp"

namespace talus::verification::references {

/// The heap's cross-section without regularisation: flow rate Q* at α = 0.42; where a mesh is
/// named, no slip on uniform elements.
inline constexpr const char* lagrangian = "another solver, by an augmented Lagrangian";
inline constexpr Reference heap_flow_rate{82.49, 0.01, lagrangian};
inline constexpr Reference heap_flow_rate_on_18x25{81.6587022, 5e-5, lagrangian};
inline constexpr Reference heap_flow_rate_on_35x50{82.0858, 1e-4, lagrangian};
inline constexpr Reference heap_flow_rate_on_70x100{82.2993, 1e-4, lagrangian};
inline constexpr Reference heap_flow_rate_limit{
    82.495, 0.001,
    "ours: 82.4925 on 70x100, 82.4941 on 140x200, graded quadratically, friction at the wall",
    Kind::other_method};

/// The cylinder in creep, eq. (12) at λr = 1e-6: drag in p_ext D, U in sqrt(p_ext/(φρ)). Throws
/// std::out_of_range for a loading that the source does not have.
struct CylinderCreep {
  Reference drag, mean_velocity;
};
CylinderCreep cylinder_creep(double loading);

/// What is known of the results of one command.
struct KnownCase {
  std::string scene, words;
  struct Result {
    std::string name;  ///< as in a case's results
    Reference reference;
  };
  std::vector<Result> results;
  bool full_only = false;  ///< takes too long for a quick run
};
/// Of these scenes.
std::vector<KnownCase> known_cases(const std::vector<std::string>& scenes);

/// The heap's surface on 35x50 uniform elements, eq. (12) at λr = 1e-5: velocity, and depths of the
/// flowing layer by 1% and 5% of it.
struct KnownSurface {
  struct At {
    double y, velocity, depth_1, depth_5;
  };
  double angle = 0;
  std::vector<At> points;

  static Reference velocity(const At& at);
  static Reference depth_1(const At& at);
  static Reference depth_5(const At& at);
};
const std::vector<KnownSurface>& known_surfaces();

}  // namespace talus::verification::references
