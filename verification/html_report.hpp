// The report: one self-contained HTML page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/chapter.hpp"

namespace talus::verification {

/// A chapter with how long it took and where its files are.
struct Written {
  Chapter chapter;
  double seconds = 0;
  std::filesystem::path folder;
};

/// Every figure (SVG), table and check, the commands to regenerate them, and the machine.
/// `command` is what was run. A figure that gnuplot could not draw is reported as skipped.
std::string html_report(const std::vector<Written>& chapters, const std::string& command);

}  // namespace talus::verification
