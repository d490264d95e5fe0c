// Solving a one-dimensional scene, by Newton on the regularised law or by the interior point.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "common/shear/shear_solver.hpp"
#include "oned/shear_scene.hpp"

namespace talus::oned {

using shear::Method;

struct SolveOptions : shear::ShearOptions {
  std::function<double(double)> start = {};  ///< velocity Newton starts from; empty: rest
};

/// A solved scene; fields at the quadrature points, three an element. Its CPU time includes set-up.
struct Solution : shear::ShearSolution {
  shear::CrossSection<1> space;
};

/// The space of a scene on a mesh.
shear::CrossSection<1> space_of(const ShearScene& scene, std::span<const double> boundaries);
/// Pressure, body force and law of a scene, which must outlive the result.
shear::ShearLoad<1> load_of(const ShearScene& scene);

/// Solves from rest or `options.start`. The load limits are the caller's business: a mesh may
/// return numbers for a flow that does not exist.
Solution solve(const ShearScene& scene, std::span<const double> boundaries,
               const SolveOptions& options);

/// Checks the linearisation of the chosen method on a scene; see shear::check_jacobian.
std::vector<solve::NamedCheck> check_jacobian(const ShearScene& scene,
                                              std::span<const double> boundaries,
                                              const SolveOptions& options);

}  // namespace talus::oned
