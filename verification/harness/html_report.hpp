// The report: a front page, a page for each study, and their style and script; a folder that opens
// without a net.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/io/result_folder.hpp"
#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// A headline as it is shown: its pictures in HTML.
struct WrittenHeadline {
  Question question;
  std::string pictures, sentence;
};

/// What a part of a study took.
struct Cost {
  std::string name;    ///< STUDY/PART, as `verify` calls it; empty for chapters of other programs
  double seconds = 0;  ///< of CPU time
};

/// A chapter, or a part of one, as it is shown.
struct Written {
  std::string name, title, body;  ///< body: its text, tables and figures in HTML
  std::vector<Check> checks;
  std::vector<std::string> answers = {};
  std::vector<WrittenHeadline> headlines = {};
  std::vector<Ends> ends = {};
  std::vector<Cost> costs = {};

  std::size_t held() const;
  bool passed() const { return held() == checks.size(); }
  double seconds() const;
  std::string command() const;   ///< that runs it again
  std::string failures() const;  ///< a line each
  /// A further part of the chapter, behind what there is.
  void append(const Written& part);
};

/// Every figure and table of a chapter. A figure that gnuplot could not draw, in `folder`, is
/// reported as skipped.
Written write_chapter(const Chapter& chapter, const std::filesystem::path& folder);

/// Question, answer, figures and tables, checks, how to run it again and what it took.
std::string html_of(const Written& chapter);

/// One page with a body in HTML, such as that of a chapter. `home` is the page it goes back to, if
/// there is one.
std::string html_page(const std::string& title, const std::string& command, const std::string& body,
                      const std::string& home = "");

/// Processor, threads, compiler and date.
std::string machine();

/// The style and the script of all pages.
std::vector<std::string> names_of_assets();
void write_assets(const io::ResultFolder& folder);

/// Front page and a page STUDY.html for each chapter. `command` is what was run.
void write_report(const io::ResultFolder& folder, const std::vector<Written>& chapters,
                  const std::string& command);

/// What write_report can leave of these studies, for ResultFolder::remove_older.
std::vector<std::string> report_files(const std::vector<Study>& studies);

}  // namespace talus::verification
