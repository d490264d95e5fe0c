// Rungs of the ladder: the cylinder in the plane and as one layer of H27 elements.
#include "common/solve/continuation.hpp"
#include "common/solve/stopwatch.hpp"
#include "threed/cylinder_layer.hpp"
#include "verification/harness/methods.hpp"
#include "verification/ladder/ladder.hpp"

namespace talus::verification {
namespace {

constexpr solve::NewtonOptions newton_options{.tolerance = 1e-14,
                                              .line_search = solve::LineSearch::residual_norm};

twod::Cylinder scene_around(int around) {
  twod::Cylinder scene;
  scene.mesh = twod::refined_to(around);
  return scene;
}

std::string case_name(const twod::Cylinder& scene, double loading, const std::string& way) {
  return rheology::name_of(scene.regularisation) + ", F = " + io::rounded(loading) + ", " +
         std::to_string(scene.mesh.around) + " around, " + way;
}

template <int Dim>
ModelCost cost_of(const mixed::MixedFlow<Dim>& flow, const solve::ContinuationSummary& solved,
                  double seconds) {
  return {solved.newton.end,
          solved.total_iterations(),
          false,
          flow.space().size(),
          flow.system().unknowns(),
          seconds,
          sizeof(double) * flow.system().factor_entries()};
}

// The plane's solution in the layer, pushed off a little, along the axis too.
mixed::MixedSpace<3>::State pushed_off(const mixed::MixedSpace<2>& plane,
                                       const solve::CompensatedVector& state,
                                       const mixed::MixedSpace<3>& space) {
  constexpr double push = 1e-5;
  auto pushed = mixed::extruded_state(plane, state, space);
  for (Eigen::Index node = 0; 3 * node < space.velocity_count(); ++node) {
    const double down = pushed.value()[space.velocity_index(node, 1)];
    pushed.set(space.velocity_index(node, 1), (1 + push) * down);
    if (!space.is_fixed(space.velocity_index(node, 2)))
      pushed.set(space.velocity_index(node, 2), push * down);
  }
  return pushed;
}

// Below yield, both from rest down in λr.
RungCase creep(const twod::Cylinder& scene, double loading) {
  RungCase rung{case_name(scene, loading, "from rest down in λr"), {}, {}, {}};
  const solve::ContinuationOptions down{.first = 0.1, .tolerance_on_the_way = 1e-6};
  solve::Stopwatch of_plane;
  twod::CylinderFlow plane(scene);
  plane.flow().set_load_factor(loading);
  auto plane_state = plane.space().start();
  const auto in_plane = solve::newton_along_path(plane.flow(), plane_state, newton_options, down);
  rung.poorer = cost_of(plane.flow(), in_plane, of_plane.seconds());

  solve::Stopwatch of_layer;
  threed::CylinderLayer layer(plane);
  auto state = layer.space().start();
  const auto in_layer = solve::newton_along_path(layer.flow(), state, newton_options, down);
  rung.richer = cost_of(layer.flow(), in_layer, of_layer.seconds());
  rung.apart = mixed::departure_from_plane(plane.space(), plane_state, layer.space(), state);
  return rung;
}

// Above yield: the plane along its path, the layer from near its solution, under a loading so many
// times larger.
RungCase beyond_yield(twod::Cylinder scene, double loading, double push = 1) {
  scene.regularisation = rheology::BarkerGray{};
  RungCase rung{case_name(scene, loading, "layer from near the plane's"), {}, {}, {}, false};
  solve::Stopwatch of_plane;
  twod::CylinderFlow plane(scene);
  auto path = twod::solve_from_rest(plane, loading);
  auto& plane_state = path.next.state;
  solve::ContinuationSummary in_plane;
  in_plane.newton = solve::newton(plane.flow(), plane_state, newton_options);
  rung.poorer = cost_of(plane.flow(), in_plane, of_plane.seconds());
  rung.poorer.iterations = plane.flow().factorisations();
  if (path.end != solve::PathEnd::target_reached) rung.poorer.end = solve::End::stagnated;

  solve::Stopwatch of_layer;
  threed::CylinderLayer layer(plane);
  layer.flow().set_load_factor(push * loading);
  auto state = pushed_off(plane.space(), plane_state, layer.space());
  solve::ContinuationSummary in_layer;
  in_layer.newton = solve::newton(layer.flow(), state, newton_options);
  rung.richer = cost_of(layer.flow(), in_layer, of_layer.seconds());
  rung.apart = mixed::departure_from_plane(plane.space(), plane_state, layer.space(), state);
  return rung;
}

}  // namespace

std::vector<Rung> cylinder_rungs(const Context& context) {
  const std::vector<int> arounds = context.full ? std::vector{16, 40} : std::vector{16};
  Rung rung{"cylinder", "the plane", "one layer of H27", 1e-9, {}};
  for (const int around : arounds) {
    for (const double loading : context.full ? std::vector{0.02, 0.04} : std::vector{0.02})
      rung.cases.push_back(creep(scene_around(around), loading));
    rung.cases.push_back(beyond_yield(scene_around(around), 0.052));
  }
  return {rung};
}

double cylinder_apart_with_force_times(double factor) {
  return beyond_yield(scene_around(16), 0.052, factor).apart.velocity;
}

}  // namespace talus::verification
