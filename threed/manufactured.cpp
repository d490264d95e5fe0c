#include "threed/manufactured.hpp"

#include <limits>

#include "common/fem/line_mesh.hpp"
#include "common/fem/mesh_tools.hpp"
#include "common/mixed/mixed_jacobian.hpp"
#include "common/mixed/mixed_tangent.hpp"
#include "common/solve/stopwatch.hpp"

namespace talus::threed {
namespace {

template <int Dim>
fem::Mesh<Dim> unit_box(int n, double grading) {
  const auto line = fem::graded_line(0, 1, n, grading);
  std::array<std::span<const double>, Dim> lines;
  lines.fill(line);
  return fem::tensor_mesh<Dim>(lines);
}

template <int Dim>
std::vector<MeshFamily<Dim>> boxes() {
  return {{"uniform", [](int n) { return unit_box<Dim>(n, 1); }},
          {"stretched", [](int n) { return unit_box<Dim>(n, 1.5); }},
          {"distorted", [](int n) {
             return fem::distorted(unit_box<Dim>(n, 1), 0.2, static_cast<unsigned>(n));
           }}};
}

template <int Dim>
mixed::MixedSpace<Dim> space_of(const ManufacturedCase<Dim>& manufactured,
                                const MeshFamily<Dim>& family, int n) {
  const fem::Mesh<Dim> mesh = family.mesh(n);
  return {mesh, exact_conditions(manufactured, mesh, family.traction_boundary),
          manufactured.pressure_basis};
}

}  // namespace

template <>
const std::vector<MeshFamily<2>>& mesh_families() {
  static const std::vector<MeshFamily<2>> families = [] {
    auto all = boxes<2>();
    all.push_back(
        {"sector", [](int n) { return fem::annulus_mesh(0.5, 1.5, n, n, 0.3, 1.2); }, "outer"});
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
mixed::BoundaryConditions<Dim> exact_conditions(const ManufacturedCase<Dim>& manufactured,
                                                const fem::Mesh<Dim>& mesh,
                                                const std::string& traction_boundary) {
  const auto& exact = manufactured.exact;
  const auto velocity = mixed::prescribed_velocity<Dim>(
      [&exact](const fem::Point<Dim>& x) { return exact.at(x).velocity; });
  const auto traction =
      mixed::prescribed_traction<Dim>([&exact, rheology = manufactured.rheology()](
                                          const fem::Point<Dim>& x, const fem::Point<Dim>& normal) {
        return exact.traction(x, normal, rheology);
      });
  mixed::BoundaryConditions<Dim> conditions;
  for (const auto& [name, faces] : mesh.boundaries)
    conditions[name] = name == traction_boundary ? traction : velocity;
  return conditions;
}

template <int Dim>
mixed::MixedFlow<Dim> problem_of(const ManufacturedCase<Dim>& manufactured,
                                 const mixed::MixedSpace<Dim>& space,
                                 const ManufacturedOptions& options) {
  const rheology::Rheology rheology = manufactured.rheology();
  mixed::MixedFlow<Dim> problem(
      space, rheology, manufactured.exact.load(rheology, manufactured.inertia), options.penalty);
  mixed::set_tangent(problem, options.tangent);
  return problem;
}

template <int Dim>
SolvedManufactured<Dim> solve_manufactured(const ManufacturedCase<Dim>& manufactured,
                                           const MeshFamily<Dim>& family, int n,
                                           const ManufacturedOptions& options) {
  const solve::Stopwatch watch;
  SolvedManufactured<Dim> solution;
  solution.space = std::make_unique<mixed::MixedSpace<Dim>>(space_of(manufactured, family, n));
  const auto& space = *solution.space;
  auto& state = solution.state;
  auto problem = problem_of(manufactured, space, options);
  state = mixed::interpolate(manufactured.exact, space);
  solution.newton = solve::newton(problem, state, options.newton);
  constexpr double failed = std::numeric_limits<double>::quiet_NaN();
  solution.errors = solve::is_success(solution.newton.end)
                        ? mixed::errors_against(manufactured.exact, space, state)
                        : mixed::FlowErrors{failed, failed, failed, failed};
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
  const double pressure = manufactured.exact.at(fem::Point<Dim>::Constant(0.5)).pressure;
  return mixed::check_jacobian(problem_of(manufactured, space, options), pressure);
}

#define TALUS_FOR(Dim)                                                                          \
  template mixed::BoundaryConditions<Dim> exact_conditions(                                     \
      const ManufacturedCase<Dim>&, const fem::Mesh<Dim>&, const std::string&);                 \
  template mixed::MixedFlow<Dim> problem_of(                                                    \
      const ManufacturedCase<Dim>&, const mixed::MixedSpace<Dim>&, const ManufacturedOptions&); \
  template SolvedManufactured<Dim> solve_manufactured(                                          \
      const ManufacturedCase<Dim>&, const MeshFamily<Dim>&, int, const ManufacturedOptions&);   \
  template std::vector<solve::NamedCheck> check_manufactured(                                   \
      const ManufacturedCase<Dim>&, const MeshFamily<Dim>&, int, const ManufacturedOptions&);
TALUS_FOR(2)
TALUS_FOR(3)
#undef TALUS_FOR

}  // namespace talus::threed
