// Rungs of the ladder: chute and inclined plane on a line, in the plane, in space.
#include "common/solve/continuation.hpp"
#include "common/solve/stopwatch.hpp"
#include "threed/unidirectional.hpp"
#include "verification/ladder.hpp"
#include "verification/methods.hpp"

namespace talus::verification {
namespace {

// To round-off: a residual of 1e-12 may leave 1e-9 in a velocity where the viscosity vanishes,
// under Bagnold's free surface.
constexpr double tolerance = 1e-14;

oned::Solution on_a_line(const oned::ShearScene& scene, const std::vector<double>& across,
                         const rheology::Rheology& rheology) {
  oned::SolveOptions options;
  options.regularisation = rheology.regularisation;
  options.lambda_r = rheology.lambda_r;
  options.newton.tolerance = tolerance;
  return oned::solve(scene, across, options);
}

// From rest in full steps: there is no energy to search along, and a search along the norm of the
// residual gives up in plugs where full steps arrive. If they fail, continuation in λr, searching.
template <int Dim>
solve::ContinuationSummary solve_from_rest(flow::DenseFlow<Dim>& problem,
                                           solve::CompensatedVector& state) {
  const solve::NewtonOptions full_steps{.tolerance = tolerance,
                                        .line_search = solve::LineSearch::none};
  const solve::CompensatedVector rest = state;
  solve::ContinuationSummary direct{solve::newton(problem, state, full_steps), {}};
  if (solve::is_success(direct.newton.end)) return direct;
  state = rest;
  solve::NewtonOptions searching = full_steps;
  searching.line_search = solve::LineSearch::residual_norm;
  auto summary = solve::newton_along_path(problem, state, searching);
  summary.path.insert(summary.path.begin(),
                      {problem.rheology().lambda_r, direct.newton.end, direct.newton.iterations()});
  return summary;
}

// `driven` is the richer one's scene.
template <int Dim>
RungCase climb(const oned::ShearScene& scene, const oned::ShearScene& driven,
               const oned::MeshOptions& mesh, const rheology::Rheology& rheology) {
  const auto across = oned::boundaries(scene, mesh);
  const auto line = on_a_line(scene, across, rheology);
  RungCase rung{rheology::name_of(rheology.regularisation) + ", λr = " +
                    short_power(rheology.lambda_r) + (mesh.grading > 1 ? ", graded" : ", uniform"),
                {},
                {},
                {}};
  // On a line velocities and fluxes in turn make a tridiagonal system.
  rung.poorer = {line.end,
                 line.iterations(),
                 line.newton.path.size() > 1,
                 line.velocity.size(),
                 line.velocity.size(),
                 line.seconds,
                 3 * 2 * sizeof(double) * static_cast<double>(line.velocity.size())};

  const solve::Stopwatch watch;
  const auto space = threed::space_of<Dim>(scene, across, {.along = Dim == 2 ? 2 : 1});
  flow::DenseFlow<Dim> problem(space, rheology, threed::load_of<Dim>(driven));
  auto state = space.start();
  const auto solved = solve_from_rest(problem, state);
  rung.richer = {solved.newton.end,
                 solved.total_iterations(),
                 !solved.path.empty(),
                 space.size(),
                 problem.system().unknowns(),
                 watch.seconds(),
                 sizeof(double) * problem.system().factor_entries()};
  rung.apart = threed::departure(scene, space, state, line.velocity);
  return rung;
}

template <int Dim>
Rung rung_of(const oned::ShearScene& scene, int elements) {
  Rung rung{scene.title, "1D", std::to_string(Dim) + "D", 1e-10, {}};
  for (const auto& law : rheology::regularisations())
    for (const double lambda_r : {1e-4, 1e-8})
      for (const double grading : {1.0, 2.0})
        rung.cases.push_back(climb<Dim>(scene, scene, {.elements = elements, .grading = grading},
                                        {scene.law(), law, lambda_r}));
  return rung;
}

}  // namespace

std::vector<Rung> line_rungs(const Context& context) {
  const int elements = context.full ? 160 : 40;
  std::vector<Rung> rungs;
  for (const auto& scene : oned::scenes()) {
    rungs.push_back(rung_of<2>(scene, elements));
    rungs.push_back(rung_of<3>(scene, elements));
  }
  return rungs;
}

double lines_apart_with_force_times(double factor) {
  const auto scene = scene_of(oned::Chute{});
  oned::ShearScene pushed = scene;
  pushed.body_force *= factor;
  const rheology::Rheology rheology{scene.law(), rheology::ChauchatMedale{}, scene.lambda_r};
  return climb<3>(scene, pushed, {}, rheology).apart.velocity;
}

}  // namespace talus::verification
