// Flow down a rough inclined plane: Bagnold's profile, section 3.2 and appendix B of the paper.
//
// z in [0, H]: no slip at z = 0, free surface at z = H; p = (H - z) cos α, stress (H - z) sin α, so
// that μ(I) = tan α everywhere. The velocity has a singular second derivative at the free surface.
#pragma once

#include "oned/shear_scene.hpp"

namespace talus::oned {

struct Bagnold {
  double angle = 0.406;  ///< α, radians
  double height = 14;    ///< H
  rheology::FrictionLaw law = {};
  rheology::Regularisation regularisation = rheology::ChauchatMedale{};  ///< whose limit is exact
};

/// The scene with its exact solution, eq. (18) with I(tan α) of the limiting law, eq. (19) for
/// eq. (4). Rest where tan α <= μs if the law has a yield stress, no steady flow where tan α >= μ2.
ShearScene scene_of(const Bagnold& bagnold);

}  // namespace talus::oned
