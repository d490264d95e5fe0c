// Runs studies, each in a process of its own.
#pragma once

#include "common/io/result_folder.hpp"
#include "verification/html_report.hpp"

namespace talus::verification {

/// Told what runs and the fraction of all work that is done.
using Report = std::function<void(const std::string& running, double done)>;

/// Chapters in the order of `studies`, their files in a folder each under `folder`. As many run at
/// a time as the machine has cores, at most two; one that measures time runs alone. Processes
/// rather than threads: METIS draws from one stream of random numbers, and results would depend on
/// who runs beside whom. If one ends without a chapter the others are stopped: throws
/// io::UserError if it could not write, else std::runtime_error.
std::vector<Written> run_studies(const std::vector<Study>& studies, bool full,
                                 const io::ResultFolder& folder, const Report& report);

}  // namespace talus::verification
