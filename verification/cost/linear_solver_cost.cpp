// Ways to solve the linear systems of a three-dimensional flow: error against time.
#include <algorithm>
#include <cmath>
#include <memory>

#include "common/fem/line_mesh.hpp"
#include "common/solve/stopwatch.hpp"
#include "verification/cost/cost_parts.hpp"
#include "verification/harness/methods.hpp"
#include "verification/orders/mixed_orders.hpp"

namespace talus::verification {
namespace {

using mixed::LinearSolver;
using State = mixed::MixedFlow<3>::State;

struct Way {
  std::string name;
  LinearSolver solver = LinearSolver::direct;
  bool nested = false;
  int threads = 1;
};

const std::vector<Way> ways = {{"direct"},
                               {"lagged", LinearSolver::lagged},
                               {"direct, nested", LinearSolver::direct, true},
                               {"lagged, nested", LinearSolver::lagged, true},
                               {"direct, two threads", LinearSolver::direct, false, 2},
                               {"lagged, two threads", LinearSolver::lagged, false, 2}};

/// A mesh solved on, and what everything up to there has cost.
struct Work {
  double cpu = 0, wall = 0, error = 0;
  int steps = 0, factorisations = 0, iterations = 0;
  bool solved = true;
};

// A cube of n elements along an edge.
struct Cube {
  int n;
  mixed::MixedSpace<3> space;

  Cube(int elements, const ManufacturedCase<3>& manufactured)
      : n(elements),
        space(mesh(elements), threed::exact_conditions(manufactured, mesh(elements), "top")) {}
  static fem::Mesh<3> mesh(int n) {
    const auto line = fem::graded_line(0, 1, n, 1);
    return fem::box_mesh(line, line, line);
  }
  // Of the element around `inside`, which may be asked about points beside it too.
  mixed::MixedSpace<3>::Values values_at(const State& state, const fem::Point<3>& inside,
                                         const fem::Point<3>& position) const {
    std::size_t element = 0;
    fem::Point<3> reference;
    for (int d = 2; d >= 0; --d) {
      const int cell = std::clamp(static_cast<int>(inside[d] * n), 0, n - 1);
      element = element * static_cast<std::size_t>(n) + static_cast<std::size_t>(cell);
      reference[d] = 2 * (position[d] * n - cell) - 1;
    }
    return space.values_at(state, element, reference);
  }
};

// The flow on one mesh as a start on another.
State carried_over(const Cube& from, const State& state, const Cube& to) {
  State start = to.space.start();
  const auto& mesh = to.space.mesh();
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (int i = 0; i < 3; ++i) {
      const auto v = to.space.velocity_index(static_cast<Eigen::Index>(node), i);
      if (!to.space.is_fixed(v))
        start.set(v, from.values_at(state, mesh.nodes[node], mesh.nodes[node]).velocity[i]);
    }
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto& centre =
        mesh.nodes[static_cast<std::size_t>(mesh.elements[e][mixed::MixedSpace<3>::interior])];
    const auto pressure_beside = [&](const fem::Point<3>& offset) {
      return from.values_at(state, centre, centre + offset).pressure;
    };
    const double level = pressure_beside(fem::Point<3>::Zero());
    start.set(to.space.pressure_index(e, 0), level);
    const auto basis = to.space.pressure_basis(e, {}, centre + fem::Point<3>::Ones());
    for (int d = 0; d < 3; ++d)  // where basis function d + 1 is one
      start.set(to.space.pressure_index(e, d + 1),
                pressure_beside(fem::Point<3>::Unit(d) / basis[d + 1]) - level);
  }
  return start;
}

// The meshes on the way to n: the coarsest, and between them every halving if they are nested.
std::vector<int> meshes_to(int n, bool nested) {
  constexpr int coarsest = 2;
  std::vector<int> sizes = {n};
  if (nested)
    while (sizes.back() > 2 * coarsest) sizes.push_back((sizes.back() + 1) / 2);
  sizes.push_back(coarsest);
  std::ranges::reverse(sizes);
  return sizes;
}

// From the exact flow on the coarsest mesh.
Work solve_to(int n, const Way& way, const ManufacturedCase<3>& manufactured) {
  const rheology::Rheology rheology = manufactured.rheology();
  const auto load = manufactured.exact.load(rheology, manufactured.inertia);
  solve::set_threads(way.threads);
  const solve::Stopwatch watch;
  Work work;
  std::unique_ptr<Cube> last;
  State state;
  for (const int size : meshes_to(n, way.nested)) {
    auto cube = std::make_unique<Cube>(size, manufactured);
    state = last ? carried_over(*last, state, *cube)
                 : mixed::interpolate(manufactured.exact, cube->space);
    mixed::MixedFlow<3> problem(cube->space, rheology, load);
    problem.set_linear_solver(way.solver);
    const auto newton =
        solve::newton(problem, state, {.line_search = solve::LineSearch::residual_norm});
    work.solved = work.solved && solve::is_success(newton.end);
    if (size == n) {
      work.steps = newton.iterations();
      work.factorisations = problem.factorisations();
      work.iterations = problem.krylov_iterations();
    }
    last = std::move(cube);
  }
  work.cpu = watch.seconds();
  work.wall = watch.elapsed();
  work.error = if_counts(work.solved,
                         mixed::errors_against(manufactured.exact, last->space, state).velocity);
  solve::set_threads(1);
  return work;
}

}  // namespace

void linear_solver_costs(Chapter& chapter, const Context& context) {
  const std::vector<int> sizes = context.full ? std::vector{4, 6, 8, 12} : std::vector{3, 4, 6};
  const ManufacturedCase<3> manufactured{mixed::manufactured_flows<3>().back(),
                                         rheology::ChauchatMedale{}, 1};
  io::Table table{
      "A manufactured flow in a cube of H27, every way to solve its linear systems: "
      "steps, factorisations and iterations of GMRES on the finest mesh, times of all "
      "meshes on the way to it",
      {"way", "n", "L2 error of u", "Newton steps", "factorisations", "GMRES iterations", "CPU s",
       "wall s"},
      {}};
  io::Panel cpu{"CPU time", "CPU seconds", "L2 error of u", true, true, {}};
  io::Panel wall{"Time on the wall", "wall seconds", "L2 error of u", true, true, {}};
  int failed = 0, factorisations_of_direct = 0, factorisations_of_lagged = 0;
  double apart = 0;
  std::vector<double> errors_of_direct;
  for (const Way& way : ways) {
    io::Curve by_cpu{way.name, {}, {}}, by_wall{way.name, {}, {}};
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const Work work = solve_to(sizes[i], way, manufactured);
      failed += work.solved ? 0 : 1;
      if (&way == &ways.front()) errors_of_direct.push_back(work.error);
      apart = solve::nan_max(apart, std::abs(work.error / errors_of_direct[i] - 1));
      (way.solver == LinearSolver::direct ? factorisations_of_direct : factorisations_of_lagged) +=
          work.factorisations;
      by_cpu.x.push_back(work.cpu);
      by_wall.x.push_back(work.wall);
      by_cpu.y.push_back(work.error);
      by_wall.y.push_back(work.error);
      table.rows.push_back({way.name, std::to_string(sizes[i]), io::rounded(work.error, 3),
                            std::to_string(work.steps), std::to_string(work.factorisations),
                            std::to_string(work.iterations), io::rounded(work.cpu, 3),
                            io::rounded(work.wall, 3)});
    }
    if (way.threads == 1) cpu.curves.push_back(by_cpu);
    wall.curves.push_back(by_wall);
  }
  chapter.check(Kind::self_consistency, "3D, ways to solve linear systems: solves that failed",
                failed, 0, 0);
  chapter.check(Kind::other_method, "3D: errors of all ways apart from that of direct solves",
                apart, 0, 1e-6);
  chapter.check(Kind::self_consistency, "3D: factorisations with lagged factors over those without",
                if_counts(failed == 0,
                          static_cast<double>(factorisations_of_lagged) / factorisations_of_direct),
                0, 0.7);
  chapter.figure(
      {"cost_3d",
       "A manufactured flow in space under eq. (12) to a given error, " +
           std::to_string(sizes.front()) + " to " + std::to_string(sizes.back()) +
           " elements a side. Factors are kept from step to step "
           "(lagged), meshes solved from the coarse to the fine (nested), elements assembled "
           "on two threads.",
       {cpu, wall},
       2});
  chapter.table(std::move(table));
}

}  // namespace talus::verification
