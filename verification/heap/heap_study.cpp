// The heap's cross-section: mesh error and λr error told apart, work over the angles.
#include "verification/heap/heap_study.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "twod/section_report.hpp"
#include "verification/harness/fit.hpp"
#include "verification/harness/methods.hpp"
#include "verification/references/references.hpp"

namespace talus::verification {
namespace {

using twod::Section;
using twod::SectionMesh;

constexpr double studied_angle = 0.42;
constexpr double limit_rate = references::heap_flow_rate_limit.value;

struct Rate {
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN where the solve fails
  double iterations = value;
  double seconds = 0;
};

Rate rate(const Section& section, const SectionMesh& mesh, const shear::ShearOptions& options) {
  auto space = twod::space_of(section, mesh);
  const auto solution = twod::solve(section, space, options);
  if (!solve::is_success(solution.end)) return {};
  return {twod::flow_rate(solution, space), static_cast<double>(solution.iterations()),
          solution.seconds};
}

Section at(double angle) {
  Section section;
  section.angle = angle;
  return section;
}

std::string name_of(const SectionMesh& mesh) {
  return std::to_string(mesh.across) + "x" + std::to_string(mesh.up) +
         (mesh.grading_to_wall > 1 ? " graded" : " uniform");
}

// A family of meshes, the wall on it, and the order of Q* expected on a uniform one.
struct Family {
  std::string label;
  double grading;
  twod::Wall wall;
  double lowest_order = 0, highest_order = 0;
};

// λr error against the interior point on the same mesh.
void lambda_error(Chapter& chapter) {
  const SectionMesh mesh{18, 25};
  const double exact = rate(at(studied_angle), mesh, twod::default_options()).value;
  io::Panel panel{
      "λr error at α = 0.42, 18x25", "λr", "Q* / Q*(interior point) - 1", true, true, {}};
  for (const auto& regularisation : rheology::regularisations()) {
    // A law without yield stress tends to another Q*: its difference is no error in λr.
    if (!rheology::has_yield_stress(regularisation)) continue;
    io::Curve curve{rheology::name_of(regularisation), {}, {}};
    for (const double lambda_r : {1e-3, 1e-4, 1e-5, 1e-6}) {
      shear::ShearOptions options = twod::newton_options(lambda_r);
      options.regularisation = regularisation;
      curve.x.push_back(lambda_r);
      curve.y.push_back(rate(at(studied_angle), mesh, options).value / exact - 1);
    }
    if (rheology::name_of(regularisation) == rheology::ChauchatMedale::name)
      chapter.check(Kind::self_consistency, "order of the λr error of eq. (12)",
                    fitted_order(curve.x, curve.y), 0.95, 1.05);
    panel.curves.push_back(curve);
  }
  chapter.figure(
      {"heap_lambda",
       "What the regularisation adds to Q* of the heap's section at α = 0.42 on 18x25 elements, "
       "mesh error taken out; laws that tend to eq. (4).",
       {panel},
       1});
}

// Work from rest over the angles.
void work(Chapter& chapter, const Context& context) {
  io::Figure figure{"heap_work",
                    "Factorisations from rest over the inclination of the heap: its section on the "
                    "meshes of the titles, by the interior point and by Newton under eq. (12).",
                    {},
                    2};
  struct Way {
    std::string label;
    shear::ShearOptions options;
    int most;  // factorisations allowed
  };
  const std::vector<Way> ways = {{"interior point", twod::default_options(), 60},
                                 {"Newton, λr 1e-5", twod::newton_options(1e-5), 30},
                                 {"Newton, λr 1e-8", twod::newton_options(1e-8), 60}};
  const std::vector<SectionMesh> meshes = {context.full ? SectionMesh{} : SectionMesh{28, 40},
                                           {28, 40, 3, 3}};
  for (const SectionMesh& mesh : meshes) {
    io::Panel panel{name_of(mesh), "α, rad", "factorisations", false, false, {}};
    for (const Way& way : ways) {
      io::Curve curve{way.label, {}, {}};
      int failures = 0;
      double most = 0;
      for (double angle = 0.37; angle < 0.505; angle += context.full ? 0.01 : 0.026) {
        const Rate found = rate(at(angle), mesh, way.options);
        failures += std::isnan(found.value) ? 1 : 0;
        most = solve::nan_max(most, found.iterations);
        curve.x.push_back(angle);
        curve.y.push_back(found.iterations);
      }
      panel.curves.push_back(curve);
      const std::string label = way.label + ", " + name_of(mesh);
      chapter.check(Kind::self_consistency, label + ": angles that fail", failures, 0, 0);
      chapter.check(Kind::self_consistency, label + ": most factorisations", most, 1, way.most);
    }
    figure.panels.push_back(panel);
  }
  chapter.figure(figure);
}

// For the front page.
void show_flow(Chapter& chapter) {
  const SectionMesh mesh{28, 40};
  const Section section = at(studied_angle);
  auto space = twod::space_of(section, mesh);
  const auto solution = twod::solve(section, space, twod::default_options());
  if (!solve::is_success(solution.end)) return;  // the checks of others fail then
  const auto surface = twod::surface_profile(solution, space);
  io::Figure figure =
      twod::picture(solution, space, rheology::Rheology(section.law, rheology::ChauchatMedale{}, 0),
                    "heap, α = " + io::rounded(studied_angle) + ", interior point, 28x40",
                    {.fields = "speed,regions"});
  figure.name = "heap_flow";
  chapter.headline(Question::flows, std::move(figure),
                   "Down a heap at α = " + io::rounded(studied_angle) +
                       ", half of the section: the surface moves at " +
                       known(surface.velocity.front(), 3) + " √(gd), and " +
                       known(surface.depth_yield.front(), 3) + " d below it the pile rests.");
}

}  // namespace

void heap_mesh_error(Chapter& chapter, const Context& context, const Section& studied) {
  io::Table table{"Q* at α = 0.42 without regularisation",
                  {"mesh", "wall", "Q*", "off the limit 82.495", "factorisations", "CPU s"},
                  {}};
  io::Panel panel{"mesh error at α = 0.42, interior point",
                  "1 / elements across",
                  "|Q* - 82.495| / 82.495",
                  true,
                  true,
                  {}};
  const std::vector<Family> families = {
      {"uniform, no slip", 1, twod::Wall::no_slip, 0.9, 1.15},
      {"uniform, relaxed wall", 1, twod::Wall::friction, 1.3, 1.6},
      {"graded cubically to wall and surface, no slip", 3, twod::Wall::no_slip}};
  std::vector<double> finest, orders;  // by family: error on the finest mesh, order of Q*
  for (const Family& family : families) {
    io::Curve curve{family.label, {}, {}};
    Section section = studied;
    section.wall = family.wall;
    for (const int across : {9, 18, 35, 70}) {
      if (across == 70 && family.grading > 1 && !context.full) continue;
      const SectionMesh mesh{across, (across * 10 + 6) / 7, family.grading, family.grading};
      const Rate found = rate(section, mesh, twod::default_options());
      table.rows.push_back({name_of(mesh),
                            family.wall == twod::Wall::friction ? "friction" : "no slip",
                            io::rounded(found.value, 7), io::rounded(found.value - limit_rate, 2),
                            io::rounded(found.iterations), io::rounded(found.seconds, 2)});
      curve.x.push_back(1.0 / across);
      curve.y.push_back(std::abs(found.value - limit_rate) / limit_rate);
      if (across == 35 && family.grading > 1)
        chapter.check("Q* on 35x50 graded", found.value, references::heap_flow_rate);
      if (across == 70 && family.label == families[0].label)
        chapter.check("Q* on 70x100 uniform", found.value, references::heap_flow_rate_on_70x100);
    }
    orders.push_back(fitted_order(curve.x, curve.y));
    if (family.grading == 1)
      chapter.check(Kind::self_consistency, "order of Q*, " + family.label, orders.back(),
                    family.lowest_order, family.highest_order);
    finest.push_back(curve.y.back());
    panel.curves.push_back(curve);
  }
  chapter.check(Kind::self_consistency,
                "70x100 uniform: mesh error with the relaxed wall over that without slip",
                finest[1] / finest[0], 0.15, 0.25);
  chapter.answer("On uniform meshes the flow rate of the heap's section converges with order " +
                 known(orders[0], 3) + " without slip at the wall, with " + known(orders[1], 3) +
                 " where the wall is relaxed.");
  chapter.figure(
      {"heap_mesh",
       "The heap's section by the interior point, without λr. No slip is not attained at the top "
       "of the side wall, where the stress reaches μ2 p: on "
       "uniform meshes Q* converges with order " +
           known(orders[0], 3) + ", with the wall relaxed to the term μ2 p|u| with " +
           known(orders[1], 3) + "; on 70x100 that error is " + known(finest[1] / finest[0], 2) +
           " times the one without slip. On its finest mesh graded towards wall and surface it "
           "is " +
           known(finest[2], 2) + " of Q*. The limit itself is known to 2e-5.",
       {panel},
       1});
  chapter.table(std::move(table));
}

void heap_study(Chapter& chapter, const Context& context) {
  chapter.text(
      "The heap as the smallest model that holds it: one scalar problem on half of the section. "
      "The interior point has no λr, so mesh error and λr error are measured, not extrapolated.");
  heap_mesh_error(chapter, context, at(studied_angle));
  context.progress(0.4);
  lambda_error(chapter);
  context.progress(0.6);
  work(chapter, context);
  show_flow(chapter);
}

}  // namespace talus::verification
