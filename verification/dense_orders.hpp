// Orders of velocity-pressure flow, measured on manufactured solutions.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "common/flow/manufactured.hpp"

namespace talus::verification {

/// Meshes of n elements along an edge, n in `sizes`; a traction is prescribed on one boundary, so
/// that the pressure is determined, and the velocity on all others.
template <int Dim>
struct MeshFamily {
  std::string name;
  std::vector<int> sizes;
  std::function<flow::Mesh<Dim>(int n)> mesh;
  std::string traction_boundary = "top";
};

/// Uniform, stretched, distorted at random on every level, and a sector of an annulus.
std::vector<MeshFamily<2>> mesh_families(const std::vector<int>& sizes);
/// A cube of bricks, distorted.
MeshFamily<3> brick_family(const std::vector<int>& sizes);

/// A solution to find and the way to find it.
template <int Dim>
struct ManufacturedCase {
  flow::ManufacturedFlow<Dim> exact;
  rheology::Regularisation regularisation;
  double inertia = 0;
  flow::PressureBasis pressure_basis = flow::PressureBasis::physical;

  rheology::Rheology rheology() const { return {{}, regularisation, exact.lambda_r}; }
};

/// The exact traction on one boundary, the exact velocity on all others. The case must outlive
/// them.
template <int Dim>
flow::BoundaryConditions<Dim> exact_conditions(const ManufacturedCase<Dim>& manufactured,
                                               const flow::Mesh<Dim>& mesh,
                                               const std::string& traction_boundary);

/// Errors of a family; NaN where Newton fails.
struct MeasuredOrders {
  std::vector<double> h;
  std::vector<flow::FlowErrors> errors;

  std::vector<double> column(double flow::FlowErrors::*norm) const;
  /// Fitted to the finest meshes, so many of them.
  double order(double flow::FlowErrors::*norm, std::size_t meshes = 4) const;
};

template <int Dim>
MeasuredOrders measure_orders(const ManufacturedCase<Dim>& manufactured,
                              const MeshFamily<Dim>& family);

/// The same flow under another pressure: at a smaller one I is larger.
template <int Dim>
flow::ManufacturedFlow<Dim> with_pressure_times(double factor, flow::ManufacturedFlow<Dim> flow);

}  // namespace talus::verification
