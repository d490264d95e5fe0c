// The same scene in a poorer and a richer model: do they agree, and what does the richer one cost?
#include <cmath>

#include "common/solve/continuation.hpp"
#include "common/solve/stopwatch.hpp"
#include "twod/unidirectional.hpp"
#include "verification/chapter.hpp"
#include "verification/methods.hpp"

namespace talus::verification {
namespace {

// To round-off: a residual of 1e-12 may leave 1e-9 in a velocity where the viscosity vanishes,
// under Bagnold's free surface.
constexpr double tolerance = 1e-14;
constexpr solve::NewtonOptions in_the_plane{.tolerance = tolerance,
                                            .line_search = solve::LineSearch::residual_norm};

struct Rung {
  twod::Departure departure;
  solve::End end_of_line = solve::End::stagnated, end_of_plane = solve::End::stagnated;
  int iterations_of_line = 0, iterations_of_plane = 0;
  double seconds_of_line = 0, seconds_of_plane = 0;
  Eigen::Index unknowns_of_line = 0, unknowns_of_plane = 0, condensed = 0;
  double factor_entries = 0;
  bool continued = false;

  bool solved() const { return solve::is_success(end_of_line) && solve::is_success(end_of_plane); }
};

// Both from rest; a failure in the plane falls back to continuation in λr.
Rung climb(const twod::Unidirectional& flow, const oned::MeshOptions& mesh,
           const rheology::Rheology& rheology) {
  const auto across = oned::boundaries(flow.scene, mesh);
  oned::SolveOptions options;
  options.regularisation = rheology.regularisation;
  options.lambda_r = rheology.lambda_r;
  options.newton.tolerance = tolerance;
  const auto line = oned::solve(flow.scene, across, options);

  const solve::Stopwatch watch;
  const auto space = twod::space_of(flow, across);
  flow::DenseFlow<2> problem(space, rheology, twod::load_of(flow));
  auto state = space.start();
  const auto plane = solve::newton_with_continuation(problem, state, in_the_plane);
  Rung rung;
  rung.seconds_of_plane = watch.seconds();
  rung.seconds_of_line = line.seconds;
  rung.end_of_line = line.end;
  rung.end_of_plane = plane.newton.end;
  rung.iterations_of_line = line.iterations();
  rung.iterations_of_plane = plane.total_iterations();
  rung.continued = !plane.path.empty();
  rung.unknowns_of_line = line.velocity.size();
  rung.unknowns_of_plane = space.size();
  rung.condensed = problem.system().unknowns();
  rung.factor_entries = problem.system().factor_entries();
  rung.departure = twod::departure(flow, space, state, line.velocity);
  return rung;
}

std::string kilobytes(double entries) {
  return io::rounded(entries * sizeof(double) / 1e3, 3);
}

std::string both(const std::string& line, const std::string& plane) {
  return line + " / " + plane;
}

std::vector<std::string> row_of(const oned::ShearScene& scene, const rheology::Rheology& rheology,
                                const oned::MeshOptions& mesh, const Rung& rung) {
  // On a line velocities and fluxes in turn make a tridiagonal system.
  const double entries_of_line = 3 * 2 * static_cast<double>(rung.unknowns_of_line);
  return {
      scene.name,
      rheology::name_of(rheology.regularisation),
      short_power(rheology.lambda_r),
      mesh.grading > 1 ? "graded" : "uniform",
      io::rounded(rung.departure.velocity, 2),
      io::rounded(rung.departure.cross_flow, 2),
      io::rounded(rung.departure.pressure, 2),
      both(std::to_string(rung.unknowns_of_line),
           std::to_string(rung.unknowns_of_plane) + " (" + std::to_string(rung.condensed) + ")"),
      both(std::to_string(rung.iterations_of_line), std::to_string(rung.iterations_of_plane)) +
          (rung.continued ? ", continued" : "") +
          (rung.solved() ? "" : ", " + solve::name_of(rung.end_of_plane)),
      both(io::rounded(1e3 * rung.seconds_of_line, 2), io::rounded(1e3 * rung.seconds_of_plane, 2)),
      both(kilobytes(entries_of_line), kilobytes(rung.factor_entries))};
}

// How far apart the two are where one of them is driven by so much more.
double apart_with_force_times(double factor) {
  const auto flow = twod::in_the_plane(oned::Chute{});
  auto pushed = flow;
  pushed.scene.body_force *= factor;
  const rheology::Rheology rheology{flow.scene.law(), rheology::ChauchatMedale{},
                                    flow.scene.lambda_r};
  const auto across = oned::boundaries(flow.scene, {});
  oned::SolveOptions options;
  options.lambda_r = rheology.lambda_r;
  options.newton.tolerance = tolerance;
  const auto line = oned::solve(pushed.scene, across, options);
  const auto space = twod::space_of(flow, across);
  flow::DenseFlow<2> problem(space, rheology, twod::load_of(flow));
  auto state = space.start();
  solve::newton(problem, state, in_the_plane);
  return twod::departure(flow, space, state, line.velocity).velocity;
}

}  // namespace

Chapter ladder_study(const Context& context) {
  constexpr double target = 1e-10;
  Chapter chapter{
      "ladder", "Does the richer model agree with the poorer, and what does it cost?", {}, {}};
  io::Table table{
      "Each scene on a line (1D) and in the plane (2D, velocity and pressure, two elements along "
      "the stream and the same boundaries across)",
      {"scene", "law", "λr", "mesh", "u apart", "cross-flow", "dynamic pressure",
       "unknowns 1D / 2D (condensed)", "iterations", "CPU ms", "factors, kB"},
      {}};
  const oned::MeshOptions uniform{.elements = context.full ? 160 : 40};
  const oned::MeshOptions graded{.elements = uniform.elements, .grading = 2};
  twod::Departure largest;
  double line_seconds = 0, plane_seconds = 0, line_iterations = 0, plane_iterations = 0;
  int failed = 0, continued = 0;
  for (const auto& flow : {twod::in_the_plane(oned::Chute{}), twod::in_the_plane(oned::Bagnold{})})
    for (const auto& law : rheology::regularisations())
      for (const double lambda_r : {1e-4, 1e-8})
        for (const auto& mesh : {uniform, graded}) {
          const rheology::Rheology rheology{flow.scene.law(), law, lambda_r};
          const Rung rung = climb(flow, mesh, rheology);
          if (!rung.solved()) ++failed;
          if (rung.continued) ++continued;
          largest.velocity = std::fmax(largest.velocity, rung.departure.velocity);
          largest.cross_flow = std::fmax(largest.cross_flow, rung.departure.cross_flow);
          largest.pressure = std::fmax(largest.pressure, rung.departure.pressure);
          line_seconds += rung.seconds_of_line;
          plane_seconds += rung.seconds_of_plane;
          line_iterations += rung.iterations_of_line;
          plane_iterations += rung.iterations_of_plane;
          table.rows.push_back(row_of(flow.scene, rheology, mesh, rung));
        }
  chapter.check("solves that failed", failed, 0, 0);
  chapter.check("velocity: largest distance over largest velocity", largest.velocity, 0, target);
  chapter.check("cross-flow over largest velocity", largest.cross_flow, 0, target);
  chapter.check("dynamic pressure over largest static pressure", largest.pressure, 0, target);
  chapter.check("negative control: velocities apart where one force is larger by 1e-8",
                apart_with_force_times(1 + 1e-8), 10 * target, 1e-6);
  chapter.text(
      "A unidirectional flow solves the equations of velocity and pressure too, without dynamic "
      "pressure or cross-flow, and on the same lines of elements even the discrete solutions are "
      "the same. The two share the law, the quadrature and Newton's method, but neither assembly "
      "nor linear system nor line search. The richer one took " +
      io::fixed(plane_seconds / line_seconds, 0) + " times the CPU time and " +
      io::rounded(plane_iterations / line_iterations, 3) +
      " times the iterations, for it has no energy to search along: from rest its Newton failed "
      "in " +
      std::to_string(continued) +
      " cases, and continuation in λr had to lead there. A scene should be modelled by no more "
      "than it needs.");
  chapter.table(std::move(table));
  return chapter;
}

}  // namespace talus::verification
