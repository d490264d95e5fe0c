// The front page of the report: what was run, whether it holds, and what it shows.
#pragma once

#include "verification/harness/html_report.hpp"

namespace talus::verification {

/// How the solves of all chapters end; no panels if none were counted.
io::Figure ends_figure(const std::vector<Written>& chapters);
/// The same in a sentence; empty of none.
std::string ends_sentence(const std::vector<Written>& chapters);

/// Verdict, a card for each question that the chapters answer, pictures of flows, and the studies.
/// `folder` holds the report.
std::string front_page(const std::vector<Written>& chapters, const std::string& command,
                       const std::filesystem::path& folder);

}  // namespace talus::verification
