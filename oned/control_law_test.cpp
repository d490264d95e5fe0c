// The control law without yield stress in the scenes: what it shares with eq. (4), and what not.
#include <algorithm>
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "oned/errors.hpp"
#include "oned/scenes.hpp"
#include "oned/solver.hpp"

BOOST_AUTO_TEST_SUITE(control_law_test)

using namespace talus;
using namespace talus::oned;
using boost::test_tools::tolerance;
using rheology::Regime;

namespace {

Solution solved(const ShearScene& scene, const MeshOptions& mesh, double lambda_r) {
  SolveOptions options;
  options.regularisation = rheology::BarkerGray{};
  options.lambda_r = lambda_r;
  Solution solution = oned::solve(scene, boundaries(scene, mesh), options);
  BOOST_REQUIRE(talus::solve::is_success(solution.end));
  return solution;
}

}  // namespace

BOOST_AUTO_TEST_CASE(without_a_yield_stress_a_scene_creeps_where_it_would_rest) {
  for (const ShearScene& scene :
       {scene_of(Chute{.pressure = 40}), scene_of(Bagnold{.angle = 0.3})}) {
    const ShearScene control = scene.under(rheology::BarkerGray{});
    BOOST_CHECK(control.regime() == Regime::flowing);
    const double fastest =
        std::max(control.exact_velocity(0), control.exact_velocity(scene.length));
    BOOST_TEST(fastest > 1e-6);
    const Solution solution = solved(control, {.elements = 80}, 1e-10);
    BOOST_TEST(solution.velocity.value().lpNorm<Eigen::Infinity>() == fastest, tolerance(1e-3));
  }
}

BOOST_AUTO_TEST_CASE(
    the_control_law_has_order_three_against_its_own_profile_and_none_against_eq_4) {
  const ShearScene chute = scene_of(Chute{}), control = chute.under(rheology::BarkerGray{});
  const Solution coarse = solved(control, {.elements = 136, .align = 0.0}, 1e-12);
  const Solution fine = solved(control, {.elements = 272, .align = 0.0}, 1e-12);
  const auto order = [&](const ShearScene& scene) {
    return std::log2(errors(coarse, scene).l2 / errors(fine, scene).l2);
  };
  BOOST_TEST(std::abs(order(control) - 3) < 0.05);
  BOOST_TEST(std::abs(order(chute)) < 0.01);
}

// Both laws are eq. (4) where the plane flows faster than the control law's creep.
BOOST_AUTO_TEST_CASE(the_plane_is_the_same_under_the_control_law_above_its_creep) {
  const ShearScene plane = scene_of(Bagnold{}), control = plane.under(rheology::BarkerGray{});
  for (const double z : {1., 7., 14.})
    BOOST_TEST(control.exact_velocity(z) == plane.exact_velocity(z), tolerance(1e-14));
  const ShearScene chute = scene_of(Chute{}), slower = chute.under(rheology::BarkerGray{});
  BOOST_TEST(slower.exact_velocity(0) > 1.01 * chute.exact_velocity(0));
}

BOOST_AUTO_TEST_SUITE_END()
