// A program run from outside: what it is given, and all that can be seen of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace talus::process {

struct Command {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::filesystem::path folder;          ///< to run in
  std::optional<std::string> path = {};  ///< another PATH
  std::optional<std::uint64_t> file_size =
      {};                                ///< in bytes: files do not grow beyond, as on a full disk
  bool stdout_is_full = false;           ///< stdout is /dev/full
  double time_limit = 400;               ///< in seconds: then it is taken for hung
  std::optional<double> cpu_limit = {};  ///< the same of CPU time
};

/// As it can be pasted into a shell, run in an empty folder.
std::string shell_line(const Command& command);

struct Outcome {
  int code = -1;      ///< exit code, -1 if it was ended by a signal
  int signal = 0;     ///< that ended it
  bool hung = false;  ///< ended by us, after the time limit
  std::string out, err;

  bool is_success() const { return code == 0; }
};

/// Runs from construction, in a process group of its own; what is left of the group is killed at
/// the end of the scope.
class Process {
 public:
  explicit Process(const Command& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits for its end, at most so many seconds; whether it has ended.
  bool ends_within(double seconds);
  /// To the program alone, or to all of its group, as a terminal does.
  void send(int signal, bool to_group);
  /// Waits for its end; kills it at the time limit.
  Outcome outcome();
  /// Whether its children have all ended, a fortieth of the time limit after it at the latest.
  bool leaves_nothing_running() const;

 private:
  void read_output();

  double time_limit_;
  pid_t id_ = -1;
  int output_[2] = {-1, -1};  // read ends: stdout, stderr
  bool ended_ = false;
  int status_ = 0;
  Outcome outcome_;
};

Outcome run(const Command& command);

}  // namespace talus::process
