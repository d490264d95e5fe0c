#include "common/scene/case.hpp"

#include <algorithm>
#include <charconv>
#include <iostream>
#include <set>

#include "common/io/checksum.hpp"
#include "common/io/options.hpp"
#include "common/io/shell.hpp"
#include "common/io/table.hpp"
#include "common/program/summary.hpp"
#include "common/scene/reference.hpp"

namespace talus::scene {
namespace {

using nlohmann::json;

// Options that say what is done with a solution, or how often and by how many it is sought.
const std::set<std::string> decide_nothing = {
    "record", "reference", "repeat", "dry-run", "describe", "output", "plot", "resume", "threads"};

// One text for all ways to write a number: 1e-4 is 0.0001.
std::string canonical(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? io::exact(value) : text;
}

}  // namespace

Case::Case(io::CommandLine& line, const Description& description)
    : line_(line), description_(description) {
  io::add_text(line, "--record", record_,
               "Write the case to this file, as one line of JSON, and nothing else unless --output "
               "or --plot is given");
  io::add_text(line, "--reference", reference_,
               "Measure against another case: its record or summary.json, or NAME=VALUE,...");
  io::add_integer(line, "--repeat", repeat_, "Solve so often; the shortest time counts", 1, 1000);
  io::add_flag(line, "--dry-run", dry_run_, "Only check the options");
  io::add_flag(line, "--describe", describe_,
               "Only print the scene's options and quantities, as JSON");
}

int Case::run_program(int argc, char** argv, const std::function<int()>& body) {
  words_.assign(argv + std::min(argc, 1), argv + argc);
  return line_.run(argc, argv, [&] {
    io::refuse_unused(line_, {{{"--record", "--reference", "--repeat"},
                               !line_.is_given("--check-jacobian"),
                               "--check-jacobian"}});
    if (!describe_) return body();
    std::cout << as_json(description_, line_).dump(2) << '\n';
    return 0;
  });
}

io::ResultFolder Case::folder(const std::string& output) {
  if (!reference_.empty()) reference_values_ = reference_values(reference_);
  if (!record_.empty()) {  // told before anything is solved
    io::write_file("--record", record_, "");
    io::remove_file("--record", record_);
  }
  const bool wants_more = line_.is_given("--output") || line_.is_given("--plot");
  return record_.empty() || wants_more ? io::ResultFolder(output) : io::ResultFolder();
}

void Case::note(double cpu_seconds, double wall_seconds, bool replaces) {
  cpu_seconds_ = replaces ? cpu_seconds : std::min(cpu_seconds_, cpu_seconds);
  wall_seconds_ = replaces ? wall_seconds : std::min(wall_seconds_, wall_seconds);
}

json Case::options() const {
  json all;
  for (const io::GivenOption& option : line_.options()) {
    const std::string name = option.name.substr(2);
    if (decide_nothing.contains(name)) continue;
    all[name] = option.is_flag ? (option.value ? "yes" : "no")
                               : canonical(option.value.value_or(option.standard));
  }
  return all;
}

std::string Case::command() const {
  std::string line = "./run " + description_.name;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    const bool is_file = words_[i] == "--record" || words_[i] == "--output";
    if (is_file || words_[i].rfind("--record=", 0) == 0 || words_[i].rfind("--output=", 0) == 0)
      i += is_file ? 1 : 0;
    else
      line += " " + io::shell_word(words_[i]);
  }
  return line;
}

void Case::complete(json& summary) const {
  json& results = summary["results"];
  description_.check(results);
  json units = json::object();
  for (const auto& [name, _] : results.items()) units[name] = description_.find(name)->unit;
  if (!reference_values_.is_null() && !results.empty()) {
    const json errors = errors_against(reference_values_, results);
    for (const auto& [name, value] : errors.items()) {
      results[name] = value;
      units[name] = "1";
    }
  }
  const json decided_by = {{"scene", description_.name}, {"options", options()}};
  summary["case"] = io::checksum(decided_by.dump());
  summary["command"] = command();
  summary["options"] = decided_by["options"];
  summary["units"] = units;
  if (cpu_seconds_ < std::numeric_limits<double>::infinity()) {
    summary["cpu_seconds"] = cpu_seconds_;
    summary["wall_seconds"] = wall_seconds_;
  }
  summary["peak_memory"] = program::peak_memory();
}

void Case::write(const json& record) const {
  if (!record_.empty()) io::write_file("--record", record_, record.dump() + "\n");
}

}  // namespace talus::scene
