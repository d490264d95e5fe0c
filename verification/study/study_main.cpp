// A study of one's own: the combinations of any options of a scene, solved, charted and judged.
//
// Sample runs (the test suite runs them):
//   study converge bagnold --elements 5:80:x2 --grading 1,2 --lambda-r 1e-8
//   study cost heap --elements 4x6,8x12,16x24 --method newton,interior-point
//   study stability chute --elements 5:20:x2 --lambda-r 1e-2:1e-8:/100 --tangent full,frozen
//   study sweep heap --angle 0.37:0.5:4 --elements 7x10 --quantity flow_rate,depth_yield
#include <iostream>

#include "common/io/options.hpp"
#include "common/io/progress.hpp"
#include "common/io/shell.hpp"
#include "verification/harness/runner.hpp"
#include "verification/study/page.hpp"
#include "verification/study/question.hpp"

using namespace talus;

namespace {

struct Asked {
  std::string kind, scene, output, quantity, merge;
  std::vector<std::string> scene_words;
  study::RunOptions run{.jobs = 0};
  bool list = false;
};

void print_cases(const study::Program& program, const std::vector<study::Options>& cases,
                 const std::filesystem::path& folder) {
  for (const auto& each : cases) {
    std::cout << program.path.string();
    for (const std::string& word : study::command_of(program, each, folder))
      std::cout << ' ' << io::shell_word(word);
    std::cout << '\n';
  }
}

// Sorts the words of the command line: those of the study itself are returned, kind and scene
// first; the options of the scene and their values are left in `others`.
std::vector<std::string> own_words(const io::CommandLine& line, int argc, char** argv,
                                   std::vector<std::string>& others) {
  const std::vector<std::string> words(argv, argv + argc);
  std::vector<std::string> own{words[0]}, names;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const bool is_option = words[i].rfind("-", 0) == 0;
    const std::size_t equals = words[i].find('=');
    const std::optional<int> ours =
        is_option ? line.most_values(words[i].substr(0, equals)) : std::nullopt;
    if (ours) {
      own.push_back(words[i]);
      const int most = equals == std::string::npos ? *ours : 0;
      for (int taken = 0; taken < most && i + 1 < words.size(); ++taken) {
        if (taken > 0 && words[i + 1].rfind("-", 0) == 0) break;
        own.push_back(words[++i]);
      }
    } else if (!is_option && names.size() < 2 && others.empty()) {
      names.push_back(words[i]);
    } else {
      others.push_back(words[i]);
    }
  }
  own.insert(own.begin() + 1, names.begin(), names.end());  // behind --merge they would be folders
  return own;
}

std::string line_of(int argc, char** argv) {
  std::string line = "./run study";
  for (int i = 1; i < argc; ++i) line += " " + io::shell_word(argv[i]);
  return line;
}

int run(Asked& asked, const std::string& command) {
  // 1. What is asked, and whether every case of it is possible.
  const study::Kind& kind = study::kind_named(asked.kind);
  study::Table table = study::asked(
      asked.scene, asked.scene_words,
      asked.quantity.empty() ? std::vector<std::string>{} : io::split(asked.quantity, ','));
  kind.admit(table);
  const auto cases = study::possible(table.program, study::combinations(table.varied));
  if (asked.output.empty()) asked.output = "results/study/" + kind.name + "-" + asked.scene;
  if (!asked.merge.empty())
    for (const std::string& each : io::split(asked.merge, ',')) {
      if (!std::filesystem::is_directory(each))
        throw io::UserError("--merge: '" + each + "' is no folder");
      asked.run.merged.emplace_back(each);
    }
  const std::filesystem::path records = std::filesystem::path(asked.output) / "cases";
  if (asked.list) {
    print_cases(table.program, cases, records);
    return 0;
  }

  // 2. The cases, each a process; what is known is not solved again.
  if (asked.run.jobs == 0) asked.run.jobs = kind.measures_time ? 1 : verification::default_jobs();
  const io::ResultFolder folder(asked.output);
  folder.remove_older(study::files());
  {
    io::Progress progress;
    table.rows = study::run_cases(
        table.program, cases, records, asked.run,
        [&](const study::Row& row, double done) { progress.show(row.status(), done); });
  }

  // 3. What they show.
  const study::Findings findings = kind.find(table);
  for (const auto& block : findings.chapter.blocks)
    if (const auto* text = std::get_if<std::string>(&block))
      std::cout << *text << '\n';
    else if (const auto* shown = std::get_if<io::Table>(&block))
      io::print(std::cout, *shown);
  std::cout << study::count_of_ends(study::all_rows(table)) << '\n';
  const std::string written = study::write_files(folder, kind, table, findings, command);
  std::cout << "results in " << folder.path().string() << ":" << written << '\n';

  // 4. A case that left no record is a failure of the study; one that did not arrive is not.
  int lost = 0;
  for (const study::Row& row : table.rows)
    if (!row.record.contains("case")) {
      if (lost++ == 0) std::cerr << "study: " << row.status() << ": " << row.record.at("command");
    }
  if (lost > 0) std::cerr << (lost > 1 ? ", and others" : "") << '\n';
  return lost > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{
      "Solves the combinations of any options of a scene, and shows what they tell", "study"};
  Asked asked;
  io::add_text(line, "KIND", asked.kind, "Kind of study: converge, cost, stability, sweep, ladder")
      .is_required();
  io::add_text(line, "SCENE", asked.scene,
               "Scene, followed by any of its options; a value may be a list (5,10,20) or a "
               "range: A:B:N (N values), A:B:+d (steps), A:B:x2, A:B:/10 (factors)")
      .is_required();
  io::add_text(line, "--quantity", asked.quantity,
               "Results or errors to show, joined by commas; default: the scene's own");
  io::add_integer(line, "--jobs", asked.run.jobs,
                  "Cases at a time; default: one if times are measured, else two", 1, 1024)
      .without_default();
  io::add_real(line, "--time-limit", asked.run.time_limit, "Seconds that a case may take", 1, 1e6);
  io::add_flag(line, "--list", asked.list, "Only list the command lines of the cases");
  io::add_text(line, "--merge", asked.merge, "Solve nothing; take the records from these folders")
      .takes(1, 1000);
  io::add_text(line, "--output", asked.output, "Folder; default results/study/KIND-SCENE");
  std::vector<std::string> own = own_words(line, argc, argv, asked.scene_words);
  std::vector<char*> pointers;
  for (std::string& word : own) pointers.push_back(word.data());
  const std::string command = line_of(argc, argv);
  return line.run(static_cast<int>(pointers.size()), pointers.data(),
                  [&] { return run(asked, command); });
}
