// Runs gnuplot as a process of its own, with a limit of time.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace talus::io {

/// Whether there is a gnuplot to run at all.
bool gnuplot_is_available();

struct GnuplotRun {
  std::string failure;  ///< empty if it did what it was told; else why not: "gnuplot is missing"
  std::string output;   ///< what it wrote to its stdout: the picture, if no other output is set
};

/// Has gnuplot do what `script` says, in `folder`. After `limit` it is killed, with all it started.
/// It never outlives this process.
GnuplotRun run_gnuplot(const std::filesystem::path& folder, const std::string& script,
                       std::chrono::milliseconds limit);

}  // namespace talus::io
