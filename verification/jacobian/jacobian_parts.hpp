// The part of the Jacobian study that is about velocity-pressure flow.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// The tangent of every law at every state, and broken ones.
void check_mixed_tangents(Chapter& chapter);

}  // namespace talus::verification
