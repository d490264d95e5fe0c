// Small velocity-pressure problems for tests: elements that are not affine, states where the law is
// awkward.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "common/fem/mesh_tools.hpp"
#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {

/// Curves a box: none of its elements stays affine.
template <int Dim>
fem::Mesh<Dim> curved(fem::Mesh<Dim> mesh) {
  for (auto& node : mesh.nodes) {
    const fem::Point<Dim> x = node;
    for (int i = 0; i < Dim; ++i)
      node[i] += 0.1 * std::sin(2 * x[(i + 1) % Dim]) + 0.05 * x[0] * x[Dim - 1];
  }
  return mesh;
}

/// n x m elements, distorted and curved.
inline fem::Mesh<2> awkward_mesh2(int n, int m) {
  std::vector<double> x, y;
  for (int i = 0; i <= n; ++i) x.push_back(i / static_cast<double>(n));
  for (int j = 0; j <= m; ++j) y.push_back(j / static_cast<double>(m));
  return curved(
      fem::distorted(fem::rectangle_mesh(x, y, [](const auto&) { return false; }), 0.2, 1));
}
/// Two elements, curved.
inline fem::Mesh<3> awkward_mesh3() {
  const std::vector<double> once{0, 1}, twice{0, 0.4, 1};
  return curved(fem::box_mesh(once, once, twice));
}

/// What is prescribed on three kinds of boundary: a velocity, a traction, an outflow.
template <int Dim>
BoundaryConditions<Dim> mixed_conditions(bool open = true) {
  BoundaryConditions<Dim> conditions{
      {"left",
       prescribed_velocity<Dim>([](const fem::Point<Dim>& x) { return fem::Point<Dim>(0.3 * x); })},
      {"right", open ? open_boundary<Dim>() : BoundaryCondition<Dim>{}},
      {"bottom", no_slip<Dim>()},
      {"top", prescribed_traction<Dim>([](const fem::Point<Dim>&, const fem::Point<Dim>& n) {
         return fem::Point<Dim>(-0.7 * n);
       })}};
  if constexpr (Dim == 3) {
    conditions["back"] = symmetry<Dim>(2);
    conditions["front"] = fully_developed<Dim>(2);
  }
  return conditions;
}

/// A velocity (a translation and shear of about this rate) and a dynamic pressure; the static one
/// is 2.
struct TestState {
  std::string name;
  double shear_rate, translation, pressure, inertia;
};

inline std::vector<TestState> test_states(double lambda_r) {
  return {{"rest", 0, 0, 0.5, 0},
          {"plug", 1e-3 * lambda_r, 1, 0.5, 0},
          {"near yield", lambda_r, 0, 0.5, 0},
          {"flow", 1, 0, 0.5, 0},
          {"flow with inertia", 1, 1, 0.5, 1},
          {"negative pressure", 1, 0, -5, 0}};
}

template <int Dim>
typename MixedSpace<Dim>::State state_of(const MixedSpace<Dim>& space, const TestState& test) {
  auto state = space.start();
  for (std::size_t node = 0; node < space.mesh().nodes.size(); ++node) {
    const fem::Point<Dim>& x = space.mesh().nodes[node];
    for (int i = 0; i < Dim; ++i)
      state.set(space.velocity_index(static_cast<Eigen::Index>(node), i),
                test.translation + test.shear_rate * (0.8 * x[(i + 1) % Dim] +
                                                      0.3 * std::sin(2 * x[i] + x[0] * x[1] + i)));
  }
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (int k = 0; k <= Dim; ++k)
      state.set(space.pressure_index(e, k),
                k == 0 ? test.pressure : 0.1 * std::sin(static_cast<double>(e) + k));
  return state;
}

template <int Dim>
MixedLoad<Dim> test_load(double inertia) {
  return {
      [](const fem::Point<Dim>&) { return 2.0; },
      [](const fem::Point<Dim>& x) { return fem::Point<Dim>(x - 0.7 * fem::Point<Dim>::Ones()); },
      inertia};
}

}  // namespace talus::mixed
