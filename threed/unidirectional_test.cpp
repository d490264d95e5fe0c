// Chute and inclined plane in velocity and pressure, in the plane and in space.
#include <boost/test/unit_test.hpp>

#include "common/solve/continuation.hpp"
#include "oned/errors.hpp"
#include "oned/scenes.hpp"
#include "threed/unidirectional_solve.hpp"

BOOST_AUTO_TEST_SUITE(unidirectional_test)

using namespace talus;

namespace {

struct Solved {
  oned::Solution line;
  mixed::Departure departure;
  Eigen::Index unknowns = 0;
};

// Both at λr = 1e-4, the richer one pushed by a force so many times larger.
template <int Dim>
Solved solved(const oned::ShearScene& scene, const threed::Thickness& thickness, double push = 1) {
  const auto across = oned::boundaries(scene, {.elements = 6, .grading = 1.5});
  oned::SolveOptions options;
  options.lambda_r = 1e-4;
  options.newton.tolerance = 1e-14;
  const auto line = oned::solve(scene, across, options);
  BOOST_TEST_REQUIRE(solve::is_success(line.end));

  oned::ShearScene pushed = scene;
  pushed.body_force = [&](double x) { return push * scene.body_force(x); };
  const auto space = threed::space_of<Dim>(scene, across, thickness);
  mixed::MixedFlow<Dim> problem(space, {scene.law(), rheology::ChauchatMedale{}, 1e-4},
                                threed::load_of<Dim>(pushed));
  auto state = space.start();
  const auto richer = solve::newton_with_continuation(
      problem, state, {.tolerance = 1e-14, .line_search = solve::LineSearch::residual_norm});
  BOOST_TEST_REQUIRE(solve::is_success(richer.newton.end));
  return {line, threed::departure(scene, space, state, line.velocity), space.size()};
}

template <int Dim>
void check_agreement(const threed::Thickness& thickness) {
  for (const auto& scene : oned::scenes()) {
    const auto found = solved<Dim>(scene, thickness).departure;
    BOOST_TEST(found.velocity < 1e-10, scene.name);
    BOOST_TEST(found.cross_flow < 1e-10, scene.name);
    BOOST_TEST(found.pressure < 1e-10, scene.name);
  }
}

// What a richer model is measured by, against the line itself.
template <int Dim>
void check_measures(const oned::ShearScene& scene, const threed::UnidirectionalOptions& options) {
  const auto across = oned::boundaries(scene, {.elements = 6, .grading = 1.5});
  const auto line = oned::solve(scene, across, options);
  const auto richer = threed::solve_unidirectional<Dim>(scene, across, options);
  BOOST_TEST_REQUIRE(solve::is_success(line.end));
  BOOST_TEST_REQUIRE(solve::is_success(richer.line.end));
  const oned::Errors apart = oned::distance(richer.line, line);
  const double size = line.velocity.value().template lpNorm<Eigen::Infinity>();
  BOOST_TEST(apart.max < 1e-9 * size);
  BOOST_TEST(apart.shear_rate.max < 1e-8 * size);
  BOOST_TEST(apart.stress.max < 1e-8 * scene.length);
  BOOST_TEST(richer.cross_flow < 1e-10 * size);
  double across_the_stream = 0;  // the same, read off the nodes
  for (Eigen::Index node = 0; Dim * node < richer.space->velocity_count(); ++node)
    for (int i = 1; i < Dim; ++i)
      across_the_stream = std::max(
          across_the_stream, std::abs(richer.state.value()[richer.space->velocity_index(node, i)]));
  BOOST_TEST(richer.cross_flow == across_the_stream, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(richer.dynamic_pressure < 1e-8 * scene.length);
  BOOST_TEST(richer.change_along < 1e-10);
  BOOST_TEST(richer.unknowns == richer.space->size());
  BOOST_TEST(richer.condensed < richer.unknowns);
  BOOST_TEST(richer.factorisations >= richer.line.iterations());
}

}  // namespace

BOOST_AUTO_TEST_CASE(in_the_plane_the_flow_is_that_of_the_line) {
  check_agreement<2>({.along = 2});
}

BOOST_AUTO_TEST_CASE(in_space_the_flow_is_that_of_the_line_however_thick) {
  check_agreement<3>({});
  check_agreement<3>({.along = 2, .between = 2});
}

BOOST_AUTO_TEST_CASE(a_force_larger_by_a_billionth_is_seen) {
  for (const auto& scene : oned::scenes())
    BOOST_TEST(solved<3>(scene, {}, 1 + 1e-8).departure.velocity > 1e-9, scene.name);
}

BOOST_AUTO_TEST_CASE(one_by_one_by_n_has_the_unknowns_of_the_paper) {
  const auto scene = scene_of(oned::Bagnold{});
  for (const auto& [elements, of_the_paper] : {std::pair{5, 297}, {10, 567}, {160, 8667}}) {
    const auto space = threed::space_of<3>(scene, oned::boundaries(scene, {.elements = elements}));
    BOOST_TEST(space.velocity_count() == of_the_paper);
  }
}

BOOST_AUTO_TEST_CASE(a_line_across_is_what_was_extruded) {
  const auto scene = scene_of(oned::Chute{});
  const auto space = threed::space_of<3>(scene, oned::boundaries(scene, {.elements = 3}));
  Eigen::VectorXd value(7);
  value << 1, 2, 3, 4, 5, 6, 7;
  const Eigen::VectorXd correction = 1e-17 * value.array().square();
  const solve::CompensatedVector velocity(value, correction);
  const auto state = mixed::extruded(space, velocity);
  BOOST_TEST(threed::line_across(space, state, 7).value() == value,
             boost::test_tools::per_element());
  BOOST_TEST(threed::line_across(space, state, 7).correction() == correction,
             boost::test_tools::per_element());
  BOOST_TEST(threed::departure(scene, space, state, velocity).velocity == 0);
}

BOOST_AUTO_TEST_CASE(rates_and_stresses_of_a_richer_model_are_those_of_the_line) {
  for (const auto& scene : oned::scenes())
    for (const auto tangent : {shear::TangentTerm::full, shear::TangentTerm::primal_dual})
      BOOST_TEST_CONTEXT(scene.name) {
        threed::UnidirectionalOptions options;
        options.lambda_r = 1e-4;
        options.tangent_term = tangent;
        check_measures<2>(scene, options);
        check_measures<3>(scene, options);
        options.penalty = {mixed::Penalty::plain, 1e-6};
        check_measures<2>(scene, options);
      }
}

BOOST_AUTO_TEST_CASE(without_continuation_a_tangent_that_is_broken_leads_nowhere) {
  const auto scene = scene_of(oned::Chute{});
  const auto across = oned::boundaries(scene, {.elements = 4});
  threed::UnidirectionalOptions options;
  options.lambda_r = 1e-4;
  options.continuation = shear::Continuation::never;
  BOOST_TEST(solve::is_success(threed::solve_unidirectional<2>(scene, across, options).line.end));
  options.tangent_term = shear::TangentTerm::wrong_sign;
  const auto broken = threed::solve_unidirectional<2>(scene, across, options);
  BOOST_TEST(!solve::is_success(broken.line.end));
  BOOST_TEST(broken.line.newton.path.empty());
  const auto checks = threed::check_unidirectional<2>(scene, across, options);
  BOOST_CHECK(checks.back().check.verdict() == solve::Verdict::wrong);
  options.tangent_term = shear::TangentTerm::full;
  for (const auto& named : threed::check_unidirectional<3>(scene, across, options))
    BOOST_TEST(named.check.passed(), named.state);
}

BOOST_AUTO_TEST_CASE(elements_of_a_uniform_line_are_cubes) {
  const auto scene = scene_of(oned::Chute{});
  const auto across = oned::boundaries(scene, {.elements = 7});
  const double edge = scene.length / 7;
  const auto space = threed::space_of<3>(scene, across, {.along = 3, .between = 2});
  fem::Point<3> farthest = fem::Point<3>::Zero();
  for (const auto& node : space.mesh().nodes) farthest = farthest.cwiseMax(node);
  BOOST_TEST(farthest[0] == 3 * edge, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(farthest[1] == 2 * edge, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(farthest[2] == scene.length, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_SUITE_END()
