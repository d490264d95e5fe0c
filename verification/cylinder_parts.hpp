// The parts of the cylinder's study.
#pragma once

#include "verification/chapter.hpp"

namespace talus::verification {

/// Below yield: mesh, halves, outlet.
void cylinder_creep(Chapter& chapter, const Context& context);
/// Past yield: paths along the loading, folds, eq. (12) against the control law, what ends a sweep.
void cylinder_paths(Chapter& chapter, const Context& context);

}  // namespace talus::verification
