#include "oned/heap_line.hpp"

#include <array>
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/fem/geometry.hpp"
#include "common/testing/difference.hpp"
#include "oned/bagnold.hpp"
#include "oned/depth.hpp"
#include "oned/errors.hpp"

BOOST_AUTO_TEST_SUITE(heap_line_test)

using namespace talus;
using namespace talus::oned;
using boost::test_tools::tolerance;

namespace {

// Flow at the surface only, down to the bottom, and so deep that walls carry everything below.
const std::array<HeapLine, 4> heaps = {
    HeapLine{}, {.width = 2000}, {.width = 20}, {.angle = 0.45, .width = 60, .wall_friction = 0.6}};

Solution solved(const ShearScene& scene, const MeshOptions& mesh, shear::Method method) {
  SolveOptions options;
  options.method = method;
  options.lambda_r = 1e-9;
  options.interior_point.tolerance = 1e-12;
  const Solution solution = oned::solve(scene, boundaries(scene, mesh), options);
  BOOST_REQUIRE(solve::is_success(solution.end));
  return solution;
}

}  // namespace

BOOST_AUTO_TEST_CASE(exact_profiles_belong_together_under_every_law) {
  for (const HeapLine& heap : heaps)
    for (const auto& regularisation : rheology::regularisations()) {
      const ShearScene scene = scene_of(heap).under(regularisation);
      const double H = heap.height;
      BOOST_TEST(scene.exact_velocity(0) == 0);
      BOOST_TEST(scene.exact_stress(H) == 0);
      for (const double z : {0.011 * H, 0.23 * H, 0.51 * H, 0.77 * H, 0.93 * H, 0.997 * H}) {
        const double scale = 0.3 * std::min(z, H - z);
        if (scene.kink && std::abs(z - *scene.kink) < scale) continue;
        const double slope = testing::difference(scene.exact_velocity, z, scale);
        BOOST_TEST(std::abs(slope - scene.exact_shear_rate(z)) <=
                   1e-8 * scene.exact_shear_rate(z) + 1e-11);
        BOOST_TEST(std::abs(testing::difference(scene.exact_stress, z, scale) +
                            scene.body_force(z)) < 1e-9);
        const double p = scene.pressure(z), rate = scene.exact_shear_rate(z);
        if (rate > 0)
          BOOST_TEST(scene.exact_stress(z) ==
                         scene.limit.limit_friction(scene.law().inertial_number(rate, p)) * p,
                     tolerance(1e-10));
        else
          BOOST_TEST(scene.exact_stress(z) <= scene.law().mu_s * p);
      }
    }
}

// With s = √h the integrand of eq. (4) is rational.
BOOST_AUTO_TEST_CASE(the_velocity_at_the_surface_has_a_closed_form) {
  for (const HeapLine& heap : heaps) {
    const rheology::FrictionLaw& law = heap.law;
    const double k = heap.wall_friction / heap.width, a = std::tan(heap.angle) - law.mu_s,
                 b = law.mu_2() - std::tan(heap.angle);
    const double s = std::sqrt(std::min(a / k, heap.height));
    const double exact =
        2 * law.I0 * std::sqrt(law.solid_fraction * std::cos(heap.angle)) / law.grain_size *
        ((a + b) / k * (s - std::sqrt(b / k) * std::atan(s * std::sqrt(k / b))) - s * s * s / 3);
    BOOST_TEST(scene_of(heap).exact_velocity(heap.height) == exact, tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(the_exact_flow_rate_is_the_integral_of_the_velocity) {
  for (const HeapLine& heap : heaps) {
    const ShearScene scene = scene_of(heap);
    double sum = 0;
    constexpr int pieces = 400;
    for (int i = 0; i < pieces; ++i)
      for (const auto& point : fem::gauss_rule<1>(3))
        sum += point.weight * heap.height / pieces / 2 *
               scene.exact_velocity((i + 0.5 * (1 + point.position[0])) * heap.height / pieces);
    BOOST_TEST(exact_flow_rate(heap) == sum, tolerance(1e-6));
  }
}

BOOST_AUTO_TEST_CASE(a_channel_of_any_width_is_an_inclined_plane) {
  const ShearScene wide = scene_of(HeapLine{.width = 1e10, .height = 15});
  const ShearScene plane = scene_of(Bagnold{.angle = 0.41, .height = 15});
  for (const double z : {1., 7., 14.})
    BOOST_TEST(wide.exact_velocity(z) == plane.exact_velocity(z), tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(both_methods_converge_to_the_exact_flow) {
  const HeapLine heap;
  const ShearScene scene = scene_of(heap);
  for (const auto method : {shear::Method::newton, shear::Method::interior_point}) {
    const auto error = [&](int elements) {
      const Solution solution =
          solved(scene, {.elements = elements, .grading = 3, .align = 0.0}, method);
      BOOST_TEST(measures(solution, scene).flow_rate == exact_flow_rate(heap), tolerance(1e-3));
      return errors(solution, scene).l2;
    };
    const double order = std::log2(error(40) / error(80));
    BOOST_TEST(order > 2.8);
    BOOST_TEST(order < 3.2);
  }
}

BOOST_AUTO_TEST_CASE(a_layer_put_in_by_hand_has_the_measures_it_should) {
  const ShearScene scene = scene_of(HeapLine{.height = 10});
  Solution solution{{}, space_of(scene, std::array<double, 4>{0, 2, 5, 10})};
  const auto& nodes = solution.space.mesh().nodes;
  solution.velocity = solve::CompensatedVector(solution.space.node_count());
  for (Eigen::Index i = 0; i < solution.velocity.size(); ++i)  // 2 (z/10)²
    solution.velocity.set(i, 0.02 * std::pow(nodes[static_cast<std::size_t>(i)][0], 2));
  for (const auto& point : solution.space.points())  // over yield in the upper half
    solution.stress.push_back((point.position[0] > 5 ? 1.5 : 0.5) * scene.law().mu_s *
                              scene.pressure(point.position[0]));
  const LayerMeasures all = measures(solution, scene);
  BOOST_TEST(all.flow_rate == 20. / 3, tolerance(1e-12));
  BOOST_TEST(all.surface_velocity == 2, tolerance(1e-12));
  // 1% at the node z = 1; 5% between those at 2 and 3.5.
  BOOST_TEST(all.depth_1 == 9, tolerance(1e-12));
  BOOST_TEST(all.depth_5 == 10 - (2 + 1.5 * (0.1 - 0.08) / (0.245 - 0.08)), tolerance(1e-12));
  BOOST_TEST(all.yielded_share == 0.5, tolerance(1e-12));
  BOOST_TEST(std::abs(all.depth_yield - 5) < 0.6);  // half way between two points
}

BOOST_AUTO_TEST_CASE(a_depth_is_linear_between_values_and_the_bottom_where_nothing_falls) {
  const std::array<double, 3> depth{0, 2, 6}, value{4, 2, 0};
  BOOST_TEST(depth_of_fall(depth, value, 3, 9) == 1);
  BOOST_TEST(depth_of_fall(depth, value, 1, 9) == 4);
  BOOST_TEST(depth_of_fall(depth, value, -1, 9) == 9);
  BOOST_TEST(depth_of_fall(depth, value, 5, 9) == 0);
  BOOST_TEST(depth_of_fall(depth, std::array<double, 3>{0, 0, 0}, 0, 9) == 0);
}

BOOST_AUTO_TEST_CASE(it_rests_and_has_no_steady_flow_where_the_inclined_plane_does) {
  BOOST_CHECK(scene_of(HeapLine{.angle = 0.36}).regime() == rheology::Regime::at_rest);
  BOOST_CHECK(scene_of(HeapLine{}).regime() == rheology::Regime::flowing);
  BOOST_CHECK(scene_of(HeapLine{.angle = 0.58}).regime() == rheology::Regime::no_steady_state);
}

BOOST_AUTO_TEST_SUITE_END()
