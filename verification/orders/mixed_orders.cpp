#include "verification/orders/mixed_orders.hpp"

#include <algorithm>

#include "verification/harness/fit.hpp"

namespace talus::verification {

std::vector<MeshFamily<2>> mesh_families(const std::vector<int>& sizes) {
  std::vector<MeshFamily<2>> families;
  for (const auto& family : threed::mesh_families<2>()) families.push_back({family, sizes});
  return families;
}

MeshFamily<3> brick_family(const std::vector<int>& sizes) {
  MeshFamily<3> family{threed::mesh_families<3>().back(), sizes};
  family.name = "bricks, " + family.name;
  return family;
}

std::vector<double> MeasuredOrders::column(double mixed::FlowErrors::*norm) const {
  std::vector<double> values;
  for (const auto& each : errors) values.push_back(each.*norm);
  return values;
}

double MeasuredOrders::order(double mixed::FlowErrors::*norm, std::size_t meshes) const {
  const auto from = static_cast<std::ptrdiff_t>(h.size() - std::min(meshes, h.size()));
  const auto values = column(norm);
  return fitted_order({h.begin() + from, h.end()}, {values.begin() + from, values.end()});
}

template <int Dim>
MeasuredOrders measure_orders(const ManufacturedCase<Dim>& manufactured,
                              const MeshFamily<Dim>& family) {
  MeasuredOrders measured;
  for (const int n : family.sizes) {
    measured.h.push_back(1. / n);
    measured.errors.push_back(threed::solve_manufactured(manufactured, family, n).errors);
  }
  return measured;
}

template <int Dim>
mixed::ManufacturedFlow<Dim> with_pressure_times(double factor, mixed::ManufacturedFlow<Dim> flow) {
  flow.at = [factor, at = flow.at](const fem::Point<Dim>& x) {
    auto derivatives = at(x);
    derivatives.pressure *= factor;
    derivatives.pressure_gradient *= factor;
    return derivatives;
  };
  return flow;
}

template MeasuredOrders measure_orders(const ManufacturedCase<2>&, const MeshFamily<2>&);
template MeasuredOrders measure_orders(const ManufacturedCase<3>&, const MeshFamily<3>&);
template mixed::ManufacturedFlow<2> with_pressure_times(double, mixed::ManufacturedFlow<2>);

}  // namespace talus::verification
