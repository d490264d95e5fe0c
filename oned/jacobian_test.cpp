// Is the answer of --check-jacobian right, whatever the scene, law, mesh and λr?
#include <cmath>
#include <iostream>
#include <limits>
#include <sstream>

#include <boost/test/unit_test.hpp>

#include "common/program/summary.hpp"
#include "common/shear/shear_jacobian.hpp"
#include "oned/bagnold.hpp"
#include "oned/chute.hpp"
#include "oned/scenes.hpp"
#include "oned/solver.hpp"

BOOST_AUTO_TEST_SUITE(jacobian_test)

using namespace talus;
using namespace talus::oned;
using solve::Verdict;

namespace {

const std::vector<double> all_lambda_r{1e-1, 1e-4, 1e-7, 1e-10};
const std::vector<MeshOptions> meshes{{1},         {2},   {3, 1, 0.5},   {10, 2},
                                      {17, 1, 0.}, {40},  {60, 4},       {80, 3},
                                      {160, 2},    {200}, {200, 1, 0.5}, {200, 4}};

// The usual loads, gentle ones and those past every limit.
std::vector<ShearScene> loaded_scenes() {
  std::vector<ShearScene> all = scenes();
  for (const double pressure : {0.01, 1., 1000.})
    all.push_back(scene_of(Chute{.pressure = pressure}));
  for (const double angle : {0.01, 0.7, 1.5}) all.push_back(scene_of(Bagnold{.angle = angle}));
  return all;
}

std::string described(const ShearScene& scene, const SolveOptions& options,
                      const MeshOptions& mesh) {
  return scene.name + ", load " + std::to_string(scene.stress_ratio) + ", " +
         (options.method == Method::newton ? rheology::name_of(options.regularisation)
                                           : "interior point") +
         ", lambda_r " + std::to_string(std::log10(options.lambda_r)) + ", " +
         std::to_string(mesh.elements) + " elements, grading " + std::to_string(mesh.grading);
}

// The worst verdict over all states, and the state.
std::pair<Verdict, std::string> verdict(const ShearScene& scene, MeshOptions mesh,
                                        const SolveOptions& options) {
  if (!scene.kink || mesh.elements < 10) mesh.align.reset();
  std::pair<Verdict, std::string> worst{Verdict::right, "none"};
  for (const auto& [state, check] : check_jacobian(scene, boundaries(scene, mesh), options))
    if (check.verdict() > worst.first) worst = {check.verdict(), state};
  return worst;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_right_tangent_passes_whatever_the_scene_law_mesh_and_lambda_r) {
  std::size_t count = 0;
  const std::vector<ShearScene> all = loaded_scenes();
  for (const auto& law : rheology::regularisations())
    for (const double lambda_r : all_lambda_r)
      for (const MeshOptions& mesh : meshes) {
        const ShearScene& scene = all[count % all.size()];
        SolveOptions options;
        options.regularisation = law;
        options.lambda_r = lambda_r;
        if (count++ % 3 == 0) options.tangent_term = shear::TangentTerm::primal_dual;
        const auto [worst, state] = verdict(scene, mesh, options);
        BOOST_TEST(name_of(worst) == "ok", described(scene, options, mesh) << ", " << state);
      }
}

BOOST_AUTO_TEST_CASE(the_interior_point_passes_on_every_mesh) {
  std::size_t count = 0;
  const std::vector<ShearScene> all = loaded_scenes();
  for (const MeshOptions& mesh : meshes) {
    if (mesh.elements > 80) continue;
    SolveOptions options;
    options.method = Method::interior_point;
    for (int i = 0; i < 2; ++i) {
      const ShearScene& scene = all[count++ % all.size()];
      const auto [worst, state] = verdict(scene, mesh, options);
      BOOST_TEST(name_of(worst) == "ok", described(scene, options, mesh) << ", " << state);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_derivative_doubled_halved_dropped_negated_or_a_percent_off_is_wrong) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  std::size_t count = 0;
  const std::vector<ShearScene> all = loaded_scenes();
  for (const auto& law : rheology::regularisations())
    for (const double lambda_r : all_lambda_r)
      for (const double factor : {2., 0.5, 0., -1., 1.01, not_a_number}) {
        const MeshOptions& mesh = meshes[count % 7];
        const ShearScene& scene = all[count++ % all.size()];
        SolveOptions options;
        options.regularisation = law;
        options.lambda_r = lambda_r;
        options.slope_factor = factor;
        const auto [worst, state] = verdict(scene, mesh, options);
        BOOST_TEST(name_of(worst) == "WRONG", described(scene, options, mesh)
                                                  << ", factor " << factor);
      }
}

BOOST_AUTO_TEST_CASE(one_entry_a_percent_off_is_wrong_and_located) {
  for (const ShearScene& scene : scenes())
    for (const int elements : {1, 5, 40})
      for (const double lambda_r : {1e-1, 1e-10}) {
        const std::vector<double> line = boundaries(scene, {elements});
        shear::CrossSection<1> space = space_of(scene, line);
        shear::ShearFlow<1> problem(
            space, {scene.law(), rheology::ChauchatMedale{}, lambda_r},
            [&](const auto& x) { return scene.pressure(x[0]); }, [](const auto&) { return 0.; });
        shear::ShearFlow<1>::State state(space.node_count());
        for (Eigen::Index i = 0; i < state.size(); ++i)
          state.set(i, lambda_r * space.mesh().nodes[static_cast<std::size_t>(i)][0]);
        auto jacobian = shear::jacobian_problem(problem, space, state);
        const auto right = jacobian.product;
        const Eigen::Index middle = 2 * (elements / 2) + 1, last = space.node_count() - 1;
        for (const auto& [row, column] : {std::pair{middle, middle},
                                          {middle, middle + 1},
                                          {middle - 1, middle},
                                          {1L, 1L},
                                          {last - 1, last - 1}}) {
          if (space.mesh().fixed[static_cast<std::size_t>(row)] ||
              space.mesh().fixed[static_cast<std::size_t>(column)])
            continue;
          const double entry = right(Eigen::VectorXd::Unit(space.node_count(), column))[row];
          jacobian.product = [&, i = row, j = column](const Eigen::VectorXd& v) {
            Eigen::VectorXd product = right(v);
            product[i] += 0.01 * entry * v[j];
            return product;
          };
          const auto check = solve::check_jacobian(jacobian);
          BOOST_CHECK(check.verdict() == Verdict::wrong);
          BOOST_TEST(check.entries.row == row);
          BOOST_TEST(check.entries.column == column);
        }
      }
}

BOOST_AUTO_TEST_CASE(no_verdict_is_an_answer_of_its_own_and_no_pass) {
  const auto answer = [](const std::vector<solve::NamedCheck>& checks) {
    std::ostringstream text;
    std::streambuf* const before = std::cout.rdbuf(text.rdbuf());
    const int code = program::report("scene", checks);
    std::cout.rdbuf(before);
    return std::pair{code, text.str()};
  };
  solve::JacobianCheck check;
  check.entries.verdict = Verdict::right;
  check.blocks = {{"all", "all", {}, {}, {}}};
  const std::pair<Verdict, std::string> answers[] = {
      {Verdict::right, "is the derivative"},
      {Verdict::wrong, "is NOT the derivative"},
      {Verdict::not_tested, "No verdict: a part of the tangent was not tested"},
      {Verdict::not_evaluated, "No verdict: a part of the tangent was not evaluated"}};
  for (const auto& [verdict, words] : answers) {
    check.blocks[0].verdict = verdict;
    const auto [code, text] = answer({{"state", check}});
    BOOST_TEST(code == (verdict == Verdict::right ? 0 : 1));
    BOOST_TEST(text.find(words) != std::string::npos, text);
  }
  BOOST_TEST(answer({}).first == 1);
}

BOOST_AUTO_TEST_SUITE_END()
