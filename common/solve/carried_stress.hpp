// The state of the primal-dual form: velocities (and pressures) with a stress beside them.
#pragma once

#include <utility>

#include "common/solve/compensated_vector.hpp"

namespace talus::solve {

/// Newton on τ/η(|γ|) = γ for the velocity and a stress τ together, instead of on τ = η(|γ|) γ
/// (Chan, Golub & Mulet 1999). The first is nearly linear in γ where the second saturates. A
/// direction holds the τ that the linearised problem predicts after a whole step, in equilibrium
/// with the load: whatever part of the step is taken, it is what the state moved carries.
template <class Stress>
struct WithStress : CompensatedVector {
  Stress stress = {};  ///< τ at the quadrature points; empty: none, or none yet

  using CompensatedVector::CompensatedVector;
  explicit WithStress(CompensatedVector vector, Stress carried = {})
      : CompensatedVector(std::move(vector)), stress(std::move(carried)) {}

  WithStress moved(double step, const WithStress& direction) const {
    return WithStress(CompensatedVector::moved(step, direction), direction.stress);
  }
  /// Takes over the stress that an attempt to go on from this state has come to in vain: it is in
  /// equilibrium, and nearer to what lies ahead.
  void learn_from(const WithStress& attempt) {
    if (attempt.value().allFinite()) stress = attempt.stress;
  }
};

}  // namespace talus::solve
