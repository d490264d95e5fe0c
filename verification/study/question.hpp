// A study as a question: a scene and the words of its options, as on the command line, and the
// table that answers it.
#pragma once

#include "verification/study/case_table.hpp"

namespace talus::study {

/// The table of a question, without rows yet. Throws io::UserError for a scene, an option or a
/// result (error_RESULT is one too) that there is not.
Table asked(const std::string& scene, const std::vector<std::string>& words,
            const std::vector<std::string>& quantities = {});

/// Solves every possible combination, one at a time, and keeps no files.
void solve(Table& table);

}  // namespace talus::study
