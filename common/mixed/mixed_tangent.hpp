// The choices of a tangent, named as for unidirectional flow, in velocity and pressure.
#pragma once

#include "common/mixed/mixed_flow.hpp"
#include "common/shear/shear_flow.hpp"

namespace talus::mixed {

/// What becomes of the derivatives of the viscosity: as they are, dropped, or of the wrong sign.
inline TangentFactors tangent_factors(shear::TangentTerm term) {
  const double factor = term == shear::TangentTerm::frozen       ? 0
                        : term == shear::TangentTerm::wrong_sign ? -1
                                                                 : 1;
  return {.shear_rate = factor, .pressure = factor};
}

/// From now on Newton takes steps with this tangent.
template <int Dim>
void set_tangent(MixedFlow<Dim>& flow, shear::TangentTerm term) {
  flow.set_tangent_factors(tangent_factors(term));
  flow.set_primal_dual(term == shear::TangentTerm::primal_dual);
}

}  // namespace talus::mixed
