// A chapter on disk: its figures, tables and checks, and what the report needs of it.
#pragma once

#include "common/io/result_folder.hpp"
#include "verification/harness/html_report.hpp"

namespace talus::verification {

/// Removes what an older run left of a chapter, so that nothing of it is read as this run's.
void remove_chapter(const io::ResultFolder& folder);

/// Writes a chapter that took so many CPU seconds.
void write_chapter_files(const io::ResultFolder& folder, const Chapter& chapter, double seconds);

/// Whether there is a whole one: it is written last.
bool has_chapter(const std::filesystem::path& folder);
/// Reads what the process of a study wrote.
Written read_chapter(const std::string& name, const std::filesystem::path& folder);

/// What is left of a study that did not end: one check, and it fails.
Chapter chapter_of_failure(const Study& study, const std::string& reason);

}  // namespace talus::verification
