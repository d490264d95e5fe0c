// The fuzz: runs the programs as a student, a referee and a vandal would, and says what does not
// hold.
//
// Sample runs:
//   fuzz --seed 3
//   fuzz --kinds commands,checkpoints --count 500
//   fuzz --seed 3 --kinds commands --only 17
//   fuzz --full
#include <algorithm>
#include <iostream>

#include "common/io/options.hpp"
#include "verification/fuzz/campaign.hpp"

using namespace talus;

namespace {

std::vector<fuzz::Kind> chosen_kinds(const std::vector<std::string>& names) {
  std::vector<fuzz::Kind> chosen;
  std::string known;
  for (const fuzz::Kind& kind : fuzz::kinds()) {
    known += (known.empty() ? "" : ", ") + kind.name;
    if (names.empty() || std::ranges::find(names, kind.name) != names.end()) chosen.push_back(kind);
  }
  for (const std::string& name : names)
    if (std::ranges::find(chosen, name, &fuzz::Kind::name) == chosen.end())
      throw io::UserError("--kinds: '" + name + "' is none of: " + known);
  return chosen;
}

}  // namespace

int main(int argc, char** argv) {
  io::CommandLine line{
      "Fuzz of the programs: command lines, pairs of runs, kills, damaged checkpoints", "fuzz"};
  int seed = 1, count = 0, only = -1, jobs = 2;
  std::vector<std::string> names;
  std::string programs = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  fuzz::CampaignOptions options;
  io::add_integer(line, "--seed", seed, "All draws follow from it", 0, 2000000000);
  io::add_value(line, "--kinds", "NAME",
                "Kinds of trials, separated by commas (all if none is named)",
                [&](const std::string& list) { names = io::split(list, ','); })
      .takes(1, 100);
  io::add_flag(line, "--full", options.full, "Thousands of trials, some hours");
  io::add_integer(line, "--count", count, "Trials of each kind instead", 1, 1000000)
      .without_default();
  io::add_integer(line, "--only", only, "This trial of each kind alone", 0, 1000000)
      .without_default();
  io::add_integer(line, "--jobs", jobs, "Trials at a time", 1, 64);
  io::add_real(line, "--time-limit", options.time_limit,
               "After so many seconds a run is taken for hung", 1, 1e6);
  io::add_text(line, "--programs", programs, "Folder of the programs");
  return line.run(argc, argv, [&] {
    options.seed = static_cast<std::uint64_t>(seed);
    options.kinds = chosen_kinds(names);
    options.jobs = jobs;
    if (line.is_given("--count")) options.count = count;
    if (line.is_given("--only")) options.only = only;
    const fuzz::Findings findings = fuzz::campaign(options, programs, std::cout);
    io::print(std::cout, findings.table());
    std::cout << "seed " << seed << ": " << findings.faults.size() << " faults"
              << (findings.interrupted ? ", interrupted" : "") << '\n';
    return findings.faults.empty() && !findings.interrupted ? 0 : 1;
  });
}
