#include "oned/scenes.hpp"

#include <algorithm>
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/io/result_folder.hpp"
#include "common/testing/difference.hpp"
#include "oned/errors.hpp"
#include "oned/solver.hpp"

BOOST_AUTO_TEST_SUITE(scenes_test)

using namespace talus;
using namespace talus::oned;
using boost::test_tools::tolerance;
using rheology::Regime;

namespace {

// Every scene, exact for what every regularisation tends to.
std::vector<ShearScene> scenes_under_every_law() {
  std::vector<ShearScene> all;
  for (const ShearScene& scene : scenes())
    for (const auto& regularisation : rheology::regularisations())
      all.push_back(scene.under(regularisation));
  return all;
}

// Calls check(scene, x, distance to the next place where the profile is not smooth).
template <class Check>
void at_smooth_points(const ShearScene& scene, const Check& check) {
  std::vector<double> ends{0, scene.length};
  if (scene.kink) ends.insert(ends.begin() + 1, *scene.kink);
  for (std::size_t i = 1; i < ends.size(); ++i)
    for (const double share : {0.01, 0.2, 0.5, 0.8, 0.99}) {
      const double width = ends[i] - ends[i - 1];
      BOOST_TEST_CONTEXT(scene.name << " at " << ends[i - 1] + share * width) {
        check(ends[i - 1] + share * width, std::min(share, 1 - share) * width);
      }
    }
}

Solution solved(const ShearScene& scene, const MeshOptions& mesh, const SolveOptions& options) {
  const std::vector<double> line = boundaries(scene, mesh);
  Solution solution = oned::solve(scene, line, options);
  BOOST_REQUIRE(talus::solve::is_success(solution.end));
  return solution;
}

Solution solved(const ShearScene& scene, const MeshOptions& mesh, double lambda_r) {
  SolveOptions options;
  options.lambda_r = lambda_r;
  return solved(scene, mesh, options);
}

double largest_velocity(const Solution& solution) {
  return solution.velocity.value().lpNorm<Eigen::Infinity>();
}

double observed_order(const ShearScene& scene, MeshOptions mesh, int coarse, double lambda_r) {
  const auto error = [&](int elements) {
    mesh.elements = elements;
    return errors(solved(scene, mesh, lambda_r), scene).l2;
  };
  return std::log2(error(coarse) / error(2 * coarse));
}

}  // namespace

BOOST_AUTO_TEST_CASE(exact_velocities_differentiate_to_the_exact_shear_rates) {
  for (const ShearScene& scene : scenes_under_every_law())
    at_smooth_points(scene, [&](double x, double distance) {
      const double slope = testing::difference(scene.exact_velocity, x, distance);
      const double rate = scene.wall_at_start ? slope : -slope;
      BOOST_TEST(std::abs(rate - scene.exact_shear_rate(x)) <=
                 1e-8 * scene.exact_shear_rate(x) + 1e-12);
    });
}

BOOST_AUTO_TEST_CASE(exact_stresses_are_those_of_the_law_in_flow_and_below_yield_elsewhere) {
  for (const ShearScene& scene : scenes_under_every_law())
    at_smooth_points(scene, [&](double x, double) {
      const double p = scene.pressure(x), rate = scene.exact_shear_rate(x);
      const double I = scene.law().inertial_number(rate, p);
      if (rate > 0)
        BOOST_TEST(scene.exact_stress(x) == scene.limit.limit_friction(I) * p, tolerance(1e-12));
      else
        BOOST_TEST(scene.exact_stress(x) < scene.law().mu_s * p);
    });
}

// Appendix B writes I without φ, eq. (30) with it.
BOOST_AUTO_TEST_CASE(bagnold_s_profile_breaks_the_law_if_phi_is_left_out_of_it) {
  const ShearScene scene = scene_of(Bagnold{});
  rheology::FrictionLaw without_phi = scene.law();
  without_phi.solid_fraction = 1;
  const double stress = without_phi.stress(scene.exact_shear_rate(7), scene.pressure(7));
  BOOST_TEST(stress < 0.99 * scene.exact_stress(7));
}

BOOST_AUTO_TEST_CASE(exact_stresses_balance_the_body_force_and_vanish_at_the_free_end) {
  for (const ShearScene& scene : scenes()) {
    BOOST_TEST(scene.exact_stress(scene.wall_at_start ? scene.length : 0) == 0);
    at_smooth_points(scene, [&](double x, double distance) {
      BOOST_TEST(
          std::abs(testing::difference(scene.exact_stress, x, distance)) == scene.body_force(x),
          tolerance(1e-10));
    });
  }
}

BOOST_AUTO_TEST_CASE(nothing_slips_at_the_wall) {
  for (const ShearScene& scene : scenes_under_every_law())
    BOOST_TEST(std::abs(scene.exact_velocity(scene.wall_at_start ? 0 : scene.length)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(exact_profiles_have_the_known_values) {
  const ShearScene chute = scene_of(Chute{});
  BOOST_TEST(std::abs(chute.exact_velocity(0) - 1.230760) < 5e-7);
  BOOST_TEST(std::abs(scene_of(Chute{.pressure = 21.8}).exact_velocity(0) - 27.39) < 5e-3);
  const Bagnold bagnold;
  const ShearScene plane = scene_of(bagnold);
  for (const double z : {0., 7., 13.9}) {
    const double I = plane.law().inertial_number(plane.exact_shear_rate(z), plane.pressure(z));
    BOOST_TEST(plane.law().friction(I) == std::tan(bagnold.angle), tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(loads_fall_into_their_regimes) {
  const auto chute = [](double p) { return scene_of(Chute{.pressure = p}).regime(); };
  BOOST_CHECK(chute(40) == Regime::at_rest);
  BOOST_CHECK(chute(28) == Regime::flowing);
  BOOST_CHECK(chute(20) == Regime::no_steady_state);
  BOOST_CHECK(chute(21.77) == Regime::no_steady_state);
  const auto plane = [](double angle) { return scene_of(Bagnold{.angle = angle}).regime(); };
  BOOST_CHECK(plane(0.3) == Regime::at_rest);
  BOOST_CHECK(plane(0.406) == Regime::flowing);
  BOOST_CHECK(plane(0.6) == Regime::no_steady_state);
}

BOOST_AUTO_TEST_CASE(load_sweeps_cross_both_limits) {
  for (const ShearScene& scene : scenes()) {
    BOOST_CHECK(scene.load.scene(scene.load.rest).regime() == Regime::at_rest);
    BOOST_CHECK(scene.load.scene(scene.load.usual).regime() == Regime::flowing);
    BOOST_CHECK(scene.load.scene(scene.load.fast).regime() == Regime::no_steady_state);
  }
}

BOOST_AUTO_TEST_CASE(a_resting_scene_is_exactly_at_rest) {
  for (const ShearScene& scene : {scene_of(Chute{.pressure = 40}), scene_of(Bagnold{.angle = 0.3})})
    for (const double share : {0., 0.3, 0.9, 1.}) {
      BOOST_TEST(scene.exact_velocity(share * scene.length) == 0);
      BOOST_TEST(scene.exact_shear_rate(share * scene.length) == 0);
    }
}

BOOST_AUTO_TEST_CASE(graded_bagnold_has_the_reference_errors) {
  const ShearScene scene = scene_of(Bagnold{});
  for (const auto& [grading, reference] : {std::pair{2., 2.5e-8}, {3., 6.0e-8}, {4., 1.3e-7}}) {
    const MeshOptions mesh{.elements = 160, .grading = grading};
    BOOST_TEST(errors(solved(scene, mesh, 1e-8), scene).l2 == reference, tolerance(0.1));
  }
}

BOOST_AUTO_TEST_CASE(the_chute_near_its_limit_has_the_reference_velocity) {
  const Solution solution = solved(scene_of(Chute{.pressure = 21.8}), {.elements = 40}, 1e-6);
  BOOST_TEST(std::abs(largest_velocity(solution) - 23.49) < 5e-3);
}

BOOST_AUTO_TEST_CASE(a_resting_chute_creeps_in_proportion_to_lambda_r) {
  for (const double lambda_r : {1e-5, 1e-6, 1e-7}) {
    const Solution solution = solved(scene_of(Chute{.pressure = 40}), {.elements = 40}, lambda_r);
    BOOST_TEST(std::abs(largest_velocity(solution) / lambda_r - 9.1) < 0.05);
  }
}

// The paper's Table 1 has 10 000 iterations on two of these meshes.
BOOST_AUTO_TEST_CASE(bagnold_from_rest_takes_a_dozen_iterations_on_every_mesh) {
  const ShearScene scene = scene_of(Bagnold{});
  for (const int elements : {5, 10, 20, 40, 80, 160})
    for (const double lambda_r : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
      const Solution solution = solved(scene, {.elements = elements}, lambda_r);
      BOOST_TEST(solution.newton.path.empty());
      BOOST_TEST(solution.iterations() <= 12, elements << " elements, λr " << lambda_r);
    }
}

BOOST_AUTO_TEST_CASE(the_interior_point_and_newton_tell_the_same_profile) {
  SolveOptions options;
  options.method = Method::interior_point;
  for (const ShearScene& scene : scenes()) {
    const MeshOptions mesh{.elements = 20};
    const Solution newton = solved(scene, mesh, 1e-9);
    BOOST_TEST(distance(newton, solved(scene, mesh, options)).max < 1e-7);
    BOOST_TEST(distance(solved(scene, mesh, 1e-3), newton).max > 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(a_node_at_the_yield_point_gives_order_three_and_one_moved_away_only_two) {
  const ShearScene scene = scene_of(Chute{});
  for (const int coarse : {34, 68}) {
    const double aligned = observed_order(scene, {.align = 0.0}, coarse, 1e-12);
    BOOST_TEST(aligned > 2.9);
    BOOST_TEST(aligned < 3.1);
    const double moved = observed_order(scene, {.align = 0.5}, coarse, 1e-12);
    BOOST_TEST(moved > 1.9);
    BOOST_TEST(moved < 2.1);
  }
}

BOOST_AUTO_TEST_CASE(every_scene_passes_its_jacobian_check_and_fails_it_with_a_broken_tangent) {
  for (const ShearScene& scene : scenes())
    for (const Method method : {Method::newton, Method::interior_point}) {
      SolveOptions options;
      options.method = method;
      options.lambda_r = 1e-4;
      const std::vector<double> line = boundaries(scene, {.elements = 5});
      for (const solve::NamedCheck& named : check_jacobian(scene, line, options))
        BOOST_TEST(named.check.passed(), scene.name << ", " << named.state);
      if (method != Method::newton) continue;
      options.tangent_term = shear::TangentTerm::wrong_sign;
      BOOST_CHECK(check_jacobian(scene, line, options).back().check.verdict() ==
                  solve::Verdict::wrong);
    }
}

BOOST_AUTO_TEST_CASE(a_yield_point_that_is_not_there_cannot_be_aligned_with) {
  BOOST_CHECK_THROW(boundaries(scene_of(Bagnold{}), {.align = 0.0}), io::UserError);
  BOOST_CHECK_THROW(boundaries(scene_of(Chute{.pressure = 40}), {.align = 0.0}), io::UserError);
  BOOST_CHECK_THROW(boundaries(scene_of(Chute{}), {.elements = 1, .align = 0.0}), io::UserError);
  BOOST_CHECK_NO_THROW(boundaries(scene_of(Chute{}), {.elements = 2, .align = 0.0}));
}

// The clock may tick more slowly than one solve takes.
BOOST_AUTO_TEST_CASE(solves_are_timed) {
  double seconds = 0;
  for (int i = 0; i < 2000 && seconds == 0; ++i)
    seconds += solved(scene_of(Chute{}), {.elements = 40}, 1e-4).seconds;
  BOOST_TEST(seconds > 0);
}

BOOST_AUTO_TEST_SUITE_END()
