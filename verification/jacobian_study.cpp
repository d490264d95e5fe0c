// Taylor tests of every derivative: the law at its awkward places, and every scene's tangent.
#include <functional>
#include <limits>

#include "common/flow/jacobian_problems.hpp"
#include "twod/section.hpp"
#include "verification/chapter.hpp"
#include "verification/dense_parts.hpp"
#include "verification/methods.hpp"

namespace talus::verification {
namespace {

constexpr double lowest_slope = 1.8;

struct LawState {
  std::string name;
  double shear_rate, pressure;
};

// In units that keep λr out of the definitions: the states scale with it.
std::vector<LawState> law_states(double lambda_r) {
  return {{"plug", 1e-3 * lambda_r, 28},           {"yield", lambda_r, 28},
          {"just flowing", 30 * lambda_r, 28},     {"flow", 1, 28},
          {"tiny pressure", 1e-2, 0.1 * lambda_r}, {"negative pressure", 1e-2, -1}};
}

// η as a function of two unknowns, shear rate and total pressure, each in units of its own size.
solve::JacobianProblem law_problem(const rheology::Rheology& rheology, const LawState& state) {
  const double rate_unit = 0.5 * state.shear_rate;
  const double pressure_unit = 0.5 * std::abs(state.pressure);
  solve::JacobianProblem problem;
  problem.size = 2;
  problem.residual = [=](const Eigen::VectorXd& x) {
    const double eta =
        rheology
            .evaluate(state.shear_rate + rate_unit * x[0], state.pressure + pressure_unit * x[1])
            .eta;
    const Eigen::Vector2d value(eta, 0);
    return solve::Residual{value, value, 8 * std::numeric_limits<double>::epsilon() * value};
  };
  problem.product = [=](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    const rheology::Viscosity at = rheology.evaluate(state.shear_rate, state.pressure);
    return Eigen::Vector2d(
        at.d_eta_d_shear_rate * rate_unit * v[0] + at.d_eta_d_pressure * pressure_unit * v[1], 0);
  };
  problem.rows = {{"η", {0}}};
  problem.columns = {{"|γ|", {0}}, {"p", {1}}};
  return problem;
}

std::string verdict(const solve::TaylorTest& test) {
  return (test.is_linear() ? "linear" : io::fixed(test.slope, 3)) + (test.passed ? "" : " WRONG");
}

void check_the_law(Chapter& chapter) {
  io::Table table{"Slope of the Taylor remainder of η (2 where the derivative is right)",
                  {"regularisation", "λr", "state", "∂η/∂|γ|", "∂η/∂p", "worst entry"},
                  {}};
  double smallest = std::numeric_limits<double>::infinity();
  double worst_entry = 0;
  io::Panel remainders{"remainder of η in both unknowns, λr = 1e-6, at yield",
                       "step",
                       "remainder / η",
                       true,
                       true,
                       {},
                       std::nullopt,
                       "top left"};
  for (const auto& regularisation : rheology::regularisations())
    for (const double lambda_r : {1e-2, 1e-6, 1e-10})
      for (const LawState& state : law_states(lambda_r)) {
        const rheology::Rheology law{{}, regularisation, lambda_r};
        const solve::JacobianCheck check = solve::check_jacobian(law_problem(law, state), 0.5);
        const solve::TaylorTest &all = check.blocks[0], &rate = check.blocks[1],
                                &pressure = check.blocks[2];
        table.rows.push_back({rheology::name_of(regularisation), short_power(lambda_r), state.name,
                              verdict(rate), verdict(pressure),
                              io::rounded(check.entries.worst, 2)});
        smallest = std::fmin(smallest, check.smallest_slope());
        worst_entry = std::max(worst_entry, check.entries.worst);
        if (lambda_r != 1e-6 || state.name != "yield") continue;
        const double eta = law.evaluate(state.shear_rate, state.pressure).eta;
        io::Curve curve{rheology::name_of(regularisation), {}, {}};
        for (std::size_t i = 0; i < all.steps.size(); ++i)
          if (all.remainders[i] > 0) {
            curve.x.push_back(all.steps[i]);
            curve.y.push_back(all.remainders[i] / eta);
          }
        remainders.curves.push_back(curve);
      }
  chapter.check("smallest slope over all laws and states", smallest, lowest_slope, 4);
  chapter.check("largest error of an entry against central differences", worst_entry, 0, 1e-6);
  chapter.figure({"taylor",
                  "The remainder falls with the square of the step until round-off takes over. A "
                  "wrong derivative would fall with the step itself.",
                  {remainders},
                  1});
  chapter.table(std::move(table));
}

// A scene on a small mesh, and the λr to check it at.
struct CheckedScene {
  std::string name;
  std::vector<double> lambda_r;
  std::function<std::vector<flow::NamedCheck>(const oned::SolveOptions&)> check;
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
                     return flow::check_jacobian(space, twod::load_of(section), options);
                   }});
  return all;
}

// Every scene, regularisation and state, ours and broken on purpose.
void check_the_scenes(Chapter& chapter, const Context& context) {
  io::Table table{"Smallest slope over all blocks of a scene's tangent (10 elements, heap 2x2)",
                  {"scene", "method", "λr", "at rest", "half way", "solution", "worst entry"},
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
      std::vector<std::string> row = {scene.name, method.label,
                                      is_newton ? short_power(method.options.lambda_r) : "none"};
      double worst = 0;
      bool passed = true;
      for (const auto& named : scene.check(method.options)) {
        const double slope = named.check.smallest_slope();
        row.push_back(io::fixed(slope, 3));
        smallest = std::fmin(smallest, slope);
        worst = std::max(worst, named.check.entries.worst);
        passed = passed && named.check.passed();
      }
      row.push_back(io::rounded(worst, 2) + (passed ? "" : " WRONG"));
      table.rows.push_back(row);
      chapter.check(scene.name + ", " + method.label + ", λr " + row[2] + ": every block and entry",
                    passed ? 1 : 0, 1, 1);
      if (is_newton)
        for (const auto term : {flow::TangentTerm::frozen, flow::TangentTerm::wrong_sign}) {
          oned::SolveOptions broken = method.options;
          broken.tangent_term = term;
          if (scene.check(broken).back().check.passed()) ++not_caught;
        }
    }
    context.progress(++done / static_cast<double>(scenes.size()));
  }
  chapter.check("smallest slope over all scenes and methods", smallest, lowest_slope, 4);
  chapter.check("broken tangents (η' dropped, or with the wrong sign) not caught", not_caught, 0,
                0);
  chapter.table(std::move(table));
  chapter.text(
      "The interior point is checked after 0, 3 and 6 steps instead; its rows are equilibrium, "
      "law, "
      "product and alignment. A slope of 3 appears where the second derivative vanishes by "
      "symmetry, at rest. The negative controls are part of the study: the same check must reject "
      "a tangent whose η' is dropped or has the wrong sign.");
}

}  // namespace

Chapter jacobian_study(const Context& context) {
  Chapter chapter{"jacobian", "Is every tangent the derivative of its residual?", {}, {}};
  chapter.text(
      "R(x + εv) - R(x) - εJv must fall like ε². The slope is fitted over the smallest steps that "
      "stand clear of the computed round-off, where a wrong derivative cannot hide behind "
      "curvature; entries are compared with central differences as well.");
  check_the_law(chapter);
  check_the_scenes(chapter, context);
  check_dense_tangents(chapter);
  return chapter;
}

}  // namespace talus::verification
