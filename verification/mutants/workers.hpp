// Verifiers run side by side, each in a folder of its own.
#pragma once

#include <functional>

#include "verification/harness/process.hpp"
#include "verification/mutants/copy.hpp"

namespace talus::mutants {

/// Calls `work` for 0 to count - 1, so many at a time, until SIGINT or SIGTERM. Whether all were
/// called.
bool in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work);
/// Whether one of these came.
bool interrupted();

struct Run {
  process::Outcome outcome;
  double seconds = 0;
};

/// With these variables (NAME=VALUE) in its environment; what it writes is removed, or goes where
/// --output of its command said if it has none. After so many seconds it is taken for hung.
Run run_verifier(const Verifier& verifier, const std::vector<std::string>& variables,
                 double time_limit);

}  // namespace talus::mutants
