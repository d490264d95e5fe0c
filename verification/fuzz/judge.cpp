#include "verification/fuzz/judge.hpp"

#include <algorithm>
#include <regex>

#include "common/solve/end.hpp"
#include "common/solve/path.hpp"

namespace talus::fuzz {
namespace {

std::vector<std::string> names_of_ends() {
  std::vector<std::string> names;
  for (const solve::End end : solve::all_ends)
    if (!solve::is_success(end)) names.push_back(solve::name_of(end));
  for (int i = 0; !solve::name_of(static_cast<solve::PathEnd>(i)).empty(); ++i)
    names.push_back(solve::name_of(static_cast<solve::PathEnd>(i)));
  return names;
}

bool is_one_line(const std::string& text) {
  return std::ranges::count(text, '\n') == 1 && text.ends_with('\n') && text.size() > 20;
}

// Files that a message speaks of.
std::vector<std::string> files_named(const std::string& text) {
  static const std::regex name(R"((no )?[\w-]+\.(csv|json|svg|png|vtu|pvd|html)\b)");
  std::vector<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it)
    if (!(*it)[1].matched) names.push_back(it->str());  // "no path.png: gnuplot failed"
  return names;
}

void judge_names(Trial& trial, const std::string& text, const std::filesystem::path& results) {
  for (const std::string& name : files_named(text))
    trial.expect(std::filesystem::exists(results / name), "names " + name + ", which is not there");
}

}  // namespace

std::string beginning(const std::string& text) {
  std::string words = text.substr(0, 160);
  std::replace(words.begin(), words.end(), '\n', '|');
  return words;
}

std::string end_in(const std::string& text) {
  static const std::vector<std::string> names = names_of_ends();
  for (const std::string& name : names)
    if (text.find(name) != std::string::npos) return name;
  return {};
}

void judge_files(Trial& trial, const std::filesystem::path& results) {
  for (const std::string& file : torn_files(results)) trial.expect(false, "torn file: " + file);
  for (const std::string& file : files_left_behind(results))
    trial.expect(false, "file left behind: " + file);
}

void judge_refusal(Trial& trial, const Outcome& outcome) {
  trial.expect(outcome.code == 2, "exit code " + std::to_string(outcome.code) +
                                      " instead of 2: " + beginning(outcome.err));
  trial.expect(outcome.out.empty(), "refused with words on stdout: " + beginning(outcome.out));
  trial.expect(is_one_line(outcome.err), "refused without one line: " + beginning(outcome.err));
}

void judge_success(Trial& trial, const Outcome& outcome, const std::filesystem::path& results) {
  trial.expect(outcome.code == 0, "exit code " + std::to_string(outcome.code) +
                                      " instead of 0: " + beginning(outcome.err));
  trial.expect(outcome.err.empty(), "success with words on stderr: " + beginning(outcome.err));
  trial.expect(!has_no_number(outcome.out), "nan or inf on stdout: " + beginning(outcome.out));
  if (results.empty()) return;
  judge_names(trial, outcome.out, results);
  judge_files(trial, results);
  for (const std::string& none : numbers_that_are_none(results)) trial.expect(false, none);
  const nlohmann::json summary = json_in(results / "summary.json");
  if (!trial.expect(summary.is_object(), "success without summary.json")) return;
  const auto status = summary.value("status", "");
  trial.expect(status == "converged" || status == "at_round_off_floor",
               "success with status '" + status + "'");
}

void judge_failed_solve(Trial& trial, const Outcome& outcome,
                        const std::filesystem::path& results) {
  trial.expect(outcome.code == 1, "exit code " + std::to_string(outcome.code) +
                                      " instead of 1: " + beginning(outcome.err));
  const std::string end = end_in(outcome.err);
  trial.expect(!end.empty(), "exit code 1 without a named end: " + beginning(outcome.err));
  trial.expect(outcome.err.size() > end.size() + 30 && is_one_line(outcome.err),
               "exit code 1 without one line of advice: " + beginning(outcome.err));
  judge_names(trial, outcome.out + outcome.err, results);
  judge_files(trial, results);
  const nlohmann::json summary = json_in(results / "summary.json");
  if (!trial.expect(summary.is_object(), "exit code 1 without summary.json")) return;
  const auto status = summary.value("status", "");
  trial.expect(end.empty() || status == end,
               "status '" + status + "' in summary.json, '" + end + "' on stderr");
}

}  // namespace talus::fuzz
