// How strongly a mesh may be graded.
#pragma once

#include <string>

namespace talus::program {

/// Throws io::UserError, naming the option, if with this exponent (fem::graded_line) rounding takes
/// the width of the narrowest element.
void check_grading(const std::string& option, double exponent, int elements);

}  // namespace talus::program
