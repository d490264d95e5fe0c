// The study of the heap's cross-section.
#pragma once

#include "twod/section.hpp"
#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// Mesh error and λr error told apart, work over the angles.
void heap_study(Chapter& chapter, const Context& context);

/// Mesh error without λr: what no slip costs on uniform meshes, and two ways around it. What is
/// known is known of α = 0.42.
void heap_mesh_error(Chapter& chapter, const Context& context, const twod::Section& studied);

}  // namespace talus::verification
