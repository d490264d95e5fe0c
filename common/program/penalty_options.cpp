#include "common/program/penalty_options.hpp"

#include "common/io/options.hpp"
#include "common/io/table.hpp"

namespace talus::program {

void add_penalty(io::CommandLine& line, PenaltyOptions& options) {
  io::add_choice(line, "--penalty", options.kind,
                 "Iterated (none is left in the result), or the paper's plain one",
                 {"iterated", "plain"});
  io::add_real(line, "--lambda-p", options.lambda_p,
               "Penalty; default 1e-4 over the viscosity (iterated), " +
                   io::rounded(options.plain, 2) + " (plain)",
               1e-14, 1)
      .without_default();
}

mixed::PenaltyOptions penalty_of(const PenaltyOptions& options) {
  mixed::PenaltyOptions penalty;
  if (options.kind == "plain") penalty = {mixed::Penalty::plain, options.plain};
  if (options.lambda_p > 0) penalty.lambda_p = options.lambda_p;
  return penalty;
}

nlohmann::json as_json(const mixed::PenaltyOptions& penalty) {
  return {{"penalty", penalty.kind == mixed::Penalty::plain ? "plain" : "iterated"},
          {"lambda_p", penalty.lambda_p}};
}

}  // namespace talus::program
