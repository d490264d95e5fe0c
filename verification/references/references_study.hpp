// The parts of the study of what others find.
#pragma once

#include "verification/harness/chapter.hpp"
#include "verification/references/references.hpp"

namespace talus::verification {

/// The results of each command against what is known of them, in a table and a figure of this name.
void check_known(Chapter& chapter, const std::string& name,
                 const std::vector<references::KnownCase>& cases, const Context& context);

/// On lines: the chute and the inclined plane.
void references_of_lines(Chapter& chapter, const Context& context);
/// The heap's cross-section and its surface.
void references_of_heap(Chapter& chapter, const Context& context);
/// The flow past the cylinder, below yield and above.
void references_of_cylinder(Chapter& chapter, const Context& context);

}  // namespace talus::verification
