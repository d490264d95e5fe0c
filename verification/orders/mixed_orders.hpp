// Orders of velocity-pressure flow, measured on manufactured solutions.
#pragma once

#include <vector>

#include "threed/manufactured.hpp"

namespace talus::verification {

using threed::ManufacturedCase;

/// A family with the meshes it is measured on: so many elements along an edge.
template <int Dim>
struct MeshFamily : threed::MeshFamily<Dim> {
  std::vector<int> sizes;
};

/// All families of the plane.
std::vector<MeshFamily<2>> mesh_families(const std::vector<int>& sizes);
/// A cube of bricks, distorted.
MeshFamily<3> brick_family(const std::vector<int>& sizes);

/// Errors of a family; NaN where Newton fails.
struct MeasuredOrders {
  std::vector<double> h;
  std::vector<mixed::FlowErrors> errors;

  std::vector<double> column(double mixed::FlowErrors::*norm) const;
  /// Fitted to the finest meshes, so many of them.
  double order(double mixed::FlowErrors::*norm, std::size_t meshes = 4) const;
};

template <int Dim>
MeasuredOrders measure_orders(const ManufacturedCase<Dim>& manufactured,
                              const MeshFamily<Dim>& family);

/// The same flow under another pressure: at a smaller one I is larger.
template <int Dim>
mixed::ManufacturedFlow<Dim> with_pressure_times(double factor, mixed::ManufacturedFlow<Dim> flow);

}  // namespace talus::verification
