// The study of the split-bottom cell.
#pragma once

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Where the zone is and what it takes, against the curve of least resistance; the jump from the
/// open zone to the dome; what finite rates do.
void zone_study(Chapter& chapter, const Context& context);

}  // namespace talus::verification
