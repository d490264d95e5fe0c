#include "verification/fuzz/folder.hpp"
#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/relations.hpp"

namespace talus::fuzz {
namespace {

std::string draw_program(Random& random) {
  const char* const names[] = {"chute", "bagnold", "heap", "cylinder", "manufactured"};
  return random.one_of(names);
}

// Two lines that say the same leave the same files; a line is not refused where the other is not.
void expect_same(Trial& trial, const std::string& program, const Arguments& a, const Arguments& b) {
  const Outcome first = trial.run(trial.command(program, a, "a"));
  const Outcome second = trial.run(trial.command(program, b, "b"));
  if (first.code == 2) trial.ended(trial.outcome() + " (refused)");
  if (!trial.expect(first.code == second.code,
                    "exit codes " + std::to_string(first.code) + " and " +
                        std::to_string(second.code) + ": " +
                        beginning(first.err.empty() ? second.err : first.err)))
    return;
  std::string different;
  for (const std::string& file : differences(trial.folder / "a", trial.folder / "b"))
    different += " " + file;
  trial.expect(different.empty(), "two runs that are the same differ in" + different);
}

void same_line_twice(Trial& trial) {
  const Program& program = trial.programs.named(draw_program(trial.random));
  const Arguments line = draw_fair_line(program, trial.random).arguments;
  expect_same(trial, program.name, line, line);
}

// Pairs of option and value, in another order, and with "=" between them.
void same_options_in_another_order(Trial& trial) {
  const Program& program = trial.programs.named(draw_program(trial.random));
  const Arguments line = draw_fair_line(program, trial.random).arguments;
  std::vector<Arguments> pieces;
  for (const std::string& word : line)
    if (word.starts_with("--") || pieces.empty())
      pieces.push_back({word});
    else
      pieces.back().push_back(word);
  trial.random.shuffle(pieces);
  Arguments other;
  for (Arguments piece : pieces) {
    if (piece.size() == 2 && trial.random.chance(0.5)) piece = {piece[0] + "=" + piece[1]};
    other = other + piece;
  }
  expect_same(trial, program.name, line, other);
}

void default_told_and_not_told(Trial& trial) {
  const Program& program = trial.programs.named(draw_program(trial.random));
  const Arguments line = draw_fair_line(program, trial.random).arguments;
  Arguments other = line;
  for (const Option& option : program.options) {
    bool is_there = option.standard.empty() || option.form == Form::reals;
    for (const std::string& word : line)
      is_there = is_there || word == option.name || word.starts_with(option.name + "=");
    if (is_there || !trial.random.chance(0.3)) continue;
    // An option that the method has no use for is refused, even with its default.
    if (trial.run(trial.command(program.name, line + Arguments{option.name, option.standard}, "c"))
            .code != 2)
      other = other + Arguments{option.name, option.standard};
  }
  expect_same(trial, program.name, line, other);
}

void any_number_of_threads(Trial& trial) {
  const char* const programs[] = {"cylinder", "manufactured"};
  const Program& program = trial.programs.named(trial.random.one_of(programs));
  Line line = draw_fair_line(program, trial.random);
  while (line.has("--threads")) line = draw_fair_line(program, trial.random);
  std::erase_if(line.arguments,
                [](const std::string& word) { return word.starts_with("--threads="); });
  const std::string n = std::to_string(trial.random.whole(2, 5));
  expect_same(trial, program.name, line.arguments + Arguments{"--threads", "1"},
              line.arguments + Arguments{"--threads", n});
}

// Iterations that are allowed, but not needed.
void more_iterations_than_needed(Trial& trial) {
  const char* const programs[] = {"chute", "bagnold", "heap"};
  const std::string program = trial.random.one_of(programs);
  const Arguments line = program == "heap" ? Arguments{"--elements", "4x5"} : Arguments{};
  const std::string n = std::to_string(trial.random.whole(300, 100000));
  expect_same(trial, program, line, line + Arguments{"--max-iterations", n});
}

void interrupted_and_resumed(Trial& trial) {
  const char* const ways[] = {"primal-dual", "arclength", "natural"};
  const char* const loadings[] = {"0.01,0.03", "0.02", "0.03,0.02,0.01", "0.035"};
  const Arguments line = {"--around",   "16",   "--loading",      trial.random.one_of(loadings),
                          "--lambda-r", "1e-3", "--continuation", trial.random.one_of(ways)};
  if (!solved(trial, "cylinder", line, "a")) return;
  const std::string n = std::to_string(trial.random.whole(2, 5));
  trial.run(trial.command("cylinder", line + Arguments{"--max-points", n}, "b"));
  if (!solved(trial, "cylinder", line + Arguments{"--resume"}, "b")) return;
  for (const char* file : {"sweep.csv", "perimeter.csv", "flow_0001.vtu"}) {
    const auto path = std::filesystem::path("results/cylinder") / file;
    trial.expect(contents_of(trial.folder / "a" / path) == contents_of(trial.folder / "b" / path),
                 std::string("other digits after --resume in ") + file);
  }
}

// A run in the folder of another one leaves what it leaves in an empty one.
void over_the_results_of_another_run(Trial& trial) {
  const Program& program = trial.programs.named(draw_program(trial.random));
  Arguments first = draw_fair_line(program, trial.random).arguments;
  const Arguments line = draw_fair_line(program, trial.random).arguments;
  if (trial.random.chance(0.5)) first.push_back("--plot");
  trial.run(trial.command(program.name, first, "b"));
  const Outcome probe = trial.run(trial.command(program.name, line, "c"));
  if (probe.code == 2) return trial.ended(trial.outcome() + " (refused)");
  expect_same(trial, program.name, line, line);
}

// The record of a case is the summary of its run, and leaves nothing else where nothing else is
// asked for.
void record_and_summary(Trial& trial) {
  const Program& program = trial.programs.named(draw_program(trial.random));
  const Arguments line = draw_fair_line(program, trial.random).arguments;
  const Arguments record = line + Arguments{"--record", "record.json"};
  const std::filesystem::path results = "results/" + program.name;
  const Outcome both =
      trial.run(trial.command(program.name, record + Arguments{"--output", results.string()}, "a"));
  const Outcome alone = trial.run(trial.command(program.name, record, "b"));
  if (both.code == 2) return trial.ended(trial.outcome() + " (refused)");
  trial.expect(both.code == alone.code, "another exit code without --output");
  const auto summary = json_in(trial.folder / "a" / results / "summary.json");
  trial.expect(summary.is_object() && summary == json_in(trial.folder / "a" / "record.json"),
               "the record is not the summary");
  trial.expect(summary.is_object() &&
                   json_in(trial.folder / "b" / "record.json").value("results", nlohmann::json()) ==
                       summary["results"],
               "other results in the record alone");
  const bool plots = std::ranges::find(line, "--plot") != line.end();
  trial.expect(plots || !std::filesystem::exists(trial.folder / "b" / results),
               "more than the record was written");
}

}  // namespace

const std::vector<Relation>& relations_of_runs() {
  static const std::vector<Relation> all = {{"same line twice", same_line_twice},
                                            {"another order", same_options_in_another_order},
                                            {"default told", default_told_and_not_told},
                                            {"any threads", any_number_of_threads},
                                            {"more iterations", more_iterations_than_needed},
                                            {"resumed", interrupted_and_resumed},
                                            {"over another run", over_the_results_of_another_run},
                                            {"record", record_and_summary}};
  return all;
}

}  // namespace talus::fuzz
