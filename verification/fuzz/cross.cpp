#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/kinds.hpp"
#include "verification/fuzz/relations.hpp"

namespace talus::fuzz {

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::optional<nlohmann::json> solved(Trial& trial, const std::string& program,
                                     const Arguments& arguments, const std::string& subfolder) {
  const Outcome outcome = trial.run(trial.command(program, arguments, subfolder));
  const auto results = trial.folder / subfolder / "results" / program;
  judge_success(trial, outcome, results);
  nlohmann::json summary = json_in(results / "summary.json");
  if (!outcome.is_success() || !summary.is_object()) return std::nullopt;
  return summary;
}

void try_cross_check(Trial& trial) {
  const auto& runs = relations_of_runs();
  const auto& flows = relations_of_flows();
  const std::size_t i = trial.random.below(runs.size() + flows.size());
  const Relation& relation = i < runs.size() ? runs[i] : flows[i - runs.size()];
  trial.ended(relation.name);
  relation.run(trial);
}

}  // namespace talus::fuzz
