// The choices of a tangent, named as for unidirectional flow, in velocity and pressure.
#pragma once

#include "common/mixed/mixed_flow.hpp"
#include "common/shear/shear_flow.hpp"

namespace talus::mixed {

/// From now on Newton takes steps with this tangent; a stress that is to be carried starts anew,
/// from that of the first step.
template <int Dim>
void set_tangent(MixedFlow<Dim>& flow, shear::TangentTerm term) {
  const double factor = term == shear::TangentTerm::frozen       ? 0
                        : term == shear::TangentTerm::wrong_sign ? -1
                                                                 : 1;
  flow.set_tangent_factors({.shear_rate = factor, .pressure = factor});
  if (term == shear::TangentTerm::primal_dual)
    flow.carry_stress();
  else
    flow.stop_carrying_stress();
}

}  // namespace talus::mixed
