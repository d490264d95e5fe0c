// Ways to a solution of the cylinder: starts, and paths in λr and in the loading.
#include <limits>

#include "common/solve/natural_continuation.hpp"
#include "twod/cylinder.hpp"

namespace talus::twod {
namespace {

using State = CylinderFlow::State;

// Smooth enough for Newton from rest; for its primal-dual form, nearly always.
constexpr double smooth_lambda_r = 0.1, primal_dual_lambda_r = 0.01;
// Smooth enough along the loading on fine meshes; some laws can do with the other one.
constexpr double loading_lambda_r = 0.03;
// What only leads on to the next λr needs no more.
constexpr double rough_tolerance = 1e-6;

// A primal-dual step is full; its residual rises before it falls, and is given time for it.
constexpr int most_corrections = 24;
constexpr double beyond_hope = 0.5;

void use_primal_dual(CylinderFlow& cylinder, bool is_wanted) {
  cylinder.flow().set_primal_dual(is_wanted &&
                                  cylinder.scene().tangent == shear::TangentTerm::primal_dual);
}

template <class Problem>
CylinderPath follow(CylinderFlow& cylinder, Problem problem, solve::PathStart<State> start,
                    Continuation continuation, solve::PathOptions options,
                    const CylinderObserver& observe) {
  if (start.parameter == options.target) {  // of this path the start is all
    options.target.reset();
    options.max_points = 1;
    auto path = follow(cylinder, problem, std::move(start), continuation, options, observe);
    if (path.end == solve::PathEnd::out_of_points) path.end = solve::PathEnd::target_reached;
    return path;
  }
  const solve::PathObserver<State> observer = [&](const auto& at, solve::PathPoint& point) {
    return !observe || observe(at, measure(cylinder, at.state), point);
  };
  if (continuation == Continuation::arclength)
    return solve::follow_arclength(problem, std::move(start), options, observer);
  if (continuation == Continuation::natural) {
    solve::PathOptions near = options;  // a step that arrives shows it soon
    near.corrector.stall_iterations = 5;
    near.grows_after_failure = false;
    near.smallest_step = 1e-3;  // what stops it there is a fold, which it cannot pass
    return solve::follow_natural(problem, std::move(start), solve::Predictor::secant, near,
                                 observer);
  }
  // Steps so long that a tangent says nothing about their end, with time to converge.
  solve::PathOptions far = options;
  far.largest_step = 2;
  const int saved =
      options.on_the_way > options.corrector.tolerance ? 1 : 0;  // corrections, by rough points
  far.few_corrections = 8 - saved;
  far.many_corrections = 14 - saved;
  far.corrector.max_iterations = most_corrections;
  far.corrector.hopeless = beyond_hope;
  use_primal_dual(cylinder, true);
  auto path =
      solve::follow_natural(problem, std::move(start), solve::Predictor::constant, far, observer);
  use_primal_dual(cylinder, false);
  return path;
}

// To a start only, judged by its residual.
solve::NewtonSummary newton_at(CylinderFlow& cylinder, double loading, double lambda_r,
                               State& state, double tolerance) {
  cylinder.flow().set_load_factor(loading);
  cylinder.flow().set_lambda_r(lambda_r);
  return solve::newton(cylinder.flow(), state,
                       {.tolerance = tolerance,
                        .distance = std::numeric_limits<double>::infinity(),
                        .max_iterations = 100,
                        .line_search = solve::LineSearch::residual_norm});
}

// Newton from rest at `lambda_r`, or at the scene's if that is larger; the flow keeps it. On the
// way pressures are negative: eq. (16) is needed there even if the scene does without.
solve::NewtonSummary smooth_start(CylinderFlow& cylinder, double loading, double lambda_r,
                                  State& state, double tolerance) {
  rheology::Rheology own = cylinder.flow().rheology();
  own.lambda_r = lambda_r = std::max(lambda_r, cylinder.scene().lambda_r);
  rheology::Rheology regularised = own;
  regularised.regularises_pressure = true;
  cylinder.flow().set_rheology(regularised);
  state = cylinder.space().start();
  auto newton = newton_at(cylinder, loading, lambda_r, state, tolerance);
  cylinder.flow().set_rheology(own);
  if (!own.regularises_pressure && solve::is_success(newton.end))
    newton = newton_at(cylinder, loading, lambda_r, state, tolerance);
  return newton;
}

solve::PathOptions loading_options(const Cylinder& scene, double target,
                                   solve::PathOptions options) {
  options.target = target;
  options.lower = 0;
  // The walls alone carry μ2/half_width; the cylinder adds a little.
  options.upper = 1.2 * scene.law.mu_2() / scene.mesh.half_width;
  options.parameter_scale = 1e-3;  // loadings between which the flow changes its face
  return options;
}

// A state to set out from, and its λr.
struct SmoothStart {
  State state;
  double lambda_r = 0;
  bool succeeded = false;
};

// Newton from rest, with the primal-dual tangent if told to.
SmoothStart start_at(CylinderFlow& cylinder, double loading, double lambda_r, bool is_primal_dual,
                     double tolerance) {
  SmoothStart start;
  use_primal_dual(cylinder, is_primal_dual);
  const auto newton = smooth_start(cylinder, loading, lambda_r, start.state, tolerance);
  use_primal_dual(cylinder, false);
  start.state.stress.clear();  // of another law
  start.lambda_r = cylinder.flow().rheology().lambda_r;
  start.succeeded = solve::is_success(newton.end);
  return start;
}

// In primal-dual form under a floor in eq. (16) that goes in two steps: from rest roughly, by line
// search, then in full steps.
SmoothStart start_under_floors(CylinderFlow& cylinder, double loading, double tolerance) {
  const rheology::Rheology own = cylinder.flow().rheology();
  struct Stage {
    double lambda_r, floor, tolerance;
    solve::LineSearch line_search;
  };
  constexpr double roughest = 1e-3;
  SmoothStart start{.state = cylinder.space().start()};
  cylinder.flow().set_load_factor(loading);
  use_primal_dual(cylinder, true);
  for (const Stage& stage :
       {Stage{loading_lambda_r, 0.1, roughest, solve::LineSearch::residual_norm},
        Stage{primal_dual_lambda_r, 0.03, roughest, solve::LineSearch::none},
        Stage{primal_dual_lambda_r, 0, tolerance, solve::LineSearch::none}}) {
    rheology::Rheology law = own;
    law.lambda_r = start.lambda_r = std::max(stage.lambda_r, cylinder.scene().lambda_r);
    law.pressure_floor = std::max(stage.floor, own.pressure_floor);
    law.regularises_pressure = own.regularises_pressure || stage.floor > 0;
    cylinder.flow().set_rheology(law);
    const auto newton = solve::newton(cylinder.flow(), start.state,
                                      {.tolerance = std::max(stage.tolerance, tolerance),
                                       .distance = std::numeric_limits<double>::infinity(),
                                       .max_iterations = most_corrections,
                                       .hopeless = beyond_hope,
                                       .line_search = stage.line_search});
    start.state.stress.clear();  // of this stage's law
    start.succeeded = solve::is_success(newton.end);
    if (!start.succeeded) break;
  }
  use_primal_dual(cylinder, false);
  rheology::Rheology law = own;
  law.lambda_r = start.lambda_r;
  cylinder.flow().set_rheology(law);
  return start;
}

// From rest at a loading that the cylinder holds, then along the loading.
SmoothStart start_along_loading(CylinderFlow& cylinder, double loading, double lambda_r,
                                const solve::PathOptions& options) {
  const double held = held_loading(cylinder.scene());
  SmoothStart start = start_at(cylinder, held, lambda_r, true, options.corrector.tolerance);
  if (!start.succeeded) return start;
  auto along = loading_options(cylinder.scene(), loading, options);
  along.smallest_step = 0.02;  // rather set out from another λr than creep
  along.max_points = 100;
  auto path = follow(cylinder, mixed::LoadPath<2>(cylinder.flow()),
                     {.state = std::move(start.state), .parameter = held, .step = 1},
                     Continuation::primal_dual, along, {});
  return {std::move(path.next.state), start.lambda_r, path.end == solve::PathEnd::target_reached};
}

// What each way to follow a path prefers; then whatever starts.
SmoothStart start_from_rest(CylinderFlow& cylinder, double loading, Continuation continuation,
                            const solve::PathOptions& options) {
  const bool is_primal_dual = continuation == Continuation::primal_dual;
  const double preferred = is_primal_dual ? primal_dual_lambda_r : smooth_lambda_r;
  if (is_primal_dual) {
    auto start = start_under_floors(cylinder, loading, options.corrector.tolerance);
    if (start.succeeded) return start;
  }
  const SmoothStart from_rest =
      start_at(cylinder, loading, preferred, is_primal_dual, options.corrector.tolerance);
  if (from_rest.succeeded) return from_rest;
  if (loading > held_loading(cylinder.scene()))
    for (const double lambda_r : is_primal_dual
                                     ? std::vector{primal_dual_lambda_r, loading_lambda_r}
                                     : std::vector{loading_lambda_r}) {
      auto along = start_along_loading(cylinder, loading, lambda_r, options);
      if (along.succeeded) return along;
    }
  return is_primal_dual
             ? start_at(cylinder, loading, smooth_lambda_r, true, options.corrector.tolerance)
             : from_rest;
}

}  // namespace

std::string name_of(Continuation continuation) {
  switch (continuation) {
    case Continuation::arclength:
      return "arclength";
    case Continuation::natural:
      return "natural";
    case Continuation::primal_dual:
      return "primal-dual";
  }
  return {};
}

double held_loading(const Cylinder& scene) {
  return 1.1 * scene.law.mu_s / scene.mesh.half_width;
}

bool may_creep(const Cylinder& scene, double loading) {
  // At yield the walls carry μs p_ext times their length, and the cylinder about 13.4 μs p_ext D
  // (docs/cylinder.md: it yields at F = 0.0489 by default).
  constexpr double cylinder_share = 13.4;
  const double length = scene.mesh.half_height + scene.mesh.outlet;
  const double yield = scene.law.mu_s / scene.mesh.half_width * (1 + cylinder_share / (2 * length));
  const bool is_soft =
      scene.penalty.kind == mixed::Penalty::plain && scene.penalty.lambda_p > scene.lambda_r;
  const bool is_open = scene.open_outlet != mixed::Open::no;  // several flows: a path tells which
  return rheology::has_yield_stress(scene.regularisation) && !is_soft && !is_open &&
         loading <= yield;
}

solve::PathOptions cylinder_path_options() {
  solve::PathOptions options;
  options.corrector.tolerance = 1e-9;
  options.few_corrections = 4;
  options.growth = 2;
  options.largest_step = 1;
  options.max_points = 400;
  return options;
}

CylinderPath solve_from_rest(CylinderFlow& cylinder, double loading, Continuation continuation,
                             const solve::PathOptions& options, const CylinderObserver& observe) {
  SmoothStart start = start_from_rest(cylinder, loading, continuation, options);
  return follow_lambda_r(cylinder, loading,
                         {.state = std::move(start.state),
                          .parameter = std::log10(start.lambda_r),
                          .direction = -1,
                          .step = continuation == Continuation::primal_dual ? 1 : 0.2},
                         continuation, options, observe);
}

mixed::CreepSummary creep_to(CylinderFlow& cylinder, double loading, double loading_before,
                             State& state, const solve::NewtonOptions& options) {
  cylinder.flow().set_lambda_r(cylinder.scene().lambda_r);
  return mixed::creep_to_load(cylinder.flow(), loading, loading_before, state, options,
                              cylinder.scene().tangent == shear::TangentTerm::primal_dual);
}

solve::NewtonSummary solve_creep(CylinderFlow& cylinder, double loading, State& state) {
  return creep_to(cylinder, loading, 0, state).newton;
}

CylinderPath follow_lambda_r(CylinderFlow& cylinder, double loading, solve::PathStart<State> start,
                             Continuation continuation, solve::PathOptions options,
                             const CylinderObserver& observe) {
  cylinder.flow().set_load_factor(loading);
  options.target = std::log10(cylinder.scene().lambda_r);
  options.upper = 1;  // λr = 10: a path that climbs there has turned back for good
  if (continuation == Continuation::primal_dual) options.on_the_way = rough_tolerance;
  return follow(cylinder, mixed::RegularisationPath<2>(cylinder.flow()), std::move(start),
                continuation, options, observe);
}

CylinderPath follow_loading(CylinderFlow& cylinder, solve::PathStart<State> start, double target,
                            Continuation continuation, const solve::PathOptions& options,
                            const CylinderObserver& observe) {
  cylinder.flow().set_lambda_r(cylinder.scene().lambda_r);
  return follow(cylinder, mixed::LoadPath<2>(cylinder.flow()), std::move(start), continuation,
                loading_options(cylinder.scene(), target, options), observe);
}

}  // namespace talus::twod
