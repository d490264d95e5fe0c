// Runs gnuplot as a process of its own, with a limit of time.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace talus::io {

/// Whether there is a gnuplot to run at all.
bool gnuplot_is_available();

/// Has gnuplot do what `script` says, in `folder`. Empty if it did; else why not, such as "gnuplot
/// is missing". After `limit` it is killed, with all it started. It never outlives this process.
std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script,
                        std::chrono::milliseconds limit);

}  // namespace talus::io
