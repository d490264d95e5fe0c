// Runs studies, each in a process of its own.
#pragma once

#include "common/io/result_folder.hpp"
#include "verification/harness/html_report.hpp"

namespace talus::verification {

/// Told what runs and the fraction of all work that is done.
using Report = std::function<void(const std::string& running, double done)>;

struct RunOptions {
  bool full = false;
  int jobs = 2;  ///< studies at a time
};

/// As many studies at a time as the machine has cores, at most two: what a study solves by turns
/// lives in the cache.
int default_jobs();

/// Chapters in the order of `studies`, their files in a folder each under `folder`. Those that
/// measure time run alone, the others the longest first. Processes rather than threads: METIS draws
/// from one stream of random numbers, and results would depend on who runs beside whom. A study
/// that throws, crashes or is killed becomes a chapter with a failed check that says so. None
/// outlives this process. Throws io::UserError if a folder cannot be written to.
std::vector<Written> run_studies(const std::vector<Study>& studies, const RunOptions& options,
                                 const io::ResultFolder& folder, const Report& report);

/// Wall minutes that `run_studies` takes, from the minutes the studies say.
double expected_minutes(const std::vector<Study>& studies, const RunOptions& options);

}  // namespace talus::verification
