// Solving a one-dimensional scene, by Newton on the regularised law or by the interior point.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/flow/interior_point.hpp"
#include "common/flow/shear_flow.hpp"
#include "common/solve/continuation.hpp"
#include "common/solve/jacobian_check.hpp"
#include "oned/shear_scene.hpp"

namespace talus::oned {

enum class Method { newton, interior_point };

struct SolveOptions {
  Method method = Method::newton;
  rheology::Regularisation regularisation = rheology::ChauchatMedale{};
  double lambda_r = 1e-6;
  solve::NewtonOptions newton;
  bool continuation = true;  ///< fall back to continuation in λr when Newton fails from rest
  solve::Precision precision = solve::Precision::compensated;
  flow::TangentTerm tangent_term = flow::TangentTerm::full;
  flow::InteriorPointOptions interior_point;
  std::function<double(double)> start = {};  ///< velocity Newton starts from; empty: rest
  std::function<void(const solve::CompensatedVector&)> observe = {};  ///< Newton's iterates
};

/// A solved scene; fields at the quadrature points, three an element.
struct Solution {
  flow::CrossSection<1> space;
  solve::CompensatedVector velocity;  ///< at the nodes
  std::vector<double> shear_rate, stress;
  solve::End end = solve::End::stagnated;
  solve::ContinuationSummary newton;          ///< of Newton
  flow::InteriorPointSummary interior_point;  ///< of the interior point
  double seconds = 0;                         ///< CPU time of the solve, set-up included

  /// Newton iterations in all, or factorisations of the interior point.
  int iterations() const;
};

/// The space of a scene on a mesh.
flow::CrossSection<1> space_of(const ShearScene& scene, std::span<const double> boundaries);
/// The problem Newton solves; `space` must outlive it.
flow::ShearFlow<1> regularised_problem(const ShearScene& scene, flow::CrossSection<1>& space,
                                       const SolveOptions& options);
/// The problem of the interior point; `space` must outlive it.
flow::InteriorPoint<1> unregularised_problem(const ShearScene& scene, flow::CrossSection<1>& space);

/// Solves from rest or `options.start`. The load limits are the caller's business: a mesh may
/// return numbers for a flow that does not exist.
Solution solve(const ShearScene& scene, std::span<const double> boundaries,
               const SolveOptions& options);

/// A Jacobian check at a named state.
struct NamedCheck {
  std::string state;
  solve::JacobianCheck check;
};

/// Checks the linearisation of the chosen method at rest, half way to the solution, and there.
std::vector<NamedCheck> check_jacobian(const ShearScene& scene, std::span<const double> boundaries,
                                       const SolveOptions& options);

}  // namespace talus::oned
