// The angle of the heap at which a given flow rate runs down it.
#pragma once

#include <stdexcept>

#include "twod/section_nested.hpp"

namespace talus::twod {

/// No angle was found, and in one line why, and what to try.
struct FlowRateError : std::runtime_error {
  FlowRateError(solve::End how, const std::string& why) : std::runtime_error(why), end(how) {}
  solve::End end;  ///< no_steady_state: no angle carries as much
};

/// The angle at which Q* takes this value to a relative 1e-8, or as well as solves to the tolerance
/// of `options` tell, and the solution there. `space` is that of `mesh`. Q* grows with the angle,
/// from rest at arctan μs (a regularised law creeps below it) to what flows just below arctan μ2;
/// between, secants on log Q*, nearly linear in the angle, in a bracket that shrinks whenever they
/// do not gain. They set out from the angle and the slope found on a mesh four times as coarse.
/// Throws FlowRateError.
SectionSolution solve_for_flow_rate(double flow_rate, const Section& section,
                                    const SectionMesh& mesh, shear::CrossSection<2>& space,
                                    const shear::ShearOptions& options, Start start = Start::rest);

}  // namespace talus::twod
