// Chute and inclined plane in velocity and pressure, in the plane and in space.
#include "threed/unidirectional.hpp"

#include <boost/test/unit_test.hpp>

#include "common/solve/continuation.hpp"
#include "oned/scenes.hpp"
#include "oned/solver.hpp"

using namespace talus;

namespace {

struct Solved {
  oned::Solution line;
  flow::Departure departure;
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
  pushed.body_force *= push;
  const auto space = threed::space_of<Dim>(scene, across, thickness);
  flow::DenseFlow<Dim> problem(space, {scene.law(), rheology::ChauchatMedale{}, 1e-4},
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
  const solve::CompensatedVector velocity(value);
  const auto state = flow::extruded(space, velocity);
  BOOST_TEST(threed::line_across(space, state, 7).value() == value,
             boost::test_tools::per_element());
  BOOST_TEST(threed::departure(scene, space, state, velocity).velocity == 0);
}
