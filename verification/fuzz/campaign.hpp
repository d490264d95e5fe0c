// Many trials, some at a time; what they found, and how often what came of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/io/table.hpp"
#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {

struct CampaignOptions {
  std::uint64_t seed = 1;
  std::vector<Kind> kinds;   ///< to try
  bool full = false;         ///< as many trials of each as its `many`
  std::optional<int> count;  ///< of each kind, instead
  std::optional<int> only;   ///< this trial of each kind alone
  int jobs = 2;
  double time_limit = 400;  ///< of each run, in seconds: beyond, it is taken for hung
};

struct Finding {
  std::string kind, script, fault;
  int number = 0;
};

struct Findings {
  std::vector<Finding> faults;
  std::map<std::string, std::map<std::string, int>> counts;  ///< by kind and outcome
  bool interrupted = false;

  io::Table table() const;
};

/// Trials in folders of their own under a temporary one that is removed at the end. Faults are
/// written to `out` as they come, a line each. Programs are those in the folder.
Findings campaign(const CampaignOptions& options, const std::filesystem::path& programs,
                  std::ostream& out);

}  // namespace talus::fuzz
