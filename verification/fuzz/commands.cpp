// Command lines: fair, odd and wrong ones, in empty folders and over the results of earlier runs.
#include <algorithm>
#include <fstream>

#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;

// A refusal names what is wrong; of values that are each in range, the two that do not go together.
void judge_reason(Trial& trial, const Program& program, const Line& line, const Outcome& outcome) {
  const auto is_named = [&](const std::string& text) {
    return outcome.err.find(text) != std::string::npos;
  };
  if (std::ranges::any_of(line.faults,
                          [&](const auto& fault) { return std::ranges::all_of(fault, is_named); }))
    return;
  const auto named =
      std::ranges::count_if(program.options,
                            [&](const Option& option) {
                              return is_named(option.name) || is_named(" " + option.name.substr(2));
                            }) +
      is_named("load");
  if (line.standing == Standing::wrong) {
    std::string missing;
    for (const auto& fault : line.faults)
      for (const std::string& text : fault)
        if (!is_named(text)) missing += " " + shell_word(text);
    trial.expect(named >= 2, "the refusal does not name" + missing + ": " + beginning(outcome.err));
  } else {
    trial.expect(named >= 2, "values in range refused, and not with what they do not go with: " +
                                 beginning(outcome.err));
  }
}

void judge_parameters(Trial& trial, const Program& program, const Line& line,
                      const fs::path& results) {
  const nlohmann::json summary = json_in(results / "summary.json");
  if (!summary.is_object()) return;
  trial.expect(summary.value("scene", "") == program.name, "summary.json of another scene");
  const nlohmann::json& parameters = summary["parameters"];
  for (const auto& [key, value] : line.meant.items()) {
    const nlohmann::json& recorded = key == "model" ? summary : parameters;
    if (recorded.contains(key))
      trial.expect(
          is_same(value, recorded[key]),
          "misread: " + key + " is " + recorded[key].dump() + ", given was " + value.dump());
  }
}

// Whether the tangent is the derivative is told; only the broken ones are none.
void judge_jacobian(Trial& trial, const Line& line, const Outcome& outcome) {
  const bool is_right = outcome.out.find("The tangent is the derivative") != std::string::npos;
  trial.expect(is_right == outcome.is_success(), "verdict and exit code do not agree");
  const bool is_broken = std::ranges::any_of(line.arguments, [](const std::string& argument) {
    return argument.find("wrong-sign") != std::string::npos ||
           argument.find("frozen") != std::string::npos;
  });
  const bool is_open = outcome.out.find("No verdict") != std::string::npos;
  if (!is_broken && !is_open) trial.expect(is_right, "a right tangent is called wrong");
}

}  // namespace

void try_command_line(Trial& trial) {
  const char* const names[] = {"chute",    "chute",        "bagnold",      "bagnold",
                               "heap",     "heap",         "heap",         "cylinder",
                               "cylinder", "manufactured", "manufactured", "verify"};
  const Program& program = trial.programs.named(trial.random.one_of(names));
  const Line line = draw_line(program, trial.random);
  const fs::path results =
      trial.folder / (line.output.empty() ? "results/" + program.name : line.output);

  // A folder may hold an older success, and something of the user's.
  const char* const note = "notes.txt";
  if (program.name != "verify" && trial.random.chance(0.3)) {
    trial.place_earlier_results(program.name, results);
    std::ofstream(results / note) << "mine\n";
  }
  const bool has_note = fs::exists(results / note);
  const auto before = listing(trial.folder);
  const auto start = fs::file_time_type::clock::now() - std::chrono::seconds(1);

  const Outcome outcome = trial.run(trial.command(program.name, line.arguments));
  if (outcome.hung || outcome.signal != 0) return trial.ended("crash or hang");

  const auto after = listing(trial.folder);
  if (line.standing == Standing::wrong && outcome.code != 2)
    trial.expect(false, "wrong input, exit code " + std::to_string(outcome.code));
  if (outcome.code == 2) {
    trial.ended("refused");
    judge_refusal(trial, outcome);
    judge_reason(trial, program, line, outcome);
    trial.expect(before == after, "refused, but files were written or removed");
    return;
  }
  trial.ended(outcome.is_success() ? "success" : "no success");
  if (line.has("--check-jacobian")) {
    trial.expect(before == after, "--check-jacobian wrote files");
    return judge_jacobian(trial, line, outcome);
  }
  if (line.has("--list")) return judge_success(trial, outcome, "");
  outcome.is_success() ? judge_success(trial, outcome, results)
                       : judge_failed_solve(trial, outcome, results);
  judge_parameters(trial, program, line, results);
  std::string stale;
  for (const auto& [name, mark] : after)
    if (mark.written < start && !name.ends_with(note) && !line.has("--resume")) stale += " " + name;
  trial.expect(stale.empty(), "stale:" + stale);
  trial.expect(has_note == fs::exists(results / note), "a file of the user is gone");
}

}  // namespace talus::fuzz
