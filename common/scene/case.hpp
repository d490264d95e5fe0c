// A case is one solve and one command line. What every program of a scene can be asked because of
// that: to describe itself, to check its options, to solve several times, to leave a record.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/io/result_folder.hpp"
#include "common/scene/description.hpp"
#include "common/solve/stopwatch.hpp"

namespace talus::scene {

class Case {
 public:
  /// Adds --record, --reference, --repeat, --dry-run and --describe. Both must outlive the case.
  Case(io::CommandLine& line, const Description& description);
  Case(const Case&) = delete;
  Case& operator=(const Case&) = delete;

  /// io::run_program; with --describe the body is not run.
  int run_program(int argc, char** argv, const std::function<int()>& body);

  /// Whether only the options were to be checked. To be asked when they all have been.
  bool is_dry_run() const { return dry_run_; }

  /// Where the other files go: `output`, or nowhere if a record is all that was asked for. Removes
  /// an older record and reads the reference. Throws io::UserError.
  io::ResultFolder folder(const std::string& output);

  /// Solves --repeat times and returns the last solution; the shortest times count. For a record, a
  /// solve of a few ticks of the clock is repeated until they no longer matter; the mean counts.
  template <class Solve>
  auto timed(const Solve& solve) {
    constexpr double many_ticks = 0.02;  // in seconds
    std::optional<decltype(solve())> solution;
    const solve::Stopwatch all;
    int count = 0;
    do {
      const solve::Stopwatch watch;
      solution.emplace(solve());
      note(watch.seconds(), watch.elapsed());
    } while (++count < repeat_ || (!record_.empty() && all.elapsed() < many_ticks));
    if (count > repeat_) note(all.seconds() / count, all.elapsed() / count, true);
    return std::move(*solution);
  }

  /// Makes the record of a summary (scene, model, status, results): adds `case`, the hash of all
  /// that decides it; `command`, the line that leads to it; `options`; `errors` against the
  /// reference among the results; `units`; cpu_seconds, wall_seconds; peak_memory in MB. Throws
  /// std::logic_error for a result that the scene does not describe.
  void complete(nlohmann::json& summary) const;
  /// Writes it, as one line, if it was asked for.
  void write(const nlohmann::json& record) const;

 private:
  void note(double cpu_seconds, double wall_seconds, bool replaces = false);
  nlohmann::json options() const;
  std::string command() const;

  io::CommandLine& line_;
  const Description& description_;
  std::vector<std::string> words_;  // of the command line
  std::string record_, reference_;
  nlohmann::json reference_values_;
  int repeat_ = 1;
  bool dry_run_ = false, describe_ = false;
  double cpu_seconds_ = std::numeric_limits<double>::infinity();
  double wall_seconds_ = std::numeric_limits<double>::infinity();
};

}  // namespace talus::scene
