// Mutants: how many one-line mistakes in the product code do the tests and studies notice?
//
// Sample runs (from the root of the source tree):
//   mutants --list
//   mutants --only law/ --output results/mutants
//   mutants --pursue both
//   mutants --propose common/rheology/friction_law.cpp --count 5 --seed 2
#include <iostream>
#include <regex>

#include "common/io/options.hpp"
#include "common/io/result_folder.hpp"
#include "common/io/shell.hpp"
#include "verification/harness/chapter_file.hpp"
#include "verification/mutants/propose.hpp"
#include "verification/mutants/verdicts.hpp"

using namespace talus;
using namespace talus::mutants;

namespace {

struct Options {
  std::string tree = ".", copy, catalogue, only, propose, pursue = "first";
  std::string output = "results/mutants";
  int jobs = 2, count = 10, seed = 1;
  double longest = 0;
  bool list = false;

  std::string command() const {
    return "./run mutants --pursue " + pursue +
           (only.empty() ? "" : " --only " + io::shell_word(only)) +
           (longest > 0 ? " --longest " + io::rounded(longest, 6) : "");
  }
};

Pursuit pursuit_of(const std::string& name) {
  return name == "first" ? Pursuit::first_kill : name == "both" ? Pursuit::both : Pursuit::all;
}

std::vector<std::size_t> chosen(const std::vector<Mutant>& mutants, const std::string& pattern) {
  std::vector<std::size_t> numbers;
  try {
    const std::regex expression(pattern);
    for (std::size_t i = 0; i < mutants.size(); ++i)
      if (std::regex_search(mutants[i].name, expression)) numbers.push_back(i);
  } catch (const std::regex_error&) {
    throw io::UserError("--only: '" + pattern + "' is no regular expression");
  }
  if (numbers.empty()) throw io::UserError("--only: '" + pattern + "' is in no mutant's name");
  return numbers;
}

// A page of its own, and the chapter that `verify --merge` puts into the full report.
void write_results(const io::ResultFolder& folder, const std::string& command,
                   const std::vector<Score>& all_scores, const io::Table& score,
                   const std::vector<Mutant>& mutants,
                   const std::vector<std::optional<Verdict>>& verdicts) {
  io::Table survivors = survivor_table(mutants, verdicts), each = mutant_table(mutants, verdicts);
  folder.write("mutants.csv", io::to_csv(each));
  survivors.title = "Survivors";
  each.title = "Every mutant";
  const verification::Study& study = verification::studies_elsewhere().front();
  verification::Chapter chapter{study.name, study.question, {}, {}};
  chapter.text("Mutants killed, by area; no share where some are still to be run. " + command);
  chapter.check(verification::Kind::control, "share of the mutants that is noticed",
                all_scores.back().share(), 0.95, 1);
  chapter.table(score);
  if (survivors.rows.empty())
    chapter.text("No survivors among those that were run.");
  else
    chapter.table(survivors);
  chapter.table(each);
  verification::write_chapter_files(io::ResultFolder(folder.path() / study.name), chapter, true, 0);
  verification::write_assets(folder);
  folder.write("index.html",
               verification::html_page(
                   "Mutants", command,
                   verification::html_of(verification::write_chapter(chapter, folder.path()))));
}

int run(const Options& options) {
  const std::filesystem::path tree = std::filesystem::absolute(options.tree).lexically_normal();
  if (!options.propose.empty()) {
    std::cout << catalogue_text(
        proposals(tree, options.propose, options.count, static_cast<std::uint64_t>(options.seed)));
    return 0;
  }
  const std::filesystem::path catalogue = options.catalogue.empty()
                                              ? tree / "verification/mutants/catalogue"
                                              : std::filesystem::path(options.catalogue);
  const std::vector<Mutant> mutants = read_catalogue(catalogue);
  const std::vector<std::size_t> numbers = chosen(mutants, options.only);
  if (options.list) {
    for (const std::size_t i : numbers)
      std::cout << mutants[i].name << ": " << mutants[i].what << " (" << mutants[i].file.string()
                << ")\n";
    return 0;
  }
  const Campaign campaign{
      options.copy.empty() ? std::filesystem::temp_directory_path() / "talus-mutants"
                           : std::filesystem::absolute(options.copy),
      std::filesystem::path(options.output) / "verdicts.csv", pursuit_of(options.pursue),
      options.longest > 0 ? options.longest : std::numeric_limits<double>::infinity(),
      options.jobs};
  make_copy(tree, campaign.copy, mutants);
  const io::ResultFolder folder(options.output);
  std::cout << "Building " << mutants.size() << " mutants in " << campaign.copy.string() << " ..."
            << std::endl;
  build(campaign.copy);
  std::cout << "Running every test without a mutant ..." << std::endl;
  const std::vector<Verifier> all = verifiers(campaign.copy, options.jobs);
  const auto verdicts = pursue(campaign, mutants, numbers, all, [](const Verdict& verdict) {
    std::cout << verdict.name << ' '
              << (verdict.is_killed() ? "killed by " + verdict.killers.front() : "SURVIVES")
              << std::endl;
  });
  const std::vector<Score> all_scores = scores(mutants, numbers, verdicts);
  const io::Table score = score_table(all_scores, campaign.pursuit);
  write_results(folder, options.command(), all_scores, score, mutants, verdicts);
  io::print(std::cout, score);
  std::cout << "Open " << options.output << "/index.html\n";
  return all_scores.back().not_run == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{"Mutants: how many one-line mistakes in the product code are noticed?",
                       "mutants"};
  Options options;
  io::add_flag(line, "--list", options.list, "Only print the mutants");
  io::add_text(line, "--only", options.only, "Mutants whose names match this expression")
      .without_default();
  io::add_choice(line, "--pursue", options.pursue,
                 "Until the first test fails; until a study and a test of another kind do; by all",
                 {"first", "both", "all"});
  io::add_text(line, "--propose", options.propose,
               "Only print mutants of this file that are made by rule, for the catalogue")
      .without_default();
  io::add_integer(line, "--count", options.count, "With --propose: at most so many", 1, 10000);
  io::add_integer(line, "--seed", options.seed, "With --propose: all draws follow from it", 0,
                  2000000000);
  io::add_real(line, "--longest", options.longest,
               "Only tests that take no more seconds: more mutants survive, in less time", 0.1, 1e6)
      .without_default();
  io::add_integer(line, "--jobs", options.jobs, "Mutants at a time", 1, 64);
  io::add_text(line, "--tree", options.tree, "Root of the source tree");
  io::add_text(line, "--copy", options.copy, "Folder of the copy, outside of the tree")
      .by_default("talus-mutants among the temporary folders");
  io::add_text(line, "--catalogue", options.catalogue, "Folder of the mutants")
      .by_default("verification/mutants/catalogue");
  io::add_text(line, "--output", options.output, "Folder of the results");
  return line.run(argc, argv, [&] { return run(options); });
}
