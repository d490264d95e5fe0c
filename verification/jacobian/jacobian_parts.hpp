// The Jacobian study, and its section about velocity-pressure flow.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Every tangent against its residual.
void jacobian_study(Chapter& chapter, const Context& context);

/// The tangent of every law at every state, and broken ones.
void check_mixed_tangents(Chapter& chapter);

}  // namespace talus::verification
