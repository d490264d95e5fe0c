// The verification suite: runs studies, draws their figures, writes one report.
//
// Sample runs:
//   verify --list
//   verify jacobian
//   verify orders paper --output results/verify
//   verify --full
#include <iostream>

#include "common/io/options.hpp"
#include "common/io/progress.hpp"
#include "verification/runner.hpp"

using namespace talus;

namespace {

std::vector<verification::Study> chosen_studies(const std::vector<std::string>& names) {
  std::vector<verification::Study> chosen;
  std::string known;
  std::vector<std::string> all;
  for (const auto& study : verification::studies()) {
    all.push_back(study.name);
    known += (known.empty() ? "" : ", ") + study.name;
    if (names.empty() || std::find(names.begin(), names.end(), study.name) != names.end())
      chosen.push_back(study);
  }
  for (const std::string& name : names)
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&](const auto& study) { return study.name == name; }))
      throw io::UserError("STUDY: '" + name + "' is none of: " + known +
                          io::did_you_mean(name, all));
  return chosen;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Verification of the μ(I) solvers: Jacobians, orders, the paper's figures, cost, "
      "stability",
      "verify"};
  std::vector<std::string> names;
  bool full = false, list = false;
  std::string output = "results/verify";
  app.add_option("STUDY", names, "Studies to run (all if none is named)");
  app.add_flag("--full", full, "Finer meshes and sweeps");
  app.add_flag("--list", list, "Only list the studies");
  io::add_text(app, "--output", output, "Folder for the report and its files");
  return io::run_program(app, argc, argv, [&] {
    io::refuse_unused(app, {{{"--full", "--output"}, !list, "--list"}});
    const auto chosen = chosen_studies(names);
    if (list) {
      for (const auto& study : chosen) std::cout << study.name << "\t" << study.question << '\n';
      return 0;
    }
    const io::ResultFolder folder(output);
    folder.remove_older({"index.html"});
    std::vector<verification::Written> chapters;
    {
      io::Progress progress;
      chapters = verification::run_studies(
          chosen, full, folder,
          [&](const std::string& running, double done) { progress.show(running, done); });
    }
    std::string command = "./run verify";
    for (const std::string& name : names) command += " " + name;
    if (full) command += " --full";
    folder.write("index.html", verification::html_report(chapters, command));

    bool passed = true;
    for (const auto& chapter : chapters) {
      std::cout << chapter.name << ": " << chapter.held << " of " << chapter.checks
                << " checks hold (" << io::rounded(chapter.seconds, 2) << " CPU s)\n"
                << chapter.failures;
      passed = passed && chapter.passed();
    }
    if (!io::gnuplot_is_available()) std::cout << "Figures skipped: gnuplot is missing.\n";
    std::cout << "report: " << (folder.path() / "index.html").string() << '\n';
    return passed ? 0 : 1;
  });
}
