// The penalty of velocity-pressure flow on the command line and in summary.json.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "common/io/command_line.hpp"
#include "common/mixed/mixed_flow.hpp"

namespace talus::program {

/// As typed; `penalty_of` makes sense of it.
struct PenaltyOptions {
  double plain = 1e-6;  ///< λp of a plain penalty by default, in the scene's units
  std::string kind = "iterated";
  double lambda_p = 0;  ///< 0: the kind's own default
};

/// Adds --penalty and --lambda-p; set the scene's `plain` first.
void add_penalty(io::CommandLine& line, PenaltyOptions& options);

mixed::PenaltyOptions penalty_of(const PenaltyOptions& options);

/// penalty and lambda_p.
nlohmann::json as_json(const mixed::PenaltyOptions& penalty);

}  // namespace talus::program
