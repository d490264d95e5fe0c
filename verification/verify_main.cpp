// The verification suite: runs studies, draws their figures, writes one report.
//
// Sample runs:
//   verify --list
//   verify jacobian
//   verify orders paper --output results/verify
//   verify cylinder stability --full --jobs 1
#include <iostream>

#include "common/io/options.hpp"
#include "common/io/progress.hpp"
#include "verification/harness/runner.hpp"

using namespace talus;

namespace {

std::string minutes(double value) {
  return value < 1 ? io::fixed(60 * value, 0) + " s"
                   : io::fixed(value, value < 10 ? 1 : 0) + " min";
}

// What runs and how long it takes, before it does.
void announce(const std::vector<verification::Study>& chosen,
              const verification::RunOptions& options) {
  double all = 0;
  for (const auto& study : chosen) {
    const double each = study.minutes.of(options.full);
    std::cout << study.name << ": about " << minutes(each) << " of CPU time\n";
    all += each;
  }
  std::cout << "in all: about " << minutes(all) << " of CPU time, "
            << minutes(verification::expected_minutes(chosen, options)) << " with --jobs "
            << options.jobs << " (as measured on " << verification::measured_on << ")\n"
            << std::flush;
}

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
  verification::RunOptions options{.full = false, .jobs = verification::default_jobs()};
  bool list = false;
  std::string output = "results/verify";
  app.add_option("STUDY", names, "Studies to run (all if none is named)");
  app.add_flag("--full", options.full, "Finer meshes and sweeps");
  app.add_flag("--list", list, "Only list the studies, with the minutes of CPU time they take");
  io::add_integer(app, "--jobs", options.jobs, "Studies at a time", 1, 64);
  io::add_text(app, "--output", output, "Folder for the report and its files");
  return io::run_program(app, argc, argv, [&] {
    io::refuse_unused(app, {{{"--full", "--jobs", "--output"}, !list, "--list"}});
    const auto chosen = chosen_studies(names);
    if (list) {
      for (const auto& study : chosen)
        std::cout << study.name << "\tabout " << minutes(study.minutes.quick) << ", with --full "
                  << minutes(study.minutes.full) << "\t" << study.question << '\n';
      return 0;
    }
    const io::ResultFolder folder(output);
    folder.remove_older({"index.html"});
    announce(chosen, options);
    std::vector<verification::Written> chapters;
    {
      io::Progress progress;
      chapters = verification::run_studies(
          chosen, options, folder,
          [&](const std::string& running, double done) { progress.show(running, done); });
    }
    std::string command = "./run verify";
    for (const std::string& name : names) command += " " + name;
    if (options.full) command += " --full";
    folder.write("index.html", verification::html_report(chapters, command));

    bool passed = true;
    for (const auto& chapter : chapters) {
      std::cout << chapter.name << ": " << chapter.held << " of " << chapter.checks
                << " checks hold (" << io::fixed(chapter.seconds, chapter.seconds < 10 ? 1 : 0)
                << " CPU s)\n"
                << chapter.failures;
      passed = passed && chapter.passed();
    }
    if (!io::gnuplot_is_available()) std::cout << "Figures skipped: gnuplot is missing.\n";
    std::cout << "report: " << (folder.path() / "index.html").string() << '\n';
    return passed ? 0 : 1;
  });
}
