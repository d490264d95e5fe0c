// The instrumented copy: made outside the tree, built once, run with each mutant.
#pragma once

#include <set>

#include "verification/mutants/catalogue.hpp"

namespace talus::mutants {

/// A command that passes on the code as it stands, and what it comes by.
struct Verifier {
  std::string name;
  std::vector<std::string> command;
  std::filesystem::path folder;  ///< that it runs in
  double seconds = 0;            ///< it took without a mutant
  std::set<int> reached = {};    ///< numbers of the mutants it evaluates
  bool is_study() const { return name.starts_with("verify_"); }  ///< of what ./run runs
};

/// Copies CMakeLists.txt, CMakePresets.json and the folders of the sources from `tree` to `copy`
/// with the mutants in them, mutant i chosen by i; writes only what has changed. Throws
/// io::UserError, e.g. for a stale mutant, or if `copy` holds something that is no copy.
void make_copy(const std::filesystem::path& tree, const std::filesystem::path& copy,
               const std::vector<Mutant>& mutants);

/// Configures and builds it. Throws io::UserError with the compiler's first error.
void build(const std::filesystem::path& copy);

/// The tests of CTest that evaluate a mutant, the quickest first, each run once without one; none
/// with the label reads-sources.
/// What that took and came by is kept beside the copy. Throws io::UserError if one fails,
/// std::runtime_error if interrupted.
std::vector<Verifier> verifiers(const std::filesystem::path& copy, int jobs);

/// What decides verdicts: all that was copied.
std::string fingerprint(const std::filesystem::path& copy);

}  // namespace talus::mutants
