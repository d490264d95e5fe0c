#include "threed/heap_solve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "common/mixed/extrusion.hpp"
#include "common/solve/stopwatch.hpp"
#include "twod/section_nested.hpp"

namespace talus::threed {
namespace {

using State = HeapFlow::State;

// From rest.
constexpr solve::ContinuationOptions way_down{.first = 1e-2, .tolerance_on_the_way = 1e-2};

// The velocities of a state on another mesh; dynamic pressures start from zero.
State interpolated(const HeapFlow& from, const State& state, const HeapFlow& to) {
  State result = to.space().start();
  const auto& nodes = to.space().mesh().nodes;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const auto velocity = from.point_at(state, nodes[node]).values.velocity;
    for (int i = 0; i < 3; ++i) {
      const auto index = to.space().velocity_index(static_cast<Eigen::Index>(node), i);
      if (!to.space().is_fixed(index)) result.set(index, velocity[i]);
    }
  }
  return result;
}

mixed::MixedFlow<3>::StressField stress_field(const HeapFlow& flow, const State& state) {
  return [&](const fem::Point<3>& position) -> Eigen::Matrix3d {
    const mixed::FlowPoint<3> at = flow.point_at(state, position);
    const Eigen::Matrix3d& gradient = at.values.velocity_gradient;
    return at.law.viscosity * (gradient + gradient.transpose());
  };
}

// On one mesh, from a solution on a coarser one; without one, or where it leads nowhere, from rest.
solve::ContinuationSummary solve_on(HeapFlow& heap, State& state, const HeapOptions& options,
                                    const HeapFlow* coarse, const State& coarse_state) {
  std::vector<solve::ContinuationStep> tried;
  mixed::set_tangent(heap.flow(), options.tangent);
  if (coarse) {
    state = interpolated(*coarse, coarse_state, heap);
    if (heap.flow().is_primal_dual())
      state.stress = heap.flow().stress_of(stress_field(*coarse, coarse_state));
    solve::NewtonSummary newton = solve::newton(heap.flow(), state, options.newton);
    if (is_success(newton.end) || !options.comes_down) return {std::move(newton), {}};
    tried.push_back({heap.heap().lambda_r, newton.end, newton.iterations()});
  }
  state = heap.space().start();
  if (!options.comes_down) return {solve::newton(heap.flow(), state, options.newton), {}};
  auto summary = solve::newton_along_path(heap.flow(), state, options.newton, way_down);
  summary.path.insert(summary.path.begin(), tried.begin(), tried.end());
  return summary;
}

MeshCost cost_of(const HeapFlow& heap, const solve::ContinuationSummary& newton, double seconds) {
  const auto& system = heap.flow().system();
  return {heap.mesh(),
          newton.newton.end,
          newton.total_iterations(),
          heap.flow().factorisations(),
          heap.space().size(),
          system.unknowns(),
          system.factor_entries(),
          seconds};
}

// The nodes at half the length, and the points of the section there.
twod::SectionSolution middle_of(const HeapFlow& heap, const State& state) {
  const auto& space = heap.space();
  const int along = heap.mesh().along;
  const auto nodes_along = static_cast<Eigen::Index>(2 * along + 1);
  const Eigen::Index nodes = static_cast<Eigen::Index>(space.mesh().nodes.size()) / nodes_along;
  twod::SectionSolution middle;
  middle.section = heap.heap().section;
  Eigen::VectorXd value(nodes), correction(nodes);
  for (Eigen::Index node = 0; node < nodes; ++node) {
    const auto index = space.velocity_index(node * nodes_along + along, 0);
    value[node] = state.value()[index];
    correction[node] = state.correction()[index];
  }
  middle.velocity = solve::CompensatedVector(std::move(value), std::move(correction));
  const double reference = along % 2 ? 0 : -1;
  for (auto e = static_cast<std::size_t>(along / 2); e < space.element_count();
       e += static_cast<std::size_t>(along))
    for (const auto& point : fem::gauss_rule<2>(3)) {
      const mixed::FlowPoint<3> at =
          heap.point_at(state, e, {reference, point.position[0], point.position[1]});
      middle.shear_rate.push_back(at.law.shear_rate);
      middle.stress.push_back(at.law.stress());
    }
  return middle;
}

struct Stage {
  Heap heap;
  HeapMesh mesh;
  solve::NewtonOptions newton;
};

// The problem and, if it is nested, what leads to it: a developed outlet before an open one,
// through which Newton from rest finds no flow, and ever coarser meshes, the coarsest first.
std::vector<Stage> stages(const Heap& heap, const HeapMesh& mesh, const HeapOptions& options) {
  std::vector<Stage> all{{heap, mesh, options.newton}};
  if (options.start != Start::nested) return all;
  if (heap.open_outlet != mixed::Open::no) {
    all.push_back(all.back());
    all.back().heap.open_outlet = mixed::Open::no;
  }
  while (const auto coarse = coarsened(heap, all.back().mesh)) {
    Stage stage = all.back();
    stage.mesh = *coarse;
    stage.heap.lambda_r = twod::CoarserMesh::lambda_r_for(stage.heap.lambda_r);
    stage.newton.tolerance = std::max(twod::CoarserMesh::tolerance, options.newton.tolerance);
    stage.newton.distance = std::numeric_limits<double>::infinity();
    all.push_back(stage);
  }
  std::ranges::reverse(all);
  return all;
}

}  // namespace

shear::ShearOptions section_options(const Heap& heap, const HeapOptions& options) {
  shear::ShearOptions section = twod::newton_options(heap.lambda_r);
  section.regularisation = heap.regularisation;
  section.newton.tolerance = options.newton.tolerance;
  section.newton.distance = options.newton.distance;
  return section;
}

HeapSolution solve(const Heap& heap, const HeapMesh& mesh, const HeapOptions& options,
                   const twod::SectionSolution* section) {
  assert(section || options.start != Start::section);
  const solve::Stopwatch watch;
  HeapSolution solution;
  solve::ContinuationSummary newton;
  for (const Stage& stage : stages(heap, mesh, options)) {
    const solve::Stopwatch watch_of_mesh;
    auto flow = std::make_unique<HeapFlow>(stage.heap, stage.mesh);
    State state;
    if (options.start == Start::section) {
      state = mixed::extruded(flow->space(), section->velocity);
      mixed::set_tangent(flow->flow(), options.tangent);
      newton = {solve::newton(flow->flow(), state, options.newton), {}};
    } else {
      const bool has_coarser = !solution.meshes.empty() && is_success(solution.meshes.back().end);
      HeapOptions here = options;
      here.newton = stage.newton;
      newton =
          solve_on(*flow, state, here, has_coarser ? solution.flow.get() : nullptr, solution.state);
    }
    newton.lambda_r = flow->flow().rheology().lambda_r;
    solution.flow = std::move(flow);
    solution.state = std::move(state);
    solution.meshes.push_back(cost_of(*solution.flow, newton, watch_of_mesh.seconds()));
  }
  solution.middle = middle_of(*solution.flow, solution.state);
  solution.middle.end = newton.newton.end;
  solution.middle.newton = std::move(newton);
  const mixed::Departure departure =
      mixed::departure(solution.flow->space(), solution.state, solution.middle.velocity, 1);
  const double largest = solution.middle.velocity.value().lpNorm<Eigen::Infinity>();
  solution.cross_flow = departure.cross_flow * largest;
  solution.dynamic_pressure = departure.pressure;
  solution.change_along = departure.velocity;
  solution.middle.seconds = watch.seconds();
  return solution;
}

}  // namespace talus::threed
