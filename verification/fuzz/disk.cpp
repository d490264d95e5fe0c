// Full disks, a full stdout, and folders that are none.
#include <fstream>

#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

struct Run {
  std::string program;
  Arguments arguments;
};

Run draw_run(Random& random) {
  const Run runs[] = {
      {"chute", {"--elements", "30"}},
      {"chute", {"--elements", "10", "--plot"}},
      {"bagnold", {"--method", "interior-point"}},
      {"heap", {"--elements", "4x5", "--plot"}},
      {"heap", {"--model", "space", "--elements", "1x2x3"}},
      {"cylinder", {"--around", "16", "--loading", "0.01", "0.02", "--lambda-r", "1e-2"}},
      {"chute", {"--model", "plane", "--elements", "6", "--plot"}},
      {"manufactured", {"--model", "space", "--elements", "2"}},
      {"chute", {"--pressure", "20"}}};
  return random.one_of(runs);
}

void judge_full_disk(Trial& trial, const Run& run) {
  Command command = trial.command(run.program, run.arguments);
  command.file_size = static_cast<std::uint64_t>(trial.random.magnitude(1, 2e5));
  const Outcome outcome = trial.run(command);
  const fs::path results = trial.folder / "results" / run.program;
  trial.ended("full disk, exit code " + std::to_string(outcome.code));
  judge_files(trial, results);
  if (outcome.code == 2) {
    trial.expect(outcome.err.find("write") != std::string::npos && outcome.err.ends_with('\n') &&
                     outcome.err.size() > 20,
                 "a full disk is not told: " + beginning(outcome.err));
    trial.expect(!fs::exists(results / "summary.json") ||
                     outcome.err.find("summary.json") == std::string::npos,
                 "a summary that could not be written is there");
  } else if (outcome.code == 0) {
    judge_success(trial, outcome, results);
  } else {
    judge_failed_solve(trial, outcome, results);
  }
}

void judge_full_stdout(Trial& trial, const Run& run) {
  Command command = trial.command(run.program, run.arguments);
  command.stdout_is_full = true;
  const Outcome outcome = trial.run(command);
  trial.ended("full stdout, exit code " + std::to_string(outcome.code));
  trial.expect(outcome.code != 0, "a full stdout, and exit code 0");
  trial.expect(!outcome.err.empty(), "a full stdout, and not a word");
  judge_files(trial, trial.folder / "results" / run.program);
}

// A place where no folder can be, or where it cannot hold a file.
void judge_place(Trial& trial, const Run& run) {
  std::ofstream(trial.folder / "file") << "mine\n";
  fs::create_symlink("nowhere/at/all", trial.folder / "dangling");
  fs::create_directories(trial.folder / "taken/summary.json/below");
  const std::string places[] = {"file",  "file/below",          "/proc/fuzz", "/dev/null", "",
                                "taken", std::string(300, 'x'), "dangling/x", "/sys/x/y"};
  const std::string place = trial.random.one_of(places);
  trial.note("touch file; ln -s nowhere/at/all dangling; mkdir -p taken/summary.json/below");
  Arguments arguments = run.arguments;
  const std::string option = "--output";
  if (trial.random.chance(0.5) || place.empty())
    arguments.insert(arguments.end(), {option, place});
  else
    arguments.push_back(option + "=" + place);
  const auto before = listing(trial.folder);
  const Outcome outcome = trial.run(trial.command(run.program, arguments));
  if (place == "dangling/x" && outcome.code != 2) return trial.ended("place made");
  trial.ended("place refused");
  trial.expect(outcome.code == 2, "exit code " + std::to_string(outcome.code) + " for a folder '" +
                                      place.substr(0, 20) + "'");
  if (place != "taken") judge_refusal(trial, outcome);
  trial.expect(outcome.err.find(option) != std::string::npos,
               "does not name --output: " + beginning(outcome.err));
  if (place != "taken")
    trial.expect(before == listing(trial.folder), "files were written or removed");
}

// Names that are unusual, but possible.
void judge_name(Trial& trial, const Run& run) {
  const char* const names[] = {"it's", "a b", "\"quoted\"",  "$HOME", "a;b", "new\nline",
                               "µ",    "-x",  "back\\slash", "%s",    "*",   "#"};
  const std::string name = trial.random.one_of(names);
  Arguments arguments = run.arguments;
  arguments.push_back("--output=" + name);
  const Outcome outcome = trial.run(trial.command(run.program, arguments));
  trial.ended("unusual name");
  if (outcome.code == 1) return judge_failed_solve(trial, outcome, trial.folder / name);
  judge_success(trial, outcome, trial.folder / name);
  bool plots = false;
  for (const std::string& argument : run.arguments) plots = plots || argument == "--plot";
  int drawn = 0;
  for (const auto& [file, mark] : listing(trial.folder / name))
    drawn += file.ends_with(".png") || file.ends_with(".svg");
  if (plots) trial.expect(drawn >= 2, "no figure in a folder called " + shell_word(name));
}

}  // namespace

void try_disk(Trial& trial) {
  const Run run = draw_run(trial.random);
  const double share = trial.random.share();
  if (share < 0.4) return judge_full_disk(trial, run);
  if (share < 0.5) return judge_full_stdout(trial, run);
  if (share < 0.75) return judge_place(trial, run);
  judge_name(trial, run);
}

}  // namespace talus::fuzz
