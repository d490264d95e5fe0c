// The cylinder as one layer of H27 elements against the plane.
#include "threed/cylinder_layer.hpp"

#include <boost/test/unit_test.hpp>

#include "common/solve/continuation.hpp"

BOOST_AUTO_TEST_SUITE(cylinder_layer_test)

using namespace talus;

namespace {

twod::Cylinder coarse() {
  twod::Cylinder scene;
  scene.mesh = twod::refined_to(8);
  scene.lambda_r = 1e-3;
  return scene;
}

constexpr solve::NewtonOptions newton_options{.tolerance = 1e-14,
                                              .line_search = solve::LineSearch::residual_norm};

}  // namespace

BOOST_AUTO_TEST_CASE(from_rest_the_layer_creeps_as_the_plane) {
  twod::CylinderFlow plane(coarse());
  plane.flow().set_load_factor(0.03);
  auto of_plane = plane.space().start();
  solve::newton_along_path(plane.flow(), of_plane, newton_options, {.first = 0.1});
  for (const double thickness : {0.5, 2.0}) {
    threed::CylinderLayer layer(plane, thickness);
    auto state = layer.space().start();
    const auto solved =
        solve::newton_along_path(layer.flow(), state, newton_options, {.first = 0.1});
    BOOST_TEST_REQUIRE(solve::is_success(solved.newton.end));
    const auto apart = mixed::departure_from_plane(plane.space(), of_plane, layer.space(), state);
    BOOST_TEST(apart.velocity < 1e-10);
    BOOST_TEST(apart.cross_flow < 1e-10);
    BOOST_TEST(apart.pressure < 1e-10);
    layer.flow().evaluate(state);
    const double drag = twod::measure(plane, of_plane).drag;
    BOOST_TEST(layer.drag() == drag, boost::test_tools::tolerance(1e-10));
  }
}

BOOST_AUTO_TEST_CASE(another_loading_is_another_flow) {
  twod::CylinderFlow plane(coarse());
  plane.flow().set_load_factor(0.03);
  auto of_plane = plane.space().start();
  solve::newton_along_path(plane.flow(), of_plane, newton_options, {.first = 0.1});
  threed::CylinderLayer layer(plane);
  layer.flow().set_load_factor(0.03 * (1 + 1e-7));
  auto state = mixed::extruded_state(plane.space(), of_plane, layer.space());
  BOOST_TEST(mixed::departure_from_plane(plane.space(), of_plane, layer.space(), state).pressure <
             1e-14);
  BOOST_TEST_REQUIRE(solve::is_success(solve::newton(layer.flow(), state, newton_options).end));
  const auto apart = mixed::departure_from_plane(plane.space(), of_plane, layer.space(), state);
  BOOST_TEST(apart.velocity > 1e-9);
  BOOST_TEST(apart.pressure > 1e-9);
}

BOOST_AUTO_TEST_CASE(a_flow_across_put_in_by_hand_is_measured) {
  twod::CylinderFlow plane(coarse());
  const threed::CylinderLayer layer(plane);
  solve::CompensatedVector of_plane = plane.space().start();
  for (Eigen::Index node = 0; 2 * node < plane.space().velocity_count(); ++node)
    of_plane.set(plane.space().velocity_index(node, 1), -0.5);
  auto state = mixed::extruded_state(plane.space(), of_plane, layer.space());
  const auto apart = [&] {
    return mixed::departure_from_plane(plane.space(), of_plane, layer.space(), state);
  };
  BOOST_TEST(apart().velocity == 0);
  BOOST_TEST(apart().cross_flow == 0);
  state.set(layer.space().velocity_index(7, 2), -0.1);
  BOOST_TEST(apart().cross_flow == 0.2, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(apart().velocity == 0);
}

BOOST_AUTO_TEST_SUITE_END()
