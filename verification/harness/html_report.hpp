// The report: one self-contained HTML page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// A chapter, or a part of one, as it is shown.
struct Written {
  std::string name, title, body;  ///< body: its text, tables and figures in HTML
  std::vector<Check> checks;
  double seconds = 0;  ///< of CPU time that it took

  std::size_t held() const;
  bool passed() const { return held() == checks.size(); }
  std::string failures() const;  ///< a line each
  /// A further part of the chapter, behind what there is.
  void append(const Written& part);
};

/// Every figure (SVG) and table of a chapter. A figure that gnuplot could not draw, in `folder`, is
/// reported as skipped.
Written write_chapter(const Chapter& chapter, const std::filesystem::path& folder);

/// Title, checks and body.
std::string html_of(const Written& chapter);

/// All chapters, the commands to regenerate them, and the machine. `command` is what was run.
std::string html_report(const std::vector<Written>& chapters, const std::string& command);

/// One page with a body in HTML, such as that of a chapter.
std::string html_page(const std::string& title, const std::string& command,
                      const std::string& body);

}  // namespace talus::verification
