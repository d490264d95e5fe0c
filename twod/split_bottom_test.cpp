#include "twod/split_bottom.hpp"

#include <array>
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/fem/line_mesh.hpp"
#include "twod/least_resistance.hpp"

BOOST_AUTO_TEST_SUITE(split_bottom_test)

using namespace talus;
using namespace talus::twod;
using boost::test_tools::tolerance;

namespace {

SplitBottomSolution solved(const SplitBottom& cell, shear::CrossSection<2>& space,
                           shear::Method method) {
  shear::ShearOptions options = default_options(cell);
  options.method = method;
  SplitBottomSolution solution = twod::solve(cell, space, options);
  BOOST_TEST_REQUIRE(solve::is_success(solution.end));
  return solution;
}

double torque_at(const SplitBottom& cell, int elements) {
  auto space = space_of(cell, {elements});
  return torque_integral(solved(cell, space, shear::Method::interior_point), space);
}

// Between two cylinders without a bottom: the inner one rests, the outer one turns.
constexpr double inner = 0.5, outer = 1.5, pressure = 0.7;
shear::CrossSection<2> gap(int elements) {
  return shear::CrossSection<2>(
      fem::rectangle_mesh(fem::graded_line(inner, outer, elements, 1),
                          std::array<double, 2>{0, 0.3},
                          [](const Eigen::Vector2d& x) { return x[0] == inner || x[0] == outer; }),
      "", 3, shear::Symmetry::rotation);
}

}  // namespace

// model.md: by an independent shooting.
BOOST_AUTO_TEST_CASE(the_curve_of_least_resistance_is_the_known_one) {
  struct Known {
    double height, radius, integral;
  };
  for (const Known& known : {Known{0.2, 0.97958415, 0.01979863},
                             {0.5, 0.85408445, 0.11679624},
                             {0.6, 0.76758500, 0.16249798},
                             {0.7, 0.61441257, 0.21106104},
                             {0.7256344, 0, .22336921}}) {
    const ZoneCurve curve = least_resistance(known.height);
    if (known.radius > 0) BOOST_TEST(curve.surface_radius == known.radius, tolerance(1e-7));
    BOOST_TEST(curve.integral == known.integral, tolerance(2e-7));
    BOOST_TEST(curve.radius.back() == 1, tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(the_curve_has_less_resistance_than_its_neighbours) {
  const ZoneCurve curve = least_resistance(0.5);
  const auto resistance = [&](double bulge) {
    double sum = 0;
    for (std::size_t i = 1; i < curve.depth.size(); ++i) {
      const auto r = [&](std::size_t k) {
        return curve.radius[k] + bulge * std::cos(std::acos(-1.) * curve.depth[k]);
      };
      const double dh = curve.depth[i] - curve.depth[i - 1], dr = r(i) - r(i - 1);
      const double middle = 0.5 * (r(i) + r(i - 1));
      sum += middle * middle * 0.5 * (curve.depth[i] + curve.depth[i - 1]) * std::hypot(dh, dr);
    }
    return sum;
  };
  BOOST_TEST(resistance(0) == curve.integral, tolerance(1e-4));
  BOOST_TEST(resistance(0.02) > resistance(0));
  BOOST_TEST(resistance(-0.02) > resistance(0));
}

BOOST_AUTO_TEST_CASE(what_turns_as_one_has_no_stress) {
  const auto space = gap(4);
  solve::CompensatedVector omega(space.node_count());
  for (Eigen::Index i = 0; i < omega.size(); ++i) omega.set(i, 3);
  std::vector<Eigen::Vector2d> g;
  space.gradients(omega, g);
  for (const auto& each : g) BOOST_TEST(each.norm() == 0);
}

// r² τ is the torque at every radius: τ = μ(I) p gives I, and ω' = I sqrt(φp)/(r d*).
BOOST_AUTO_TEST_CASE(flow_between_cylinders_is_exact) {
  const rheology::FrictionLaw law;
  const rheology::Rheology limit(law);
  const double torque = law.mu_2() * 0.98 * pressure * inner * inner;  // sheared within r = 0.64
  const auto slope = [&](double r) {
    return limit.limit_inertial_number(torque / (r * r * pressure)) *
           law.reference_shear_rate(pressure) / law.I0 / r;
  };
  double rate = 0;
  constexpr int pieces = 20000;
  for (int i = 0; i < pieces; ++i) rate += slope(inner + (i + 0.5) / pieces) / pieces;
  for (const auto method : {shear::Method::newton, shear::Method::interior_point}) {
    const auto error = [&](int elements) {
      auto space = gap(elements);
      const shear::ShearLoad<2> load{law, [](const auto&) { return pressure; },
                                     [](const auto&) { return 0.; },
                                     [=](const auto& x) { return x[0] == inner ? 0 : rate; }};
      shear::ShearOptions options = default_options({.rate = rate});
      options.method = method;
      options.lambda_r = 1e-8 * rate;
      options.interior_point.tolerance = 1e-10;
      const SplitBottomSolution solution{shear::solve_shear(space, load, options), {.rate = rate}};
      BOOST_TEST_REQUIRE(solve::is_success(solution.end));
      // Torque over the height of 0.3, from the power.
      return torque_integral(solution, space) * law.mu_s / 0.3 / torque - 1;
    };
    BOOST_TEST(std::abs(error(20)) < 2e-2);
    BOOST_TEST(std::abs(error(80)) < 0.15 * std::abs(error(20)));
  }
}

BOOST_AUTO_TEST_CASE(the_zone_is_near_the_curve_of_least_resistance) {
  for (const double height : {0.2, 0.5, 0.7}) {
    const SplitBottom cell{.height = height};
    auto space = space_of(cell, {40});
    const auto solution = solved(cell, space, shear::Method::interior_point);
    const ZoneCurve curve = least_resistance(height);
    const Zone zone = zone_of(solution, space);
    BOOST_TEST(std::abs(zone.centre.back() - curve.surface_radius) < 1e-2);
    BOOST_TEST(zone.width.back() > 0);
    BOOST_TEST(torque_integral(solution, space) >
               curve.integral);  // a minimum, approached from above
    BOOST_TEST(torque_integral(solution, space) == curve.integral, tolerance(0.05));
    BOOST_TEST(energy(solution, space) <= torque_integral(solution, space) * (1 + 1e-9));
  }
}

BOOST_AUTO_TEST_CASE(its_torque_converges_to_that_of_the_curve) {
  const SplitBottom cell{.height = 0.5};
  const double exact = least_resistance(0.5).integral;
  const double coarse = torque_at(cell, 20), fine = torque_at(cell, 40);
  BOOST_TEST(fine - exact < 0.65 * (coarse - exact));
  BOOST_TEST(2 * fine - coarse == exact, tolerance(5e-3));
}

BOOST_AUTO_TEST_CASE(newton_and_the_interior_point_find_the_same_zone) {
  const SplitBottom cell{.height = 0.4, .rate = 1e-3};
  auto space = space_of(cell, {20});
  const auto regularised = solved(cell, space, shear::Method::newton);
  const auto exact = solved(cell, space, shear::Method::interior_point);
  BOOST_TEST(torque_integral(regularised, space) == torque_integral(exact, space), tolerance(1e-3));
  BOOST_TEST(zone_of(regularised, space).centre.back() == zone_of(exact, space).centre.back(),
             tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(both_linearisations_hold_around_an_axis) {
  const SplitBottom cell;
  auto space = space_of(cell, {3});
  for (const auto method : {shear::Method::newton, shear::Method::interior_point}) {
    shear::ShearOptions options = default_options(cell);
    options.method = method;
    options.lambda_r = 1e-3;
    for (const auto& [state, check] : shear::check_jacobian(space, load_of(cell), options))
      BOOST_TEST(check.passed(), state);
  }
}

BOOST_AUTO_TEST_SUITE_END()
