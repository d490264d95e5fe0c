// Signals at any moment: what is left is whole or absent, nothing runs on, and the next run works.
#include <chrono>
#include <csignal>
#include <cstring>

#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {
namespace {

using Arguments = std::vector<std::string>;

struct Victim {
  std::string program;
  Arguments arguments;
};

Victim draw_victim(Random& random) {
  const int n = random.whole(1, 8);
  switch (random.below(4)) {
    case 0:
      return {"chute", {"--plot", "--elements", std::to_string(400 * n)}};
    case 1:
      return {"heap",
              {"--plot", "--elements", std::to_string(4 * n) + "x" + std::to_string(6 * n)}};
    case 2:
      return {"heap",
              {"--plot", "--model", "space", "--elements", "1x" + std::to_string(n + 1) + "x9"}};
    default:
      return {"cylinder",
              {"--around", "16", "--sweep", "0.01:0.04:" + std::to_string(n + 1), "--lambda-r",
               "1e-3", "--continuation", random.chance(0.5) ? "arclength" : "primal-dual"}};
  }
}

}  // namespace

void try_kill(Trial& trial) {
  // 1. The run as it is without a signal, and how long it takes.
  Victim victim = draw_victim(trial.random);
  const auto results = [&](const char* subfolder) {
    return trial.folder / subfolder / "results" / victim.program;
  };
  const auto start = std::chrono::steady_clock::now();
  const Outcome whole = trial.run(trial.command(victim.program, victim.arguments, "whole"));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  judge_success(trial, whole, results("whole"));

  // 2. Once more, and a signal at some moment: from a terminal to all of the group.
  const int signals[] = {SIGKILL, SIGKILL, SIGINT, SIGTERM, SIGHUP};
  const int signal = trial.random.one_of(signals);
  const double moment = trial.random.real(0, 1.05 * seconds);
  const Command command = trial.command(victim.program, victim.arguments, "killed");
  trial.note("(mkdir -p killed; cd killed; timeout -s " + std::to_string(signal) + " " +
             std::to_string(moment) + " " + shell_line(command) + ")");
  {
    Process process(command);
    process.ends_within(moment);
    process.send(signal, signal == SIGINT || signal == SIGHUP);
    const Outcome killed = process.outcome();
    trial.ended(killed.code == 0 ? "was over" : "killed by " + std::string(sigabbrev_np(signal)));
    trial.expect(killed.code == 0 || killed.signal == signal || killed.code == 128 + signal,
                 "exit code " + std::to_string(killed.code) + ", signal " +
                     std::to_string(killed.signal) + " after a signal");
    trial.expect(process.leaves_nothing_running(), "a child of it runs on");
    for (const std::string& file : torn_files(results("killed")))
      trial.expect(false, "torn file: " + file);
    if (signal != SIGKILL)  // of which a program hears nothing
      for (const std::string& file : files_left_behind(results("killed")))
        trial.expect(false, "file left behind by a signal: " + file);
  }

  // 3. The next run finds nothing in its way, and comes to the same.
  if (victim.program == "cylinder") victim.arguments.push_back("--resume");
  const Outcome next = trial.run(trial.command(victim.program, victim.arguments, "killed"));
  judge_success(trial, next, results("killed"));
  std::string different;
  for (const std::string& file : differences(results("whole"), results("killed")))
    // What a resumed run tells of its way is its own.
    if (victim.program != "cylinder" || file.starts_with("flow_") || file == "sweep.csv" ||
        file == "perimeter.csv" || file.ends_with(" (only once)"))
      different += " " + file;
  trial.expect(different.empty(), "another result than without the signal:" + different);
}

}  // namespace talus::fuzz
