// The parts of the cylinder's study.
#pragma once

#include "verification/chapter.hpp"

namespace talus::verification {

/// Below yield: mesh, halves, penalty, outlet.
void cylinder_creep(Chapter& chapter, const Context& context);
/// Past yield: paths along the loading and in λr, folds, eq. (12) against the control law.
void cylinder_paths(Chapter& chapter, const Context& context);

}  // namespace talus::verification
