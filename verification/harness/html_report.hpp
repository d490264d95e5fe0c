// The report: one self-contained HTML page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// A chapter as it is shown: its body in HTML, and its checks in lines of text.
struct Written {
  std::string name, title, html;
  std::size_t checks = 0, held = 0;
  std::string failures;  ///< a line each
  double seconds = 0;    ///< of CPU time that it took

  bool passed() const { return held == checks; }
};

/// Every figure (SVG), table and check of a chapter. A figure that gnuplot could not draw, in
/// `folder`, is reported as skipped.
Written write_chapter(const Chapter& chapter, const std::filesystem::path& folder);

/// All chapters, the commands to regenerate them, and the machine. `command` is what was run.
std::string html_report(const std::vector<Written>& chapters, const std::string& command);

/// One page with a body in HTML, such as that of a chapter.
std::string html_page(const std::string& title, const std::string& command,
                      const std::string& body);

}  // namespace talus::verification
