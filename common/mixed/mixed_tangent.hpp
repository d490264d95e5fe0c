// The choices of a tangent, named as for unidirectional flow, in velocity and pressure.
#pragma once

#include "common/mixed/mixed_flow.hpp"
#include "common/shear/shear_flow.hpp"

namespace talus::mixed {

/// From now on Newton takes steps with this tangent.
template <int Dim>
void set_tangent(MixedFlow<Dim>& flow, shear::TangentTerm term) {
  const double factor = term == shear::TangentTerm::frozen       ? 0
                        : term == shear::TangentTerm::wrong_sign ? -1
                                                                 : 1;
  flow.set_tangent_factors({.shear_rate = factor, .pressure = factor});
  flow.set_primal_dual(term == shear::TangentTerm::primal_dual);
}

}  // namespace talus::mixed
