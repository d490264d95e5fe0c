// One trial: an empty folder, draws of its own, and what it finds.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/io/shell.hpp"
#include "verification/fuzz/line.hpp"
#include "verification/harness/process.hpp"

namespace talus::fuzz {

using io::shell_word;
using process::Command;
using process::Outcome;
using process::Process;

/// All that trials share: the programs and, by program, results of an earlier run.
class Programs {
 public:
  /// Those in the folder; throws std::runtime_error if one is missing.
  Programs(const std::filesystem::path& folder, const std::filesystem::path& scratch,
           double time_limit);

  const Program& named(const std::string& name) const;
  /// A run with figures, and the folder of its results: what a trial may find in its own.
  Command earlier_run(const std::string& name) const;
  std::filesystem::path earlier_results(const std::string& name) const;

  const double time_limit;  ///< of each run, in seconds

 private:
  std::vector<Program> programs_;
  std::filesystem::path scratch_;
  mutable std::mutex mutex_;
};

class Trial {
 public:
  Trial(const Programs& shared, Random draws, std::filesystem::path scratch);

  const Programs& programs;
  Random random;
  const std::filesystem::path folder;  ///< empty at first, with a folder `results` at most

  Command command(const std::string& program, std::vector<std::string> arguments,
                  const std::string& subfolder = "") const;
  /// Runs to its end; whatever the program is given, it may not crash or hang.
  Outcome run(const Command& command);
  /// Copies those of an earlier run, an hour old, to the folder.
  void place_earlier_results(const std::string& program, const std::filesystem::path& results);
  /// For what is started otherwise: how it is repeated by hand.
  void note(const std::string& shell_line);
  void look_at(const Outcome& outcome);  ///< no crash, no hang

  /// Notes a fault unless `holds`; returns it.
  bool expect(bool holds, const std::string& fault);
  /// What came of it, for the table of counts.
  void ended(const std::string& outcome) { outcome_ = outcome; }

  const std::string& outcome() const { return outcome_; }
  const std::vector<std::string>& faults() const { return faults_; }
  std::string script() const;

 private:
  std::string outcome_ = "done", script_;
  std::vector<std::string> faults_;
};

}  // namespace talus::fuzz
