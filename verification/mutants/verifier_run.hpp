// A verifier run in a folder of its own.
#pragma once

#include "verification/harness/process.hpp"
#include "verification/mutants/copy.hpp"

namespace talus::mutants {

struct Run {
  process::Outcome outcome;
  double seconds = 0;
};

/// With these variables (NAME=VALUE) in its environment; what it writes is removed, or goes where
/// --output of its command said if it has none. After so many seconds it is taken for hung.
Run run_verifier(const Verifier& verifier, const std::vector<std::string>& variables,
                 double time_limit);

}  // namespace talus::mutants
