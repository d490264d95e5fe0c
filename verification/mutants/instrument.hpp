// One copy of the code that holds every mutant, each to be chosen at run time.
#pragma once

#include "verification/mutants/catalogue.hpp"

namespace talus::mutants {

/// A mutant and the number that chooses it.
struct Numbered {
  int number;
  const Mutant* mutant;
};

/// The text of a file with its mutants in it. Throws io::UserError for a mutant whose lines do not
/// stand in the text (stale), stand there twice or overlap those of another.
std::string instrumented(const std::string& text, const std::vector<Numbered>& mutants);

/// The header that instrumented files include: TALUS_MUTANT, a number in the environment, chooses;
/// to the file that TALUS_MUTANTS_REACHED names, each process adds the numbers it comes by.
std::string choice_header();
inline constexpr const char* choice_header_name = "mutant_choice.hpp";

}  // namespace talus::mutants
