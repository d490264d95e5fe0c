// The parts of the stability study.
#pragma once

#include <vector>

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// 1e-2 ... 1e-12.
std::vector<double> swept_lambda_r();

/// How every solve ends over λr and the number of elements, for every regularisation and variant.
void add_maps(Chapter& chapter, const Context& context);
/// Loads swept through both limits of existence; certificates against exact limits.
void add_limits(Chapter& chapter, const Context& context);
/// Paths in λr of the flow around the cylinder past yield: meshes, pressures.
void add_cylinder_atlas(Chapter& chapter, const Context& context);
/// The same under plain and iterated penalties.
void add_cylinder_penalties(Chapter& chapter, const Context& context);

}  // namespace talus::verification
