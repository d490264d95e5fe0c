// The part of a chapter on disk: its figures, tables and checks, and what the report needs of it.
#pragma once

#include <optional>

#include "common/io/result_folder.hpp"
#include "verification/harness/html_report.hpp"

namespace talus::verification {

/// A part as it was read.
struct Record {
  Written written;
  bool is_full = false;
};

/// Removes what an older run left of a part, so that nothing of it is read as this run's.
void remove_chapter(const io::ResultFolder& folder);

/// Writes a part that took so many CPU seconds.
void write_chapter_files(const io::ResultFolder& folder, const Chapter& chapter, bool is_full,
                         double seconds);

/// Whether a part was begun there.
bool has_chapter(const std::filesystem::path& folder);
/// Nothing if it is not whole.
std::optional<Record> read_chapter(const std::filesystem::path& folder);
/// With all files beside it.
void copy_chapter(const std::filesystem::path& from, const io::ResultFolder& to);

/// What is left of a part that `did_not`, such as "did not end: killed": one check, and it fails.
Chapter chapter_of_failure(const Study& study, const Part& part, const std::string& did_not);

/// A chapter for each study, of what `written` returns for its parts.
std::vector<Written> chapters_of(const std::vector<Study>& studies,
                                 const std::function<Written(const Study&, const Part&)>& written);

}  // namespace talus::verification
