#include "threed/manufactured.hpp"

#include <limits>

#include "common/fem/line_mesh.hpp"
#include "common/flow/dense_jacobian.hpp"
#include "common/flow/dense_tangent.hpp"
#include "common/flow/mesh_tools.hpp"
#include "common/solve/stopwatch.hpp"

namespace talus::threed {
namespace {

template <int Dim>
flow::Mesh<Dim> unit_box(int n, double grading) {
  const auto line = fem::graded_line(0, 1, n, grading);
  std::array<std::span<const double>, Dim> lines;
  lines.fill(line);
  return flow::tensor_mesh<Dim>(lines);
}

template <int Dim>
std::vector<MeshFamily<Dim>> boxes() {
  return {{"uniform", [](int n) { return unit_box<Dim>(n, 1); }},
          {"stretched", [](int n) { return unit_box<Dim>(n, 1.5); }},
          {"distorted", [](int n) {
             return flow::distorted(unit_box<Dim>(n, 1), 0.2, static_cast<unsigned>(n));
           }}};
}

template <int Dim>
flow::DenseSpace<Dim> space_of(const ManufacturedCase<Dim>& manufactured,
                               const MeshFamily<Dim>& family, int n) {
  const flow::Mesh<Dim> mesh = family.mesh(n);
  return {mesh, exact_conditions(manufactured, mesh, family.traction_boundary),
          manufactured.pressure_basis};
}

template <int Dim>
flow::DenseFlow<Dim> problem_of(const ManufacturedCase<Dim>& manufactured,
                                const flow::DenseSpace<Dim>& space,
                                const ManufacturedOptions& options) {
  const rheology::Rheology rheology = manufactured.rheology();
  flow::DenseFlow<Dim> problem(
      space, rheology, manufactured.exact.load(rheology, manufactured.inertia), options.penalty);
  flow::set_tangent(problem, options.tangent);
  return problem;
}

}  // namespace

template <>
const std::vector<MeshFamily<2>>& mesh_families() {
  static const std::vector<MeshFamily<2>> families = [] {
    auto all = boxes<2>();
    all.push_back(
        {"sector", [](int n) { return flow::annulus_mesh(0.5, 1.5, n, n, 0.3, 1.2); }, "outer"});
    return all;
  }();
  return families;
}

template <>
const std::vector<MeshFamily<3>>& mesh_families() {
  static const std::vector<MeshFamily<3>> families = boxes<3>();
  return families;
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
ManufacturedSolution solve_manufactured(const ManufacturedCase<Dim>& manufactured,
                                        const MeshFamily<Dim>& family, int n,
                                        const ManufacturedOptions& options) {
  const solve::Stopwatch watch;
  const auto space = space_of(manufactured, family, n);
  auto problem = problem_of(manufactured, space, options);
  auto state = flow::interpolate(manufactured.exact, space);
  ManufacturedSolution solution;
  solution.newton = solve::newton(problem, state, options.newton);
  constexpr double failed = std::numeric_limits<double>::quiet_NaN();
  solution.errors = solve::is_success(solution.newton.end)
                        ? flow::errors_against(manufactured.exact, space, state)
                        : flow::FlowErrors{failed, failed, failed, failed};
  solution.factorisations = problem.factorisations();
  solution.unknowns = space.size();
  solution.condensed = problem.system().unknowns();
  solution.factor_entries = problem.system().factor_entries();
  solution.seconds = watch.seconds();
  return solution;
}

template <int Dim>
std::vector<solve::NamedCheck> check_manufactured(const ManufacturedCase<Dim>& manufactured,
                                                  const MeshFamily<Dim>& family, int n,
                                                  const ManufacturedOptions& options) {
  const auto space = space_of(manufactured, family, n);
  const double pressure = manufactured.exact.at(flow::Point<Dim>::Constant(0.5)).pressure;
  return flow::check_jacobian(problem_of(manufactured, space, options), pressure);
}

#define TALUS_FOR(Dim)                                                                        \
  template flow::BoundaryConditions<Dim> exact_conditions(                                    \
      const ManufacturedCase<Dim>&, const flow::Mesh<Dim>&, const std::string&);              \
  template ManufacturedSolution solve_manufactured(                                           \
      const ManufacturedCase<Dim>&, const MeshFamily<Dim>&, int, const ManufacturedOptions&); \
  template std::vector<solve::NamedCheck> check_manufactured(                                 \
      const ManufacturedCase<Dim>&, const MeshFamily<Dim>&, int, const ManufacturedOptions&);
TALUS_FOR(2)
TALUS_FOR(3)
#undef TALUS_FOR

}  // namespace talus::threed
