// The study of the heap's cross-section.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Mesh error and λr error told apart, work over the angles, the paper's flow rates.
void heap_study(Chapter& chapter, const Context& context);

}  // namespace talus::verification
