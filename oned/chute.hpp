// The vertical chute between rough walls, section 3.1 and appendix A of the paper.
//
// Half the section, y in [0, b/2]: plane of symmetry at y = 0, no slip at y = b/2. Pressure is
// constant, the weight drives the flow, and the stress is y: a plug up to y0 = μs p, shear beyond.
#pragma once

#include "oned/shear_scene.hpp"

namespace talus::oned {

struct Chute {
  double pressure = 28;  ///< p
  double width = 28;     ///< b
  rheology::FrictionLaw law = {};
  rheology::Regularisation regularisation = rheology::ChauchatMedale{};  ///< whose limit is exact
};

/// The scene with its exact solution: with the limiting law's I(μ), shear rate I(y/p) sqrt(φp)/d*
/// and its integral, which for eq. (4) is eq. (17). Rest where b/2 <= μs p if the law has a yield
/// stress, no steady flow where b/2 >= μ2 p.
ShearScene scene_of(const Chute& chute);

}  // namespace talus::oned
