// Manufactured flows solved in velocity and pressure, in the plane and in space, on families of
// meshes: a scene whose answer is known in every law.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/mixed/manufactured.hpp"
#include "common/shear/shear_flow.hpp"
#include "common/solve/jacobian_check.hpp"

namespace talus::threed {

/// Meshes of n elements along an edge. The exact traction is prescribed on one boundary, so that
/// the pressure is determined, and the exact velocity on all others.
template <int Dim>
struct MeshFamily {
  std::string name;
  std::function<fem::Mesh<Dim>(int n)> mesh;
  std::string traction_boundary = "top";
};

/// The unit square or cube: uniform, stretched, or distorted at random on every level; in the plane
/// a sector of an annulus too.
template <int Dim>
const std::vector<MeshFamily<Dim>>& mesh_families();

/// A flow and what it is to solve.
template <int Dim>
struct ManufacturedCase {
  mixed::ManufacturedFlow<Dim> exact;
  rheology::Regularisation regularisation;
  double inertia = 0;
  mixed::PressureBasis pressure_basis = mixed::PressureBasis::physical;
  rheology::FrictionLaw law = {};

  rheology::Rheology rheology() const { return {law, regularisation, exact.lambda_r}; }
};

/// The case must outlive them.
template <int Dim>
mixed::BoundaryConditions<Dim> exact_conditions(const ManufacturedCase<Dim>& manufactured,
                                                const fem::Mesh<Dim>& mesh,
                                                const std::string& traction_boundary);

struct ManufacturedOptions {
  solve::NewtonOptions newton{.line_search = solve::LineSearch::residual_norm};
  mixed::PenaltyOptions penalty = {};
  shear::TangentTerm tangent = shear::TangentTerm::full;
};

struct ManufacturedSolution {
  solve::NewtonSummary newton;
  mixed::FlowErrors errors;  ///< NaN if the solve failed
  int factorisations = 0;
  Eigen::Index unknowns = 0, condensed = 0;
  double factor_entries = 0;
  double seconds = 0;  ///< CPU time, with set-up and errors
};

/// The same with the flow itself.
template <int Dim>
struct SolvedManufactured : ManufacturedSolution {
  std::unique_ptr<mixed::MixedSpace<Dim>> space;
  typename mixed::MixedFlow<Dim>::State state;
};

/// The problem that is solved; case and space must outlive it.
template <int Dim>
mixed::MixedFlow<Dim> problem_of(const ManufacturedCase<Dim>& manufactured,
                                 const mixed::MixedSpace<Dim>& space,
                                 const ManufacturedOptions& options);

/// Solves by Newton, from the exact flow interpolated.
template <int Dim>
SolvedManufactured<Dim> solve_manufactured(const ManufacturedCase<Dim>& manufactured,
                                           const MeshFamily<Dim>& family, int n,
                                           const ManufacturedOptions& options = {});

/// Checks the tangent on a mesh, about the pressure in the middle of the flow; see
/// mixed::check_jacobian.
template <int Dim>
std::vector<solve::NamedCheck> check_manufactured(const ManufacturedCase<Dim>& manufactured,
                                                  const MeshFamily<Dim>& family, int n,
                                                  const ManufacturedOptions& options = {});

}  // namespace talus::threed
