// Friction between the material and a rough wall that it may slip along.
//
// The dissipation of shear grows linearly, with slope μ2 p, so a layer of vanishing thickness at a
// no-slip wall carries any jump u of the velocity at the cost μ2 p|u|. The minimum of the energy
// may have such a jump: no slip is then attained by no velocity, and relaxed to the wall term ∫ μ2
// p|u|. It lets the material slip exactly where the wall stress reaches μ2 p.
#pragma once

#include "common/rheology/rheology.hpp"

namespace talus::shear {

/// The law of the slip u over the unit of length: D(u, p) = μ2 p u. Regularised like shear.
inline rheology::FrictionLaw wall_law(rheology::FrictionLaw law) {
  law.mu_s = law.mu_2();
  law.delta_mu = 0;
  return law;
}

/// The wall's own rheology. It slips by Coulomb's law, also where that inside has no yield stress.
inline rheology::Rheology wall_rheology(const rheology::Rheology& inside) {
  rheology::Rheology wall = inside;
  wall.law = wall_law(inside.law);
  if (!rheology::has_yield_stress(inside.regularisation))
    wall.regularisation = rheology::ChauchatMedale{};
  return wall;
}

}  // namespace talus::shear
