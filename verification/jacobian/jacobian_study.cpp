// Taylor tests of every derivative: the law at its awkward places, and every scene's tangent.
#include <functional>
#include <limits>

#include "common/shear/law_check.hpp"
#include "common/shear/shear_solver.hpp"
#include "common/solve/extremes.hpp"
#include "twod/section.hpp"
#include "twod/split_bottom.hpp"
#include "verification/harness/chapter.hpp"
#include "verification/harness/fit.hpp"
#include "verification/harness/methods.hpp"
#include "verification/jacobian/jacobian_parts.hpp"

namespace talus::verification {
namespace {

constexpr double lowest_slope = 1.8;

std::string slope_text(double slope, solve::Verdict verdict) {
  return (std::isinf(slope) ? "linear" : io::fixed(slope, 3)) +
         (verdict == solve::Verdict::right ? "" : " " + name_of(verdict));
}

std::string slope_text(const solve::TaylorTest& test) {
  return slope_text(test.slope, test.verdict);
}

void check_the_law(Chapter& chapter) {
  io::Table table{"Slope of the Taylor remainder of η (2 where the derivative is right)",
                  {"regularisation", "λr", "state", "∂η/∂|γ|", "∂η/∂p", "worst entry"},
                  {}};
  double smallest = std::numeric_limits<double>::infinity();
  double worst_entry = 0;
  int wrong = 0;
  io::Panel remainders{"remainder of η in both unknowns, λr = 1e-6, at yield",
                       "step",
                       "remainder / η",
                       true,
                       true,
                       {}};
  for (const auto& regularisation : rheology::regularisations())
    for (const double lambda_r : {1e-2, 1e-6, 1e-10})
      for (const shear::LawState& state : shear::law_states({{}, regularisation, lambda_r}, 28)) {
        const rheology::Rheology law{{}, regularisation, lambda_r};
        const solve::JacobianCheck check = solve::check_jacobian(shear::law_problem(law, {state}));
        const solve::TaylorTest &all = check.blocks[0], &rate = check.blocks[1],
                                &pressure = check.blocks[2];
        table.rows.push_back({rheology::name_of(regularisation), short_power(lambda_r), state.name,
                              slope_text(rate), slope_text(pressure),
                              io::rounded(check.entries.worst, 2)});
        smallest = solve::nan_min(smallest, check.smallest_slope());
        worst_entry = solve::nan_max(worst_entry, check.entries.worst);
        if (!check.passed()) ++wrong;
        if (lambda_r != 1e-6 || state.name != "at yield") continue;
        const double eta = law.evaluate(state.shear_rate, state.total_pressure).eta;
        io::Curve curve{rheology::name_of(regularisation), {}, {}};
        for (std::size_t i = 0; i < all.steps.size(); ++i)
          if (all.remainders[i] > 0) {
            curve.x.push_back(all.steps[i]);
            curve.y.push_back(all.remainders[i] / eta);
          }
        remainders.curves.push_back(curve);
      }
  chapter.check(Kind::other_method, "smallest slope over all laws and states", smallest,
                lowest_slope, 4);
  chapter.check(Kind::other_method,
                "largest error of an entry against differences, beyond their own", worst_entry, 0,
                1e-6);
  chapter.check(Kind::self_consistency, "laws and states that do not pass", wrong, 0, 0);
  chapter.figure(
      {"taylor",
       "The law alone at yield, λr = 1e-6: the remainder of η falls with the square of the "
       "step until round-off takes over. A wrong derivative would fall with the step itself.",
       {remainders},
       1});
  chapter.table(std::move(table));
}

// A scene on a small mesh, and the λr to check it at.
struct CheckedScene {
  std::string name;
  std::vector<double> lambda_r;
  std::function<std::vector<solve::NamedCheck>(const oned::SolveOptions&)> check;
};

std::vector<CheckedScene> checked_scenes() {
  std::vector<CheckedScene> all;
  for (const auto& scene : oned::scenes())
    all.push_back({scene.name, {1e-3, 1e-8}, [scene](const oned::SolveOptions& options) {
                     return oned::check_jacobian(scene, oned::boundaries(scene, {.elements = 10}),
                                                 options);
                   }});
  for (const twod::Wall wall : {twod::Wall::no_slip, twod::Wall::friction})
    all.push_back({wall == twod::Wall::friction ? "heap section, relaxed wall" : "heap section",
                   {1e-3},
                   [wall](const oned::SolveOptions& options) {
                     twod::Section section;
                     section.wall = wall;
                     auto space = twod::space_of(section, {2, 2});
                     return shear::check_jacobian(space, twod::load_of(section), options);
                   }});
  all.push_back({"split-bottom cell", {1e-3}, [](const oned::SolveOptions& options) {
                   const twod::SplitBottom cell;
                   auto space = twod::space_of(cell, {2});
                   return shear::check_jacobian(space, twod::load_of(cell), options);
                 }});
  return all;
}

// Every scene, regularisation and state, ours and broken on purpose.
void check_the_scenes(Chapter& chapter, const Context& context) {
  io::Table table{"Smallest slope over all blocks of a scene's tangent (10 elements, heap 2x2)",
                  {"scene", "method", "λr", "smallest slope", "worst entry", "system", "states"},
                  {}};
  const auto scenes = checked_scenes();
  double smallest = std::numeric_limits<double>::infinity();
  int not_caught = 0;
  double done = 0;
  for (const auto& scene : scenes) {
    std::vector<NamedMethod> methods = {reference_method()};
    for (const double lambda_r : scene.lambda_r)
      for (const NamedMethod& method : newton_methods(lambda_r)) methods.push_back(method);
    for (const NamedMethod& method : methods) {
      const bool is_newton = method.options.method == oned::Method::newton;
      const std::string lambda_r = is_newton ? short_power(method.options.lambda_r) : "none";
      double slope = std::numeric_limits<double>::infinity(), worst = 0, system = 0;
      auto verdict = solve::Verdict::right;
      const auto checks = scene.check(method.options);
      for (const auto& [name, check] : checks) {
        slope = solve::nan_min(slope, check.smallest_slope());
        worst = solve::nan_max(worst, check.entries.worst);
        system = solve::nan_max(system, check.system.error);
        verdict = std::max(verdict, check.verdict());
      }
      smallest = solve::nan_min(smallest, slope);
      table.rows.push_back({scene.name, method.label, lambda_r, slope_text(slope, verdict),
                            io::rounded(worst, 2), io::rounded(system, 2),
                            std::to_string(checks.size())});
      chapter.check(
          Kind::other_method,
          scene.name + ", " + method.label + ", λr " + lambda_r + ": every block, entry and system",
          verdict == solve::Verdict::right ? 1 : 0, 1, 1);
      if (is_newton)
        for (const auto term : {shear::TangentTerm::frozen, shear::TangentTerm::wrong_sign}) {
          oned::SolveOptions broken = method.options;
          broken.tangent_term = term;
          if (scene.check(broken).back().check.verdict() != solve::Verdict::wrong) ++not_caught;
        }
    }
    context.progress(++done / static_cast<double>(scenes.size()));
  }
  chapter.check(Kind::other_method, "smallest slope over all scenes and methods", smallest,
                lowest_slope, 4);
  chapter.answer("Remainders fall with a slope of " + known(smallest, 3) +
                 " at least, where a right derivative has 2, and " + std::to_string(not_caught) +
                 " tangents that were broken on purpose went unnoticed.");
  chapter.check(Kind::control, "broken tangents (η' dropped, or with the wrong sign) not caught",
                not_caught, 0, 0);
  chapter.table(std::move(table));
  chapter.text(
      "Newton's tangent is checked at rest, in plug, at yield and in flow, and the law alone, "
      "states that need no solve; the interior point at its start, in plug and in flow, its rows "
      "being equilibrium, law, product and alignment. The system is the one that is factored: "
      "what its solution leaves of the right-hand side. A slope of 3 appears where the second "
      "derivative vanishes by symmetry, at rest. The negative controls are part of the study: the "
      "same check must call wrong a tangent whose η' is dropped or has the wrong sign.");
}

}  // namespace

void jacobian_study(Chapter& chapter, const Context& context) {
  chapter.text(
      "R(x + εv) - R(x) - εJv must fall like ε². The slope is fitted over the smallest steps that "
      "stand clear of the computed round-off, where a wrong derivative cannot hide behind "
      "curvature; entries are compared with difference quotients as well. What round-off hides is "
      "not tested, and does not pass.");
  check_the_law(chapter);
  check_the_scenes(chapter, context);
  check_mixed_tangents(chapter);
}

}  // namespace talus::verification
