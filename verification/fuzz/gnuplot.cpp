// A gnuplot that fails, hangs, draws half or is missing: the results stand, the figures are not
// old.
#include <fstream>

#include "verification/fuzz/judge.hpp"
#include "verification/fuzz/kinds.hpp"

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;

struct Gnuplot {
  std::string what, script;  ///< no script: there is no gnuplot
};

const Gnuplot gnuplots[] = {{"is missing", ""},
                            {"fails", "cat >/dev/null; exit 1"},
                            {"fails at once", "exit 3"},
                            {"complains and fails", "echo 'cannot open display' >&2; exit 1"},
                            {"draws nothing", "cat >/dev/null; exit 0"},
                            {"is killed", "kill -KILL $$"},
                            {"crashes", "read -r line; kill -SEGV $$"},
                            {"hangs", "exec sleep 1000"},
                            {"hangs with a child", "sleep 1000; true"},
                            {"is slow", "sleep 1; exec /usr/bin/gnuplot \"$@\""}};

}  // namespace

void try_gnuplot(Trial& trial) {
  // 1. Another gnuplot, first in PATH.
  const Gnuplot& gnuplot = trial.random.one_of(gnuplots);
  const fs::path bin = trial.folder / "bin";
  fs::create_directory(bin);
  std::string path = bin.string();
  if (!gnuplot.script.empty()) {
    std::ofstream(bin / "gnuplot") << "#!/bin/sh\n" << gnuplot.script << '\n';
    fs::permissions(bin / "gnuplot", fs::perms::owner_all);
    path += ":/usr/bin:/bin";
  }
  trial.note("mkdir bin");
  if (!gnuplot.script.empty())
    trial.note("printf '%s\\n' '#!/bin/sh' " + shell_word(gnuplot.script) +
               " >bin/gnuplot; chmod +x bin/gnuplot");

  // 2. A run in a folder with the figures of an earlier one, or in an empty one.
  const std::pair<const char*, std::vector<std::string>> runs[] = {
      {"chute", {"--plot", "--elements", "11"}},
      {"bagnold", {"--plot", "--elements", "11"}},
      {"heap", {"--plot", "--elements", "4x5"}},
      {"cylinder", {"--plot", "--around", "16", "--loading", "0.015", "--lambda-r", "1e-2"}}};
  const auto& [program, arguments] = trial.random.one_of(runs);
  const fs::path results = trial.folder / "results" / program;
  if (trial.random.chance(0.6)) trial.place_earlier_results(program, results);
  const auto before = listing(results);
  Command command = trial.command(program, arguments);
  trial.note("PATH=\"$PWD/bin" + path.substr(bin.string().size()) + "\" " + shell_line(command));
  command.path = path;
  Process process(command);
  const Outcome outcome = process.outcome();
  trial.look_at(outcome);
  trial.ended("gnuplot " + gnuplot.what);
  trial.expect(process.leaves_nothing_running(), "gnuplot runs on");

  // 3. The solve is a success all the same, and says what became of the figure.
  std::string figures, old;
  for (const auto& [name, mark] : listing(results)) {
    if (name.ends_with(".png") || name.ends_with(".svg")) figures += " " + name;
    if (before.contains(name) && before.at(name) == mark) old += " " + name;
  }
  trial.expect(old.empty(), "of the earlier run:" + old);
  judge_files(trial, results);
  trial.expect(outcome.code == 0, "exit code " + std::to_string(outcome.code) + ", gnuplot " +
                                      gnuplot.what + ": " + beginning(outcome.err));
  trial.expect(json_in(results / "summary.json").is_object(), "no summary.json");
  if (gnuplot.what == "is slow")
    return void(trial.expect(!figures.empty(), "a slow gnuplot, and no figure"));
  trial.expect(figures.empty(), "gnuplot " + gnuplot.what + ", and there are" + figures);
  const std::string words = outcome.out + outcome.err;
  trial.expect(words.find("gnuplot") != std::string::npos,
               "gnuplot " + gnuplot.what + ", and not a word of it");
  if (gnuplot.what != "is missing")
    trial.expect(words.find("missing") == std::string::npos,
                 "gnuplot that " + gnuplot.what + " is called missing");
}

}  // namespace talus::fuzz
