// The study of models that are poorer than their scene.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// The heap on a line against its cross-section, over the width of the channel.
void heap_on_a_line(Chapter& chapter, const Context& context);

}  // namespace talus::verification
