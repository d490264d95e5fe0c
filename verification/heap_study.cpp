// The heap's cross-section: mesh error and λr error told apart, work over the angles, Figs 10
// and 11.
#include <algorithm>
#include <cmath>
#include <limits>

#include "twod/section_report.hpp"
#include "verification/chapter.hpp"
#include "verification/fit.hpp"
#include "verification/methods.hpp"

namespace talus::verification {
namespace {

using twod::Section;
using twod::SectionMesh;

constexpr double studied_angle = 0.42;
// Limit of graded meshes and of an augmented-Lagrangian solver, from outside.
constexpr double limit_rate = 82.49, limit_uncertainty = 0.01;

flow::ShearOptions newton(double lambda_r) {
  flow::ShearOptions options = twod::default_options();
  options.method = flow::Method::newton;
  options.lambda_r = lambda_r;
  options.continuation = flow::Continuation::never;
  return options;
}

struct Rate {
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN where the solve fails
  int iterations = 0;
  double seconds = 0;
};

Rate rate(const SectionMesh& mesh, double angle, const flow::ShearOptions& options) {
  Section section;
  section.angle = angle;
  auto space = twod::space_of(section, mesh);
  const auto solution = twod::solve(section, space, options);
  if (!solve::is_success(solution.end)) return {};
  return {twod::flow_rate(solution, space), solution.iterations(), solution.seconds};
}

std::string name_of(const SectionMesh& mesh) {
  return std::to_string(mesh.across) + "x" + std::to_string(mesh.up) +
         (mesh.grading_to_wall > 1 ? " graded" : " uniform");
}

// Mesh error without λr, on uniform and on graded meshes.
void mesh_error(Chapter& chapter, const Context& context) {
  io::Table table{"Q* at α = 0.42 without regularisation",
                  {"mesh", "Q*", "off the limit 82.49", "factorisations", "CPU s"},
                  {}};
  io::Panel panel{"mesh error at α = 0.42, interior point",
                  "1 / elements across",
                  "|Q* - 82.49| / 82.49",
                  true,
                  true,
                  {},
                  std::nullopt,
                  "bottom right"};
  for (const double grading : {1.0, 3.0}) {
    io::Curve curve{grading > 1 ? "graded cubically to wall and surface" : "uniform", {}, {}};
    for (int across : {9, 18, 35, 70}) {
      if (across == 70 && grading > 1 && !context.full) continue;
      const SectionMesh mesh{across, (across * 10 + 6) / 7, grading, grading};
      const Rate found = rate(mesh, studied_angle, twod::default_options());
      table.rows.push_back({name_of(mesh), io::rounded(found.value, 7),
                            io::rounded(found.value - limit_rate, 2),
                            std::to_string(found.iterations), io::rounded(found.seconds, 2)});
      curve.x.push_back(1.0 / across);
      curve.y.push_back(std::abs(found.value - limit_rate) / limit_rate);
      if (across == 35 && grading > 1)
        chapter.check("Q* on 35x50 graded", found.value, limit_rate - limit_uncertainty,
                      limit_rate + limit_uncertainty);
      if (across == 70 && grading == 1)
        chapter.check("Q* on 70x100 uniform", found.value, 82.2992, 82.2994);
    }
    if (grading == 1)
      chapter.check("order of Q* on uniform meshes", fitted_order(curve.x, curve.y), 0.85, 1.15);
    panel.curves.push_back(curve);
  }
  chapter.figure(
      {"heap_mesh",
       "No slip is not attained at the top of the side wall, where the stress reaches "
       "μ2 p: on uniform meshes Q* converges with order 1 only. Grading restores it; its "
       "last points are as uncertain as the limit itself.",
       {panel},
       1});
  chapter.table(std::move(table));
}

// λr error against the interior point on the same mesh.
void lambda_error(Chapter& chapter) {
  const SectionMesh mesh{18, 25};
  const double exact = rate(mesh, studied_angle, twod::default_options()).value;
  io::Panel panel{"λr error at α = 0.42, 18x25",
                  "λr",
                  "Q* / Q*(interior point) - 1",
                  true,
                  true,
                  {},
                  std::nullopt,
                  "bottom right"};
  for (const auto& regularisation : rheology::regularisations()) {
    io::Curve curve{rheology::name_of(regularisation), {}, {}};
    for (const double lambda_r : {1e-3, 1e-4, 1e-5, 1e-6}) {
      flow::ShearOptions options = newton(lambda_r);
      options.regularisation = regularisation;
      options.continuation = flow::Continuation::always;
      curve.x.push_back(lambda_r);
      curve.y.push_back(rate(mesh, studied_angle, options).value / exact - 1);
    }
    if (rheology::name_of(regularisation) == rheology::ChauchatMedale::name)
      chapter.check("order of the λr error of eq. (12)", fitted_order(curve.x, curve.y), 0.95,
                    1.05);
    panel.curves.push_back(curve);
  }
  chapter.figure(
      {"heap_lambda", "What the regularisation adds to Q*, mesh error taken out.", {panel}, 1});
}

// Work from rest over the angles.
void work(Chapter& chapter, const Context& context) {
  io::Panel panel{"from rest", "α", "factorisations", false, false, {}};
  const std::vector<SectionMesh> meshes = {context.full ? SectionMesh{} : SectionMesh{35, 50},
                                           {35, 50, 3, 3}};
  for (const SectionMesh& mesh : meshes)
    for (const bool is_newton : {false, true}) {
      const auto options = is_newton ? newton(1e-5) : twod::default_options();
      io::Curve curve{
          (is_newton ? "Newton, λr 1e-5, " : "interior point, ") + name_of(mesh), {}, {}};
      int failures = 0, most = 0;
      for (double angle = 0.37; angle < 0.505; angle += context.full ? 0.01 : 0.026) {
        const Rate found = rate(mesh, angle, options);
        if (std::isnan(found.value)) {
          ++failures;
          continue;
        }
        most = std::max(most, found.iterations);
        curve.x.push_back(angle);
        curve.y.push_back(found.iterations);
      }
      panel.curves.push_back(curve);
      if (is_newton) {
        chapter.text(curve.label + ", without the fallback: " + std::to_string(failures) +
                     " of the swept angles fail, the others take at most " + std::to_string(most) +
                     " iterations.");
        continue;
      }
      chapter.check(curve.label + ": angles that fail", failures, 0, 0);
      chapter.check(curve.label + ": most factorisations", most, 1, 60);
    }
  chapter.figure({"heap_work", "Factorisations from rest over the inclination.", {panel}, 1});
}

// The paper's three flow rates.
void flow_rates(Chapter& chapter, const Context& context) {
  const SectionMesh mesh = context.full ? SectionMesh{} : SectionMesh{35, 50};
  io::Table table{"The paper's flow rates, eq. (12), λr 1e-5, " + name_of(mesh),
                  {"Q*", "α", "surface velocity", "depth, 1%", "depth, 5%"},
                  {}};
  io::Panel velocity{
      "Fig. 10a: velocity at the surface", "y / d", "u / sqrt(gd)", false, false, {}};
  io::Panel depth{
      "Fig. 10b: depth of the flowing layer (1%)", "y / d", "depth / d", false, false, {}};
  for (const double target : {14.85, 39.71, 88.72}) {
    Section section;
    auto space = twod::space_of(section, mesh);
    const auto solution = twod::solve_for_flow_rate(target, section, space, newton(1e-5));
    const auto surface = twod::surface_profile(solution, space);
    const std::string label = "Q* = " + io::rounded(target, 4);
    velocity.curves.push_back({label, surface.y, surface.velocity, io::Style::line});
    depth.curves.push_back({label, surface.y, surface.depth_1, io::Style::line});
    chapter.check(label + ": relative miss", twod::flow_rate(solution, space) / target - 1, -1e-7,
                  1e-7);
    table.rows.push_back({io::rounded(target, 4), io::rounded(solution.section.angle, 9),
                          io::rounded(surface.velocity.front(), 6),
                          io::rounded(surface.depth_1.front(), 4),
                          io::rounded(surface.depth_5.front(), 4)});
  }
  chapter.figure(
      {"heap_fig10", "The paper's Fig. 10 from the cross-section alone.", {velocity, depth}, 2});
  chapter.table(std::move(table));
}

}  // namespace

Chapter heap_study(const Context& context) {
  Chapter chapter{
      "heap", "What does the heap's cross-section owe to its mesh, and what to λr?", {}, {}};
  chapter.text(
      "The heap as the smallest model that holds it: one scalar problem on half of the section. "
      "The interior point has no λr, so mesh error and λr error are measured, not extrapolated.");
  mesh_error(chapter, context);
  context.progress(0.4);
  lambda_error(chapter);
  context.progress(0.6);
  work(chapter, context);
  context.progress(0.8);
  flow_rates(chapter, context);
  return chapter;
}

}  // namespace talus::verification
