// What an element of velocity-pressure flow costs, and where the time of a Newton step goes.
#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "common/fem/line_mesh.hpp"
#include "common/mixed/mixed_flow.hpp"
#include "common/solve/stopwatch.hpp"
#include "twod/cylinder_mesh.hpp"
#include "verification/cost/cost_parts.hpp"

namespace talus::verification {
namespace {

using solve::Stopwatch;

struct Seconds {
  double cpu = std::numeric_limits<double>::infinity();
  double wall = std::numeric_limits<double>::infinity();
};

// The smallest of several repetitions: other processes only ever add time.
Seconds best_of(int repetitions, const std::function<void()>& work) {
  Seconds best;
  for (int i = 0; i < repetitions; ++i) {
    const Stopwatch watch;
    work();
    best.cpu = std::min(best.cpu, watch.seconds());
    best.wall = std::min(best.wall, watch.elapsed());
  }
  return best;
}

struct Costs {
  double elements = 0, unknowns = 0, condensed = 0;
  double residual = 0, tangent = 0, condensation = 0;  // CPU seconds, the whole mesh
  double factor = 0, solve = 0, step = 0;
  double assembly_wall = 0, assembly_wall_of_two = 0;  // tangent, condensation and scatter

  double share_of_assembly() const { return (residual + tangent + condensation) / step; }
};

// Sheared along the first direction: what the kernels cost does not depend on it.
template <int Dim>
typename std::array<mixed::PointState<Dim>, mixed::MixedSpace<Dim>::points_per_element> sheared() {
  mixed::PointState<Dim> at{};
  at.velocity[0] = 1;
  at.gradient[0][Dim - 1] = 1;
  at.viscosity = 1;
  at.shear_rate_slope = -0.1;
  at.pressure_slope = 0.1;
  std::array<mixed::PointState<Dim>, mixed::MixedSpace<Dim>::points_per_element> states;
  states.fill(at);
  return states;
}

template <int Dim>
void measure_system(const mixed::MixedSpace<Dim>& space, double inertia, int repetitions,
                    Costs& costs) {
  const auto states = sheared<Dim>();
  mixed::CondensedSystem<Dim> system(space);
  const auto tangent_of = [&](std::size_t b, mixed::BatchTangent<Dim>& tangent) {
    mixed::batch_tangent<Dim>(space, space.batches()[b], states, nullptr, mixed::Pack(1e-4),
                              inertia, {}, tangent);
  };
  const auto assemble = [&] {
    system.set_zero();
    space.for_each_batch([&](std::size_t b) {
      mixed::BatchTangent<Dim> tangent;
      tangent_of(b, tangent);
      system.add(b, tangent);
    });
  };
  const auto tangent = std::make_unique<mixed::BatchTangent<Dim>>();
  const Seconds tangents = best_of(repetitions, [&] {
    for (std::size_t b = 0; b < space.batches().size(); ++b) tangent_of(b, *tangent);
  });
  const Seconds assembly = best_of(repetitions, assemble);
  solve::set_threads(2);
  costs.assembly_wall_of_two = best_of(repetitions, assemble).wall;
  solve::set_threads(1);
  costs.tangent = tangents.cpu;
  costs.condensation = assembly.cpu - tangents.cpu;
  costs.assembly_wall = assembly.wall;
  costs.condensed = static_cast<double>(system.unknowns());
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(space.size(), -1, 1);
  Eigen::VectorXd x;
  costs.factor = best_of(2, [&] { system.factor(); }).cpu;
  costs.solve = best_of(2, [&] { system.solve(b, x); }).cpu;
}

// A flow driven by `force` under a uniform pressure: the second Newton step from rest, where
// everything shears.
template <int Dim>
Costs costs_on(const fem::Mesh<Dim>& mesh, mixed::BoundaryConditions<Dim> conditions,
               const fem::Point<Dim>& force, double inertia, int repetitions) {
  const mixed::MixedSpace<Dim> space(mesh, std::move(conditions));
  Costs costs;
  costs.elements = static_cast<double>(space.element_count());
  costs.unknowns = static_cast<double>(space.size());
  measure_system(space, inertia, repetitions, costs);
  mixed::MixedFlow<Dim> flow(space, {{}, rheology::ChauchatMedale{}, 1e-2},
                             {[](const fem::Point<Dim>&) { return 1.0; },
                              [&force](const fem::Point<Dim>&) { return force; }, inertia});
  auto state = space.start();
  typename mixed::MixedFlow<Dim>::State direction;
  flow.linear_solve(-flow.evaluate(state).value, direction);
  state = state.moved(1, direction);
  costs.residual = best_of(repetitions, [&] { flow.evaluate(state); }).cpu;
  costs.step = best_of(2, [&] { flow.linear_solve(-flow.evaluate(state).value, direction); }).cpu;
  return costs;
}

Costs costs_past_a_cylinder(int around, int repetitions) {
  return costs_on<2>(twod::cylinder_mesh(twod::refined_to(around)),
                     {{"top", mixed::fully_developed<2>(1)},
                      {"bottom", mixed::fully_developed<2>(1)},
                      {"wall", mixed::no_slip<2>()},
                      {"cylinder", mixed::no_slip<2>()},
                      {"symmetry", mixed::symmetry<2>(0)}},
                     {0, -0.05}, 1, repetitions);
}

// Half a heap: a stream along the first direction with a side wall, a floor and a free surface.
Costs costs_of_a_box(const std::array<int, 3>& elements, double inertia, int repetitions) {
  const auto line = [&](std::size_t d) { return fem::graded_line(0, 1, elements[d], 1); };
  return costs_on<3>(fem::box_mesh(line(0), line(1), line(2)),
                     {{"left", mixed::fully_developed<3>(0)},
                      {"right", mixed::fully_developed<3>(0)},
                      {"bottom", mixed::symmetry<3>(1)},
                      {"top", mixed::no_slip<3>()},
                      {"back", mixed::no_slip<3>()},
                      {"front", {}}},
                     {0.5, 0, 0}, inertia, repetitions);
}

std::vector<std::string> row_of(const std::string& name, const Costs& c) {
  const auto micro = [&](double seconds) { return io::rounded(1e6 * seconds / c.elements, 3); };
  return {name,
          io::fixed(c.elements, 0),
          io::fixed(c.unknowns, 0) + " (" + io::fixed(c.condensed, 0) + ")",
          micro(c.residual),
          micro(c.tangent),
          micro(c.condensation),
          micro(c.residual + c.tangent + c.condensation),
          io::rounded(c.factor, 3),
          io::rounded(c.solve, 3),
          io::rounded(c.step, 3),
          io::fixed(100 * c.share_of_assembly(), 1),
          io::fixed(c.assembly_wall / c.assembly_wall_of_two, 2)};
}

}  // namespace

void element_costs(Chapter& chapter, const Context& context) {
  io::Table table{
      "Velocity-pressure flow, one thread: CPU µs an element for residual, tangent, condensation "
      "with scatter, and all three; CPU seconds to factor, for one solve and for a Newton step (an "
      "evaluation, an assembly, a factorisation, solves until refinement stops); the share of all "
      "three in it; how much faster two threads assemble, on the wall",
      {"mesh", "elements", "unknowns (condensed)", "residual", "tangent", "condensation",
       "all three", "factor, s", "solve, s", "step, s", "share, %", "two threads"},
      {}};
  constexpr int repetitions = 5;
  const int around = context.full ? 160 : 24;
  table.rows.push_back(row_of("Q9, inertia, cylinder, " + std::to_string(around) + " around",
                              costs_past_a_cylinder(around, repetitions)));
  std::vector<std::array<int, 3>> boxes = {{1, 20, 28}};
  if (context.full) boxes.insert(boxes.end(), {{1, 70, 100}, {12, 12, 12}});
  for (const auto& box : boxes)
    for (const double inertia : {0.0, 1.0})
      table.rows.push_back(row_of("H27" + std::string(inertia > 0 ? ", inertia, " : ", ") +
                                      std::to_string(box[0]) + "x" + std::to_string(box[1]) + "x" +
                                      std::to_string(box[2]),
                                  costs_of_a_box(box, inertia, repetitions)));
  chapter.table(std::move(table));
}

}  // namespace talus::verification
