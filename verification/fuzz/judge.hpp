// What every run owes, whatever it was given.
#pragma once

#include "verification/fuzz/folder.hpp"
#include "verification/fuzz/trial.hpp"

namespace talus::fuzz {

/// The name of an end (of a solve or of a path) in the text; empty if there is none.
std::string end_in(const std::string& text);

/// A refusal: exit code 2, nothing on stdout, one line on stderr.
void judge_refusal(Trial& trial, const Outcome& outcome);

/// A success: nothing on stderr, a status of success, whole files, numbers that are numbers. With
/// no folder: of a run that leaves no files.
void judge_success(Trial& trial, const Outcome& outcome, const std::filesystem::path& results);

/// A solve that did not succeed: its end by name and what to try, the same end in the summary.
void judge_failed_solve(Trial& trial, const Outcome& outcome, const std::filesystem::path& results);

/// No file torn or left behind.
void judge_files(Trial& trial, const std::filesystem::path& results);

/// First words of a text, on one line.
std::string beginning(const std::string& text);

}  // namespace talus::fuzz
