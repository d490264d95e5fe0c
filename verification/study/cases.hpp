// The cases of a study, each solved by its program in a process of its own, and their records.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verification/study/request.hpp"

namespace talus::study {

/// A case and what became of it.
struct Row {
  Options options;
  /// As scene::Case::complete makes it. Of a case that left none: status and command alone, the
  /// status being "killed by signal 9", "time limit", "no record", or the end its program named.
  nlohmann::json record;

  std::string status() const { return record.at("status"); }
  bool is_success() const;
  /// A result, or what stands beside the results (iterations, cpu_seconds, ...); NaN if there is
  /// none, and of every result of a case that did not succeed.
  double number(const std::string& name) const;
  /// The value of an option; empty if the case has none.
  std::string option(const std::string& name) const;
};

struct RunOptions {
  int jobs = 1;
  double time_limit = 3600;  ///< wall seconds of a case
  /// Folders with records made elsewhere: nothing is solved if there are any.
  std::vector<std::filesystem::path> merged = {};
};

/// The name of a case: a hash of its program, as it was built, and its options.
std::string name_of(const Program& program, const Options& options);
/// The line that solves a case and leaves its record in the folder.
std::vector<std::string> command_of(const Program& program, const Options& options,
                                    const std::filesystem::path& folder);

/// Solves what the folder `cases` has no record of, and returns all rows in the order of `cases`.
/// `report` hears of every case that ends.
std::vector<Row> run_cases(const Program& program, const std::vector<Options>& cases,
                           const std::filesystem::path& folder, const RunOptions& options,
                           const std::function<void(const Row&, double done)>& report);

}  // namespace talus::study
