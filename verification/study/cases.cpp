#include "verification/study/cases.hpp"

#include <chrono>
#include <csignal>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <thread>

#include "common/io/checksum.hpp"
#include "common/io/result_folder.hpp"
#include "common/io/shell.hpp"
#include "verification/harness/process.hpp"

namespace talus::study {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string contents_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream contents;
  contents << stream.rdbuf();
  return contents.str();
}

std::string line_of(const Program& program, const Options& options) {
  std::string line = "./run " + program.name();
  for (const std::string& word : words_of(options)) line += " " + io::shell_word(word);
  return line;
}

// Nothing if there is no whole record.
std::optional<json> read_record(const fs::path& file) {
  json record = json::parse(contents_of(file), nullptr, false);
  if (!record.is_object() || !record.contains("status") || !record.contains("results"))
    return std::nullopt;
  return record;
}

json failure(const std::string& line, const std::string& status) {
  return {{"command", line}, {"status", status}, {"results", json::object()}};
}

// Why a case left no record: how its process ended, or the end that it named, "chute: END: ...".
std::string status_of(const process::Outcome& outcome) {
  if (outcome.hung) return "time limit";
  if (outcome.signal != 0) return "killed by signal " + std::to_string(outcome.signal);
  const std::size_t from = outcome.err.find(": ");
  const std::size_t to = outcome.err.find(": ", from == std::string::npos ? from : from + 2);
  if (outcome.code == 1 && to != std::string::npos)
    return outcome.err.substr(from + 2, to - from - 2);
  return "no record";
}

struct Running {
  std::size_t number;
  std::unique_ptr<process::Process> run;
  std::chrono::steady_clock::time_point start;
};

}  // namespace

bool Row::is_success() const {
  return !record.at("results").empty();
}

double Row::number(const std::string& name) const {
  for (const json* part : {&record.at("results"), &record})
    if (part->contains(name) && part->at(name).is_number()) return part->at(name);
  return std::numeric_limits<double>::quiet_NaN();
}

std::string Row::option(const std::string& name) const {
  for (const auto& [each, value] : options)
    if (each == name) return value;
  return {};
}

std::string name_of(const Program& program, const Options& options) {
  static std::string build, built;
  if (built != program.path.string()) {
    built = program.path.string();
    build = io::checksum(contents_of(program.path));
  }
  return io::checksum(build + line_of(program, options));
}

std::vector<std::string> command_of(const Program& program, const Options& options,
                                    const fs::path& folder) {
  std::vector<std::string> words = words_of(options);
  words.insert(words.end(),
               {"--record", (folder / (name_of(program, options) + ".json")).string()});
  return words;
}

std::vector<Row> run_cases(const Program& program, const std::vector<Options>& cases,
                           const fs::path& folder, const RunOptions& options,
                           const std::function<void(const Row&, double done)>& report) {
  std::vector<Row> rows;
  std::vector<std::size_t> to_solve;
  std::size_t done = 0;
  const auto count = static_cast<double>(cases.size());
  for (const Options& each : cases) {
    const std::string file = name_of(program, each) + ".json";
    std::optional<json> record;
    if (options.merged.empty()) record = read_record(folder / file);
    for (const fs::path& other : options.merged)
      for (const fs::path& place : {other / file, other / "cases" / file})
        if (!record) record = read_record(place);
    if (record)
      ++done;
    else if (options.merged.empty())
      to_solve.push_back(rows.size());
    rows.push_back({each, record ? *record : failure(line_of(program, each), "no record")});
  }

  const auto end = [&](std::size_t number, const process::Outcome& outcome) {
    Row& row = rows[number];
    if (const auto record = read_record(folder / (name_of(program, row.options) + ".json")))
      row.record = *record;
    else
      row.record = failure(line_of(program, row.options), status_of(outcome));
    row.record["command"] = line_of(program, row.options);
    report(row, static_cast<double>(++done) / count);
  };
  std::vector<Running> running;
  const auto wait_for_one = [&] {
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(2)))
      for (auto each = running.begin(); each != running.end(); ++each) {
        const std::chrono::duration<double> age = std::chrono::steady_clock::now() - each->start;
        const bool is_over = each->run->ends_within(0);
        if (!is_over && age.count() < options.time_limit) continue;
        if (!is_over) each->run->send(SIGKILL, true);
        process::Outcome outcome = each->run->outcome();
        outcome.hung = outcome.hung || !is_over;
        end(each->number, outcome);
        running.erase(each);
        return;
      }
  };
  for (const std::size_t number : to_solve) {
    if (running.size() == static_cast<std::size_t>(options.jobs)) wait_for_one();
    process::Command command{program.path,
                             command_of(program, rows[number].options, fs::absolute(folder)),
                             fs::temp_directory_path()};
    command.time_limit = options.time_limit;
    running.push_back(
        {number, std::make_unique<process::Process>(command), std::chrono::steady_clock::now()});
  }
  while (!running.empty()) wait_for_one();
  return rows;
}

}  // namespace talus::study
