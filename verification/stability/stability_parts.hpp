// The parts of the stability study.
#pragma once

#include <vector>

#include "verification/harness/chapter.hpp"

namespace talus::verification {

/// 1e-2 ... 1e-12.
std::vector<double> swept_lambda_r();

/// How every solve ends over λr and the number of elements, for every regularisation and variant.
void maps(Chapter& chapter, const Context& context);
/// Factorisations of the interior point from rest on every family of meshes.
void interior_point_counts(Chapter& chapter, const Context& context);
/// Loads swept through both limits of existence; certificates against exact limits.
void limits(Chapter& chapter, const Context& context);
/// Final residual of plain double precision against the computed floor.
void round_off_floor(Chapter& chapter, const Context& context);
/// Paths in λr of the flow around the cylinder past yield: meshes, pressures.
void cylinder_atlas(Chapter& chapter, const Context& context);
/// The same under plain and iterated penalties.
void cylinder_penalties(Chapter& chapter, const Context& context);

}  // namespace talus::verification
