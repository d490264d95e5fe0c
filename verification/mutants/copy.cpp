#include "verification/mutants/copy.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "common/io/checksum.hpp"
#include "common/io/result_folder.hpp"
#include "common/io/table.hpp"
#include "common/testing/temporary_folder.hpp"
#include "verification/harness/process.hpp"
#include "verification/harness/workers.hpp"
#include "verification/mutants/instrument.hpp"
#include "verification/mutants/verifier_run.hpp"

namespace talus::mutants {
namespace {

namespace fs = std::filesystem;
using testing::contents_of;

constexpr double hours = 3600;  // in seconds

void write_if_changed(const fs::path& file, const std::string& contents) {
  if (fs::exists(file) && contents_of(file) == contents) return;
  io::write_file("--copy", file, contents);
}

// Relative to the tree; no builds, no results.
std::vector<fs::path> sources(const fs::path& tree) {
  std::vector<fs::path> files;
  for (const char* file : {"CMakeLists.txt", "CMakePresets.json", "run", "test", "README.md"})
    if (fs::exists(tree / file)) files.emplace_back(file);
  for (const char* folder : {"common", "oned", "twod", "threed", "verification", "docs"})
    if (fs::is_directory(tree / folder))
      for (const auto& entry : fs::recursive_directory_iterator(tree / folder))
        if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), tree));
  std::ranges::sort(files);
  return files;
}

std::string first_error(const std::string& log) {
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
    if (line.find("error:") != std::string::npos || line.find("Error") != std::string::npos)
      return line;
  return log.substr(log.size() - std::min<std::size_t>(log.size(), 400));
}

void run_or_refuse(const fs::path& folder, const std::vector<std::string>& arguments) {
  const process::Outcome outcome =
      process::run({"/usr/bin/env", arguments, folder, {}, {}, false, 3 * hours, 12 * hours});
  if (!outcome.is_success())
    throw io::UserError("the copy of the mutants does not build: " +
                        first_error(outcome.out + outcome.err));
}

std::set<int> numbers_in(const fs::path& file) {
  std::ifstream in(file);
  std::set<int> numbers;
  for (int number; in >> number;) numbers.insert(number);
  return numbers;
}

// Whether it passes; what it then took and came by is kept for the next time with this code.
bool try_without_mutant(Verifier& verifier, const fs::path& folder, const std::string& code) {
  const fs::path reached = folder / verifier.name, known = folder / (verifier.name + ".seconds");
  std::ifstream in(known);
  std::string of_code;
  if (in >> of_code >> verifier.seconds && of_code == code) {
    verifier.reached = numbers_in(reached);
    return true;
  }
  fs::remove(reached);
  const Run run = run_verifier(verifier, {"TALUS_MUTANTS_REACHED=" + reached.string()}, hours);
  if (!run.outcome.is_success()) return false;
  verifier.seconds = run.seconds;
  verifier.reached = numbers_in(reached);
  io::write_file("--copy", known, code + " " + io::exact(run.seconds) + "\n");
  return true;
}

}  // namespace

void make_copy(const fs::path& tree, const fs::path& copy, const std::vector<Mutant>& mutants) {
  std::map<fs::path, std::vector<Numbered>> of_file;
  for (std::size_t i = 0; i < mutants.size(); ++i)
    of_file[mutants[i].file].push_back({static_cast<int>(i), &mutants[i]});
  const std::vector<fs::path> files = sources(tree);
  for (const auto& [file, here] : of_file)
    if (std::ranges::find(files, file) == files.end())
      throw io::UserError(here.front().mutant->name + ": there is no " + file.string());
  if (fs::exists(copy) && !fs::is_empty(copy) && !fs::exists(copy / choice_header_name))
    throw io::UserError("--copy: '" + copy.string() +
                        "' holds something else; a folder that is empty, or not there, is needed");
  write_if_changed(copy / choice_header_name, choice_header());
  for (const fs::path& file : files) {
    const std::string text = contents_of(tree / file);
    const auto here = of_file.find(file);
    write_if_changed(copy / file, here == of_file.end() ? text : instrumented(text, here->second));
    fs::permissions(copy / file, fs::status(tree / file).permissions());
  }
}

void build(const fs::path& copy) {
  // No warnings: a mutant may leave a variable unused.
  run_or_refuse(copy, {"cmake", "--preset", "release", "-DCMAKE_CXX_FLAGS=-w"});
  run_or_refuse(copy, {"cmake", "--build", "--preset", "release"});
}

std::vector<Verifier> verifiers(const fs::path& copy, int jobs) {
  const process::Outcome listed =
      process::run({"/usr/bin/env", {"ctest", "--show-only=json-v1"}, copy / "build/release"});
  std::vector<Verifier> all;
  const nlohmann::json listing = nlohmann::json::parse(listed.out);
  for (const nlohmann::json& test : listing.at("tests")) {
    Verifier verifier{test.at("name"), test.at("command"), copy / "build/release"};
    bool reads_sources = false;  // which are others in the copy
    for (const nlohmann::json& property : test.at("properties")) {
      const nlohmann::json& value = property.at("value");
      if (property.at("name") == "WORKING_DIRECTORY") verifier.folder = value.get<std::string>();
      if (property.at("name") == "LABELS")
        reads_sources = std::ranges::find(value, "reads-sources") != value.end();
    }
    if (!reads_sources) all.push_back(verifier);
  }
  fs::create_directories(copy / "reached");
  const std::string code = fingerprint(copy);
  std::vector<std::string> failures(all.size());
  const bool is_done = process::in_parallel(jobs, all.size(), [&](std::size_t i) {
    if (!try_without_mutant(all[i], copy / "reached", code)) failures[i] = all[i].name;
  });
  if (!is_done) throw std::runtime_error("interrupted; the same command goes on from here");
  for (const std::string& name : failures)
    if (!name.empty())
      throw io::UserError("without any mutant " + name + " fails in " + copy.string());
  std::erase_if(all, [](const Verifier& each) { return each.reached.empty(); });
  std::ranges::stable_sort(all, {}, &Verifier::seconds);
  return all;
}

std::string fingerprint(const fs::path& copy) {
  std::string all;
  for (const fs::path& file : sources(copy))
    all += file.string() + io::checksum(contents_of(copy / file));
  return io::checksum(all);
}

}  // namespace talus::mutants
