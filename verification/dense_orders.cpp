#include "verification/dense_orders.hpp"

#include <algorithm>

#include "common/fem/line_mesh.hpp"
#include "common/flow/mesh_tools.hpp"
#include "verification/fit.hpp"

namespace talus::verification {
namespace {

flow::Mesh<2> square(int n, double grading) {
  const auto line = fem::graded_line(0, 1, n, grading);
  return flow::tensor_mesh<2>({line, line});
}

}  // namespace

std::vector<MeshFamily<2>> mesh_families(const std::vector<int>& sizes) {
  return {{"uniform", sizes, [](int n) { return square(n, 1); }},
          {"stretched", sizes, [](int n) { return square(n, 1.5); }},
          {"distorted", sizes,
           [](int n) { return flow::distorted(square(n, 1), 0.2, static_cast<unsigned>(n)); }},
          {"sector", sizes, [](int n) { return flow::annulus_mesh(0.5, 1.5, n, n, 0.3, 1.2); },
           "outer"}};
}

MeshFamily<3> brick_family(const std::vector<int>& sizes) {
  return {"bricks, distorted", sizes, [](int n) {
            const auto line = fem::graded_line(0, 1, n, 1);
            return flow::distorted(flow::box_mesh(line, line, line), 0.2, static_cast<unsigned>(n));
          }};
}

std::vector<double> MeasuredOrders::column(double flow::FlowErrors::*norm) const {
  std::vector<double> values;
  for (const auto& each : errors) values.push_back(each.*norm);
  return values;
}

double MeasuredOrders::order(double flow::FlowErrors::*norm, std::size_t meshes) const {
  const auto from = static_cast<std::ptrdiff_t>(h.size() - std::min(meshes, h.size()));
  const auto values = column(norm);
  return fitted_order({h.begin() + from, h.end()}, {values.begin() + from, values.end()});
}

template <int Dim>
flow::BoundaryConditions<Dim> exact_conditions(const ManufacturedCase<Dim>& manufactured,
                                               const flow::Mesh<Dim>& mesh,
                                               const std::string& traction_boundary) {
  const auto& exact = manufactured.exact;
  const auto velocity = flow::prescribed_velocity<Dim>(
      [&exact](const flow::Point<Dim>& x) { return exact.at(x).velocity; });
  const auto traction = flow::prescribed_traction<Dim>(
      [&exact, rheology = manufactured.rheology()](const flow::Point<Dim>& x,
                                                   const flow::Point<Dim>& normal) {
        return exact.traction(x, normal, rheology);
      });
  flow::BoundaryConditions<Dim> conditions;
  for (const auto& [name, faces] : mesh.boundaries)
    conditions[name] = name == traction_boundary ? traction : velocity;
  return conditions;
}

template <int Dim>
MeasuredOrders measure_orders(const ManufacturedCase<Dim>& manufactured,
                              const MeshFamily<Dim>& family) {
  const auto& exact = manufactured.exact;
  const rheology::Rheology rheology = manufactured.rheology();
  MeasuredOrders measured;
  for (const int n : family.sizes) {
    const flow::Mesh<Dim> mesh = family.mesh(n);
    const auto conditions = exact_conditions(manufactured, mesh, family.traction_boundary);
    const flow::DenseSpace<Dim> space(mesh, conditions, manufactured.pressure_basis);
    flow::DenseFlow<Dim> problem(space, rheology, exact.load(rheology, manufactured.inertia));
    auto state = flow::interpolate(exact, space);
    const auto newton =
        solve::newton(problem, state, {.line_search = solve::LineSearch::residual_norm});
    constexpr double failed = std::numeric_limits<double>::quiet_NaN();
    measured.h.push_back(1. / n);
    measured.errors.push_back(solve::is_success(newton.end)
                                  ? flow::errors_against(exact, space, state)
                                  : flow::FlowErrors{failed, failed, failed, failed});
  }
  return measured;
}

template <int Dim>
flow::ManufacturedFlow<Dim> with_pressure_times(double factor, flow::ManufacturedFlow<Dim> flow) {
  flow.at = [factor, at = flow.at](const flow::Point<Dim>& x) {
    auto derivatives = at(x);
    derivatives.pressure *= factor;
    derivatives.pressure_gradient *= factor;
    return derivatives;
  };
  return flow;
}

template flow::BoundaryConditions<3> exact_conditions(const ManufacturedCase<3>&,
                                                      const flow::Mesh<3>&, const std::string&);
template MeasuredOrders measure_orders(const ManufacturedCase<2>&, const MeshFamily<2>&);
template MeasuredOrders measure_orders(const ManufacturedCase<3>&, const MeshFamily<3>&);
template flow::ManufacturedFlow<2> with_pressure_times(double, flow::ManufacturedFlow<2>);

}  // namespace talus::verification
