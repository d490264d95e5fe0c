// Mutants by rule: operators, signs, constants, indices, arguments in the wrong order, statements
// left out.
#pragma once

#include <cstdint>

#include "verification/mutants/catalogue.hpp"

namespace talus::mutants {

/// At most `count` mutants of `file` (a path within `tree`), drawn by `seed` from all that the
/// rules give, at most one a line. They may be equivalent to the code, or not compile: to be looked
/// at. Throws io::UserError if the file cannot be read.
std::vector<Mutant> proposals(const std::filesystem::path& tree, const std::filesystem::path& file,
                              int count, std::uint64_t seed);

/// As a catalogue holds them.
std::string catalogue_text(const std::vector<Mutant>& mutants);

}  // namespace talus::mutants
