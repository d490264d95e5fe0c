#include "verification/cylinder/cylinder_runs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/solve/stopwatch.hpp"
#include "verification/harness/methods.hpp"

namespace talus::verification {
namespace {

constexpr double creeping = 0.044;

// Of a flow that was not found.
twod::CylinderMeasures not_measured() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan, nan};
}

twod::CylinderObserver recorder(Followed& followed) {
  return [&followed](const auto&, const auto& measures, const auto& point) {
    followed.measures.push_back(measures);
    followed.points.push_back(point);
    return true;
  };
}

solve::PathOptions path_options(int max_points) {
  auto options = twod::cylinder_path_options();
  options.max_points = max_points;
  return options;
}

// Solves a loading from rest down to round-off: as creep if that is tried, and where it fails along
// a path in λr.
bool reach(twod::CylinderFlow& cylinder, double loading, twod::CylinderFlow::State& state,
           bool tries_creep, twod::Continuation continuation) {
  if (tries_creep && solve::is_success(twod::solve_creep(cylinder, loading, state).end))
    return true;
  const auto path = twod::solve_from_rest(cylinder, loading, continuation);
  state = path.next.state;
  state.stress.clear();  // the path's own
  const solve::NewtonOptions options{.tolerance = 1e-13,
                                     .line_search = solve::LineSearch::residual_norm};
  return path.end == solve::PathEnd::target_reached &&
         solve::is_success(solve::newton(cylinder.flow(), state, options).end);
}

}  // namespace

twod::Cylinder cylinder_around(int around, const rheology::Regularisation& law) {
  twod::Cylinder scene;
  scene.mesh = twod::refined_to(around);
  scene.regularisation = law;
  return scene;
}

std::vector<rheology::Regularisation> laws_of_paths() {
  std::vector<rheology::Regularisation> laws = {rheology::ChauchatMedale{}};
  for (const auto& law : rheology::regularisations())
    if (!rheology::has_yield_stress(law)) laws.push_back(law);
  return laws;
}

Creep creep_at(const twod::Cylinder& scene, double loading) {
  const solve::Stopwatch watch;
  twod::CylinderFlow cylinder(scene);
  twod::CylinderFlow::State state;
  // With an open outlet there are several flows: the one that arclength leads to is compared.
  const bool is_open = scene.open_outlet != mixed::Open::no;
  const bool is_reached =
      reach(cylinder, loading, state, !is_open,
            is_open ? twod::Continuation::arclength : twod::Continuation::primal_dual);
  Creep creep;
  creep.factorisations = cylinder.flow().factorisations();
  creep.seconds = watch.seconds();
  creep.elements = cylinder.space().element_count();
  creep.measures = is_reached ? twod::measure(cylinder, state) : not_measured();
  return creep;
}

std::size_t Flows::index_of(double loading) const {
  for (std::size_t i = 0; i < measures.size(); ++i)
    if (measures[i].loading == loading) return i;
  throw std::out_of_range("no flow at F = " + std::to_string(loading));
}

Flows flows_at(const twod::Cylinder& scene, const std::vector<double>& loadings,
               const std::function<void(double)>& progress) {
  Flows flows{std::make_unique<twod::CylinderFlow>(scene), {}, {}, 0};
  twod::CylinderFlow& cylinder = *flows.cylinder;
  for (const double loading : loadings) {
    twod::CylinderFlow::State& state = flows.states.emplace_back();
    const bool is_reached = reach(cylinder, loading, state, twod::may_creep(scene, loading),
                                  twod::Continuation::primal_dual);
    if (!is_reached) state = {};
    flows.measures.push_back(is_reached ? twod::measure(cylinder, state) : not_measured());
    flows.measures.back().loading = loading;
    progress(static_cast<double>(flows.states.size()) / static_cast<double>(loadings.size()));
  }
  flows.factorisations = cylinder.flow().factorisations();
  return flows;
}

twod::CylinderMeasures Followed::last() const {
  return measures.empty() ? not_measured() : measures.back();
}

int Followed::folds() const {
  return static_cast<int>(
      std::ranges::count_if(points, [](const auto& point) { return point.is_fold_passed; }));
}

double Followed::largest_loading() const {
  double largest = if_counts(!measures.empty(), 0);
  for (const auto& m : measures) largest = solve::nan_max(largest, m.loading);
  return largest;
}

double Followed::smallest_lambda_r() const {
  double smallest = if_counts(!measures.empty(), 1);
  for (const auto& m : measures) smallest = solve::nan_min(smallest, m.lambda_r);
  return smallest;
}

Followed along_loading(const twod::Cylinder& scene, double target, twod::Continuation continuation,
                       int max_points) {
  const solve::Stopwatch watch;
  twod::CylinderFlow cylinder(scene);
  auto start = twod::solve_from_rest(cylinder, creeping);
  Followed followed;
  if (start.end != solve::PathEnd::target_reached) return followed;
  followed.end =
      twod::follow_loading(cylinder, {.state = start.next.state, .parameter = creeping}, target,
                           continuation, path_options(max_points), recorder(followed))
          .end;
  followed.factorisations = cylinder.flow().factorisations();
  followed.seconds = watch.seconds();
  return followed;
}

Followed along_lambda_r(const twod::Cylinder& scene, double loading,
                        twod::Continuation continuation, int max_points) {
  const solve::Stopwatch watch;
  twod::CylinderFlow cylinder(scene);
  Followed followed;
  followed.end = twod::solve_from_rest(cylinder, loading, continuation, path_options(max_points),
                                       recorder(followed))
                     .end;
  followed.factorisations = cylinder.flow().factorisations();
  followed.seconds = watch.seconds();
  return followed;
}

}  // namespace talus::verification
