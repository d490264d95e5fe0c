// A command line with the knowledge what must become of it.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "verification/fuzz/values.hpp"

namespace talus::fuzz {

struct Line {
  std::vector<std::string> arguments;
  Standing standing = Standing::fair;               ///< the worst of its parts
  std::vector<std::vector<std::string>> faults;     ///< for each: what its message has to name
  nlohmann::json meant = nlohmann::json::object();  ///< parameters as summary.json is to have them
  std::string output;                               ///< the folder of the results

  bool has(const std::string& argument) const;
};

/// Up to five options; about half of all lines have something wrong.
Line draw_line(const Program& program, Random& random);

/// Fair values only, of a run that can be expected to succeed.
Line draw_fair_line(const Program& program, Random& random);

}  // namespace talus::fuzz
