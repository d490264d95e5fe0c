// What a number is held against, and how near to it one has to be.
#pragma once

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

}  // namespace talus::verification
