// The discrete answer of a scene on a line, found element by element: no assembly, no linear
// system, no Newton step, so that solvers can be measured against it.
//
// Equilibrium alone gives the stress along a line but for one number t an element. Quadratic
// velocities have a linear shear rate, and of the stresses at the three Gauss points two moments
// are what the load asks for: those of the exact stress. What is left is
//     τ_q = σ_q + t φ_q,  φ = (0.4, -0.5, 0.4), orthogonal to 1 and ξ,
// and t makes the three shear rates γ(τ_q) linear: γ_1 - 2 γ_2 + γ_3 = 0, increasing in t.
#pragma once

#include <functional>

#include "oned/solver.hpp"

namespace talus::verification {

/// A shear rate and its slope in the stress.
struct Rate {
  double value = 0, slope = 0;
};
/// The shear rate that carries `stress` >= 0 under `pressure`.
using RateLaw = std::function<Rate(double stress, double pressure)>;

/// Of eq. (4), as the interior point solves it: 0 up to μs p, infinite from μ2 p on.
RateLaw rate_of(const rheology::FrictionLaw& law);
/// Of a regularised law: the root of η(γ, p) γ = τ in the logarithm of γ.
RateLaw rate_of(const rheology::Rheology& rheology);

/// Velocities at the nodes of `space`, in the order of its mesh. The scene's body force must be
/// constant and its exact stress, the same under every law, linear.
Eigen::VectorXd line_answer(const oned::ShearScene& scene, const shear::CrossSection<1>& space,
                            const RateLaw& law);

}  // namespace talus::verification
