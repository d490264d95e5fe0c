// Two runs in one folder at once: one is refused, and the files are all of the other.
#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {
namespace {

using Arguments = std::vector<std::string>;

// Runs of some tenths of a second, each with another result.
Arguments draw_run(const std::string& program, Random& random) {
  const std::string n = std::to_string(random.whole(1, 9));
  if (program == "chute") return {"--elements", "200" + n, "--plot"};
  if (program == "heap") return {"--elements", "2" + n + "x30", "--plot"};
  return {"--around", "16", "--sweep", "0.01:0.0" + n + "5:4", "--lambda-r", "1e-2"};
}

}  // namespace

void try_neighbours(Trial& trial) {
  const char* const names[] = {"chute", "heap", "cylinder"};
  const std::string program = trial.random.one_of(names);
  const Arguments runs[] = {draw_run(program, trial.random), draw_run(program, trial.random)};
  const std::string results = "results/" + program;

  // 1. Both at once.
  const Command commands[] = {trial.command(program, runs[0], "both"),
                              trial.command(program, runs[1], "both")};
  const double delay = trial.random.chance(0.3) ? 0 : trial.random.real(0, 0.1);
  trial.note("(mkdir both; cd both; " + shell_line(commands[0]) + " & sleep " +
             std::to_string(delay) + "; " + shell_line(commands[1]) + "; wait)");
  Outcome outcomes[2];
  bool was_over = false;
  {
    Process first(commands[0]);
    was_over = first.ends_within(delay);
    Process second(commands[1]);
    outcomes[0] = first.outcome();
    outcomes[1] = second.outcome();
  }
  for (const Outcome& outcome : outcomes) trial.look_at(outcome);

  // 2. Who stayed, and whose files these are.
  const int refused = outcomes[0].code == 2 ? 0 : outcomes[1].code == 2 ? 1 : -1;
  const int stayed = refused == 0 ? 0 + 1 : refused == 1 ? 0 : 1;
  trial.ended(was_over ? "one after the other" : refused < 0 ? "both ran" : "one refused");
  if (refused >= 0) judge_refusal(trial, outcomes[refused]);
  if (!was_over) trial.expect(refused >= 0, "both ran in one folder at once");
  if (outcomes[stayed].code != 0) return;
  judge_success(trial, outcomes[stayed], trial.folder / "both" / results);
  trial.run(trial.command(program, runs[stayed], "alone"));
  std::string different;
  for (const std::string& file :
       differences(trial.folder / "alone" / results, trial.folder / "both" / results))
    different += " " + file;
  trial.expect(different.empty(), "files of both:" + different);
}

}  // namespace talus::fuzz
