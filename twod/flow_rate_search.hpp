// The angle of the heap at which a given flow rate runs down it.
#pragma once

#include "twod/section_nested.hpp"

namespace talus::twod {

/// The angle at which Q* takes this value to a relative 1e-8, and the solution there. `space` is
/// that of `mesh`. The search goes by secants on log Q*, nearly linear in the angle, from the angle
/// and the slope found on a mesh four times as coarse; on the coarsest by Brent's method (GSL).
/// Throws std::runtime_error naming the end if a solve on the way fails or the rate is out of
/// reach.
SectionSolution solve_for_flow_rate(double flow_rate, const Section& section,
                                    const SectionMesh& mesh, flow::CrossSection<2>& space,
                                    const flow::ShearOptions& options, Start start = Start::rest);

}  // namespace talus::twod
