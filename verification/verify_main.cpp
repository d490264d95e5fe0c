// The verification suite: runs studies, draws their figures, writes one report.
//
// Sample runs:
//   verify jacobian
//   verify orders/section paper --output results/verify
//   verify cylinder stability --full --jobs 1
//   verify --full --list --output results/parts
//   verify --merge results/parts
//   verify paper --data experiments.csv
#include <iostream>

#include "common/io/options.hpp"
#include "common/io/progress.hpp"
#include "common/io/shell.hpp"
#include "verification/harness/merge.hpp"
#include "verification/harness/runner.hpp"

using namespace talus;
using verification::Part;
using verification::Study;

namespace {

struct Asked {
  std::vector<std::string> names;
  verification::RunOptions run{.full = false, .jobs = verification::default_jobs()};
  bool list = false;
  std::string merge, data, output = "results/verify";
};

std::string minutes(double value) {
  return value < 1 ? io::fixed(60 * value, 0) + " s"
                   : io::fixed(value, value < 10 ? 1 : 0) + " min";
}

// What runs and how long it takes, before it does.
void announce(const std::vector<Study>& chosen, const verification::RunOptions& options) {
  double all = 0;
  for (const Study& study : chosen) {
    const double each = study.minutes().of(options.full);
    std::cout << study.name << ": about " << minutes(each) << " of CPU time\n";
    all += each;
  }
  std::cout << "in all: about " << minutes(all) << " of CPU time, "
            << minutes(verification::expected_minutes(chosen, options)) << " with --jobs "
            << options.jobs << " (as measured on " << verification::measured_on << ")\n"
            << std::flush;
}

// The studies and parts of these names, all if there are none.
std::vector<Study> chosen_studies(const std::vector<std::string>& names) {
  std::vector<std::string> studies, all;
  std::vector<Study> chosen;
  const auto is_named = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (Study study : verification::studies()) {
    studies.push_back(study.name);
    all.push_back(study.name);
    for (const Part& part : study.parts) all.push_back(study.name_of(part));
    if (!names.empty() && !is_named(study.name))
      std::erase_if(study.parts, [&](const Part& part) { return !is_named(study.name_of(part)); });
    if (!study.parts.empty()) chosen.push_back(std::move(study));
  }
  for (const std::string& name : names) {
    if (std::ranges::find(all, name) != all.end()) continue;
    // Of a part that there is not, those of its study.
    const std::string beginning = name.substr(0, name.find('/') + 1);
    std::vector<std::string> known;
    if (!beginning.empty())
      std::ranges::copy_if(all, std::back_inserter(known),
                           [&](const std::string& each) { return each.starts_with(beginning); });
    std::string list;
    for (const std::string& each : known.empty() ? studies : known)
      list += (list.empty() ? "" : ", ") + each;
    throw io::UserError("STUDY: '" + name + "' is none of: " + list + io::did_you_mean(name, all));
  }
  return chosen;
}

std::vector<verification::OpenFigure> open_figures(const std::vector<Study>& studies) {
  std::vector<verification::OpenFigure> all;
  for (const Study& study : studies)
    all.insert(all.end(), study.open_figures.begin(), study.open_figures.end());
  return all;
}

std::string names_of_drawing_studies() {
  std::string names;
  for (const Study& study : verification::studies())
    if (!study.open_figures.empty()) names += (names.empty() ? "" : ", ") + study.name;
  return names;
}

// The parts as command lines, each with a folder of its own below `output`.
void print_parts(const std::vector<Study>& chosen, const Asked& asked) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  for (const Study& study : chosen)
    for (const Part& part : study.parts) {
      const std::string name = study.name_of(part);
      std::string own = name;
      std::ranges::replace(own, '/', '-');
      const bool draws = !asked.data.empty() && !study.open_figures.empty();
      std::cout << io::shell_word(program) << ' ' << name << (asked.run.full ? " --full" : "")
                << (draws ? " --data " + io::shell_word(asked.data) : "") << " --output "
                << io::shell_word((std::filesystem::path(asked.output) / own).string()) << '\n';
    }
}

std::vector<verification::Written> run(const std::vector<Study>& chosen, const Asked& asked,
                                       const io::ResultFolder& folder) {
  announce(chosen, asked.run);
  io::Progress progress;
  return verification::run_studies(
      chosen, asked.run, folder,
      [&](const std::string& running, double done) { progress.show(running, done); });
}

// Where there are parts to merge, in which case nothing is run. Chapters of other programs join
// those that were chosen.
verification::Found found_parts(const Asked& asked, std::vector<Study>& chosen) {
  std::vector<std::filesystem::path> folders;
  for (const std::string& each : io::split(asked.merge, ',')) folders.emplace_back(each);
  std::vector<Study> all = verification::studies();
  const auto& others = verification::studies_elsewhere();
  all.insert(all.end(), others.begin(), others.end());
  const auto found = verification::find_parts(all, folders);
  if (asked.names.empty())
    std::ranges::copy_if(others, std::back_inserter(chosen),
                         [&](const Study& study) { return found.folders.contains(study.name); });
  if (asked.run.full && !found.is_full)
    throw io::UserError("--full: the parts to --merge were run without");
  return found;
}

// Whether every check holds.
bool report(const std::vector<verification::Written>& chapters, const Asked& asked,
            const io::ResultFolder& folder) {
  std::string command = "./run verify";
  for (const std::string& name : asked.names) command += " " + name;
  if (asked.run.full) command += " --full";
  if (!asked.merge.empty()) command += " --merge " + io::shell_word(asked.merge);
  if (!asked.data.empty()) command += " --data " + io::shell_word(asked.data);
  verification::write_report(folder, chapters, command);
  bool passed = true;
  for (const auto& chapter : chapters) {
    std::cout << chapter.name << ": " << chapter.held() << " of " << chapter.checks.size()
              << " checks hold (" << io::fixed(chapter.seconds(), chapter.seconds() < 10 ? 1 : 0)
              << " CPU s)\n"
              << chapter.failures();
    passed = passed && chapter.passed();
  }
  if (!io::gnuplot_is_available()) std::cout << "Figures skipped: gnuplot is missing.\n";
  std::cout << "report: " << (folder.path() / "index.html").string() << '\n';
  return passed;
}

// For --help: the studies, what they ask, and how long they take.
std::string table_of_studies() {
  std::string text = "STUDIES (CPU time, with --full):";
  for (const Study& study : verification::studies())
    text += "\n  " + study.name + std::string(11 - study.name.size(), ' ') + study.question + " (" +
            minutes(study.minutes().quick) + ", " + minutes(study.minutes().full) + ")";
  return text + "\nThe parts of a study, as --list tells them, are named like orders/section.";
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{
      "Verification of the μ(I) solvers: Jacobians, orders, the paper's figures, cost, "
      "stability",
      "verify", table_of_studies()};
  Asked asked;
  io::add_words(line, "STUDY", asked.names,
                "Studies, or parts of them, to run (all if none is named)");
  io::add_flag(line, "--full", asked.run.full, "Finer meshes and sweeps");
  io::add_integer(line, "--jobs", asked.run.jobs, "Parts of studies at a time", 1, 64);
  io::add_flag(
      line, "--list", asked.list,
      "Only list the command lines of the parts, each with a folder of its own in --output, "
      "or in results/parts");
  io::add_text(line, "--merge", asked.merge,
               "Run nothing; take the parts from these folders, or the folders within")
      .takes(1, 1000);
  io::add_text(line, "--data", asked.data,
               "Curves of others to draw in the paper's figures: a table figure,panel,curve,x,y");
  io::add_text(line, "--output", asked.output, "Folder for the report and its files");
  return line.run(argc, argv, [&] {
    const bool runs = asked.merge.empty();
    io::refuse_unused(line, {{{"--jobs", "--merge"}, !asked.list, "--list"},
                             {{"--jobs", "--data"}, runs, "--merge"}});
    auto chosen = chosen_studies(asked.names);
    const auto open = open_figures(chosen);
    io::refuse_unused(line, {{{"--data"},
                              !open.empty(),
                              "any of these studies, only by " + names_of_drawing_studies()}});
    if (!asked.data.empty()) asked.run.given = verification::read_given_curves(asked.data, open);
    if (asked.list) {
      if (!line.is_given("--output")) asked.output = "results/parts";
      print_parts(chosen, asked);
      return 0;
    }
    const auto found = runs ? verification::Found{} : found_parts(asked, chosen);
    if (!runs) asked.run.full = found.is_full;
    const io::ResultFolder folder(asked.output);
    folder.remove_older(verification::report_files(verification::studies()));
    const auto chapters =
        runs ? run(chosen, asked, folder) : verification::merge_studies(chosen, found, folder);
    return report(chapters, asked, folder) ? 0 : 1;
  });
}
