// The verification suite: runs studies, draws their figures, writes one report.
//
// Sample runs:
//   verify --list
//   verify jacobian
//   verify orders paper --output results/verify
//   verify --full
#include <iostream>

#include <nlohmann/json.hpp>

#include "common/io/options.hpp"
#include "common/io/progress.hpp"
#include "common/solve/stopwatch.hpp"
#include "verification/html_report.hpp"

using namespace talus;

namespace {

std::vector<verification::Study> chosen_studies(const std::vector<std::string>& names) {
  std::vector<verification::Study> chosen;
  std::string known;
  for (const auto& study : verification::studies()) {
    known += (known.empty() ? "" : ", ") + study.name;
    if (names.empty() || std::find(names.begin(), names.end(), study.name) != names.end())
      chosen.push_back(study);
  }
  for (const std::string& name : names)
    if (std::none_of(chosen.begin(), chosen.end(),
                     [&](const auto& study) { return study.name == name; }))
      throw io::UserError("STUDY: '" + name + "' is none of: " + known);
  return chosen;
}

// Figures, tables and checks of a chapter, as files.
void write_files(const io::ResultFolder& folder, const verification::Chapter& chapter) {
  io::Table checks{"", {"check", "value", "lower", "upper", "holds"}, {}};
  for (const auto& check : chapter.checks)
    checks.rows.push_back({check.what, io::exact(check.value), io::exact(check.lower),
                           io::exact(check.upper), check.passed() ? "yes" : "no"});
  folder.write("checks.csv", io::to_csv(checks));
  int tables = 0;
  for (const auto& block : chapter.blocks) {
    if (const auto* table = std::get_if<io::Table>(&block))
      folder.write("table" + std::to_string(++tables) + ".csv", io::to_csv(*table));
    else if (const auto* figure = std::get_if<io::Figure>(&block))
      io::write_figure(folder, *figure, "svg");
  }
}

void print_chapter(const verification::Written& written) {
  const verification::Chapter& chapter = written.chapter;
  std::size_t held = 0;
  for (const auto& check : chapter.checks) held += check.passed() ? 1 : 0;
  std::cout << chapter.name << ": " << held << " of " << chapter.checks.size() << " checks hold ("
            << io::rounded(written.seconds, 2) << " CPU s)\n";
  for (const auto& check : chapter.checks)
    if (!check.passed())
      std::cout << "  FAILS: " << check.what << " = " << io::rounded(check.value, 5) << ", not in ["
                << io::rounded(check.lower, 5) << ", " << io::rounded(check.upper, 5) << "]\n";
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
  app.add_option("--output", output, "Folder for the report and its files")->capture_default_str();
  return io::run_program(app, argc, argv, [&] {
    const auto chosen = chosen_studies(names);
    if (list) {
      for (const auto& study : chosen) std::cout << study.name << "\t" << study.question << '\n';
      return 0;
    }
    const io::ResultFolder folder(output);
    std::vector<verification::Written> chapters;
    {
      io::Progress progress;
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        verification::Context context{full, [&](double fraction) {
                                        progress.show(chosen[i].name,
                                                      (static_cast<double>(i) + fraction) /
                                                          static_cast<double>(chosen.size()));
                                      }};
        const solve::Stopwatch watch;
        verification::Written written{chosen[i].run(context), 0, folder.path() / chosen[i].name};
        written.seconds = watch.seconds();
        write_files(io::ResultFolder(written.folder), written.chapter);
        chapters.push_back(std::move(written));
      }
    }
    std::string command = "./run verify";
    for (const std::string& name : names) command += " " + name;
    if (full) command += " --full";
    folder.write("index.html", verification::html_report(chapters, command));

    bool passed = true;
    for (const auto& written : chapters) {
      print_chapter(written);
      passed = passed && written.chapter.passed();
    }
    if (!io::gnuplot_is_available()) std::cout << "Figures skipped: gnuplot is missing.\n";
    std::cout << "report: " << (folder.path() / "index.html").string() << '\n';
    return passed ? 0 : 1;
  });
}
