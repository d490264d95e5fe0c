// Runs the parts of studies, each in a process of its own.
#pragma once

#include "common/io/result_folder.hpp"
#include "verification/harness/html_report.hpp"

namespace talus::verification {

/// Told what runs and the fraction of all work that is done.
using Report = std::function<void(const std::string& running, double done)>;

struct RunOptions {
  bool full = false;
  int jobs = 2;                        ///< parts at a time
  std::vector<GivenCurve> given = {};  ///< to be drawn beside ours
};

/// As many parts at a time as the machine has cores, at most two: what a part solves by turns
/// lives in the cache.
int default_jobs();

/// A chapter for each study, the files of its parts in a folder each under `folder`. Parts that
/// measure time run alone, the others the longest first. Processes rather than threads: METIS draws
/// from one stream of random numbers, and results would depend on who runs beside whom. A part
/// that throws, crashes or is killed is a failed check that says so. None outlives this process.
/// Throws io::UserError if a folder cannot be written to.
std::vector<Written> run_studies(const std::vector<Study>& studies, const RunOptions& options,
                                 const io::ResultFolder& folder, const Report& report);

/// Wall minutes that `run_studies` takes, from the minutes the parts say.
double expected_minutes(const std::vector<Study>& studies, const RunOptions& options);

}  // namespace talus::verification
