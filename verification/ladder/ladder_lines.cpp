// Rungs of the ladder: chute and inclined plane on a line, in the plane, in space.
#include "threed/unidirectional_solve.hpp"
#include "verification/harness/methods.hpp"
#include "verification/ladder/ladder.hpp"

namespace talus::verification {
namespace {

// To round-off: a residual of 1e-12 may leave 1e-9 in a velocity where the viscosity vanishes,
// under Bagnold's free surface.
constexpr double tolerance = 1e-14;

threed::UnidirectionalOptions options_of(const rheology::Rheology& rheology) {
  threed::UnidirectionalOptions options;
  options.regularisation = rheology.regularisation;
  options.lambda_r = rheology.lambda_r;
  options.newton.tolerance = tolerance;
  return options;
}

// `driven` is the richer one's scene.
template <int Dim>
RungCase climb(const oned::ShearScene& scene, const oned::ShearScene& driven,
               const oned::MeshOptions& mesh, const rheology::Rheology& rheology) {
  const auto across = oned::boundaries(scene, mesh);
  const auto options = options_of(rheology);
  const auto line = oned::solve(scene, across, options);
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

  const auto solved = threed::solve_unidirectional<Dim>(driven, across, options);
  rung.richer = {solved.line.end,
                 solved.line.iterations(),
                 !solved.line.newton.path.empty(),
                 solved.unknowns,
                 solved.condensed,
                 solved.line.seconds,
                 sizeof(double) * solved.factor_entries};
  rung.apart = threed::departure(scene, *solved.space, solved.state, line.velocity);
  return rung;
}

template <int Dim>
Rung rung_of(const oned::ShearScene& scene, int elements) {
  Rung rung{scene.title, "the line", Dim == 2 ? "the plane" : "space", 1e-10, {}};
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
  pushed.body_force = [&](double x) { return factor * scene.body_force(x); };
  const rheology::Rheology rheology{scene.law(), rheology::ChauchatMedale{}, scene.lambda_r};
  return climb<3>(scene, pushed, {}, rheology).apart.velocity;
}

}  // namespace talus::verification
