// The files of a study: cases.csv, study.json, figures and a page to look at.
#pragma once

#include "common/io/result_folder.hpp"
#include "verification/study/kinds.hpp"

namespace talus::study {

/// Whatever a study can leave, for ResultFolder::remove_older.
std::vector<std::string> files();

/// Writes them; returns their names as a program says them. `command` is the line of the study.
std::string write_files(const io::ResultFolder& folder, const Kind& kind, const Table& table,
                        const Findings& findings, const std::string& command);

}  // namespace talus::study
