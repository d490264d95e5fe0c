// The report of parts that were run elsewhere.
#pragma once

#include <map>

#include "verification/harness/chapter_file.hpp"

namespace talus::verification {

/// Where parts are, by name; all of full runs, or all of quick ones.
struct Found {
  std::map<std::string, std::filesystem::path> folders;
  bool is_full = false;
};

/// The parts of `studies` in folders that runs of `verify` wrote to, or in the folders within
/// those. Throws io::UserError for a folder that is none or holds no part, a part that is there
/// twice, and quick parts beside full ones.
Found find_parts(const std::vector<Study>& studies,
                 const std::vector<std::filesystem::path>& folders);

/// Chapters of these studies, the files of their parts copied into a folder each under `folder`. A
/// part that was not found, or that was killed or is torn, is a failed check.
std::vector<Written> merge_studies(const std::vector<Study>& studies, const Found& found,
                                   const io::ResultFolder& folder);

}  // namespace talus::verification
