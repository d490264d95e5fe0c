// Pairs of runs whose answers are related: by theory, or because they are the same run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verification/fuzz/trial.hpp"

namespace talus::fuzz {

struct Relation {
  std::string name;
  void (*run)(Trial&);
};

/// Of the programs as such: same line twice, another order, defaults, threads, resumption, records.
const std::vector<Relation>& relations_of_runs();
/// Of the flows: methods, models, scales, meshes, loads.
const std::vector<Relation>& relations_of_flows();

using Arguments = std::vector<std::string>;
Arguments operator+(Arguments a, const Arguments& b);

/// The summary of a run in a subfolder; a fault and nothing if it is no success.
std::optional<nlohmann::json> solved(Trial& trial, const std::string& program,
                                     const Arguments& arguments, const std::string& subfolder);

}  // namespace talus::fuzz
