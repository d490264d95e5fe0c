// Numbers that a scene is held against where nothing exact is known, each with its source.
#pragma once

#include <stdexcept>
#include <string>

namespace talus::verification {

/// What a check holds a number against.
enum class Kind {
  exact,             ///< an exact solution
  manufactured,      ///< a solution that the load was made for
  other_code,        ///< what another code finds
  publication,       ///< what is printed
  other_method,      ///< another method, model or formula here
  self_consistency,  ///< what must hold of any solution, or from run to run
  control            ///< something broken, which must be noticed
};
inline constexpr Kind kinds_of_checks[] = {
    Kind::exact,        Kind::manufactured,     Kind::other_code, Kind::publication,
    Kind::other_method, Kind::self_consistency, Kind::control};
std::string name_of(Kind kind);
/// Throws std::out_of_range.
Kind kind_named(const std::string& name);

/// A number, and how far from it one may be.
struct Reference {
  double value = 0, uncertainty = 0;
  const char* source = "";
  Kind kind = Kind::other_code;

  /// With a share of the value for its uncertainty: coarser meshes need more room.
  constexpr Reference within(double share) const { return {value, share * value, source, kind}; }
};

namespace references {

// The heap's cross-section without regularisation: flow rate Q* at α = 0.42.
inline constexpr Reference heap_flow_rate{82.49, 0.01,
                                          "limit of another solver, by an augmented Lagrangian"};
inline constexpr Reference heap_flow_rate_on_70x100{
    82.2993, 1e-4, "the same solver on 70x100 uniform elements, no slip"};
inline constexpr Reference heap_flow_rate_limit{
    82.495, 0.001,
    "ours: 82.4925 on 70x100, 82.4941 on 140x200, graded quadratically, friction at the wall",
    Kind::other_method};

/// The cylinder in creep, eq. (12) at λr = 1e-6: drag in p_ext D, U in sqrt(p_ext/(φρ)). Throws
/// std::out_of_range for a loading that the source does not have.
struct CylinderCreep {
  Reference drag, mean_velocity;
};
inline CylinderCreep cylinder_creep(double loading) {
  constexpr const char* source = "another code, Q2/P1, 160 elements around, of first order";
  constexpr double good_to = 0.005;
  const auto creep = [&](double drag, double velocity) {
    return CylinderCreep{Reference{drag, 0, source}.within(good_to),
                         Reference{velocity, 0, source}.within(good_to)};
  };
  if (loading == 0.01) return creep(1.64313, 4.97e-7);
  if (loading == 0.04) return creep(4.61716, 3.22e-6);
  throw std::out_of_range("no creep of the cylinder is known at F = " + std::to_string(loading));
}

}  // namespace references
}  // namespace talus::verification
