#include "oned/errors.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <boost/test/unit_test.hpp>

#include "oned/report.hpp"
#include "oned/scenes.hpp"

BOOST_AUTO_TEST_SUITE(errors_test)

using namespace talus;
using namespace talus::oned;
using boost::test_tools::tolerance;

namespace {

// The scene's exact velocity at the nodes, plus perturbation(x).
Solution interpolated(const ShearScene& scene, const MeshOptions& mesh,
                      const std::function<double(double)>& perturbation) {
  Solution solution{{}, space_of(scene, boundaries(scene, mesh))};
  solution.velocity = solve::CompensatedVector(solution.space.node_count());
  const auto& nodes = solution.space.mesh().nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    solution.velocity.set(static_cast<Eigen::Index>(i),
                          scene.exact_velocity(nodes[i][0]) + perturbation(nodes[i][0]));
  return solution;
}

// Fields at the quadrature points made by hand: a share of the exact ones, and a shift.
Solution made_by_hand(const ShearScene& scene, const MeshOptions& mesh, double share,
                      double shift) {
  Solution solution = interpolated(scene, mesh, [](double) { return 0; });
  for (const auto& point : solution.space.points()) {
    const double x = point.position[0];
    solution.shear_rate.push_back(share * scene.exact_shear_rate(x) + shift);
    solution.stress.push_back(share * scene.exact_stress(x) + shift);
  }
  return solution;
}

}  // namespace

// The paper prints (1/N) sqrt(Σ err²) and calls it RMS.
BOOST_AUTO_TEST_CASE(the_paper_s_norm_is_the_root_mean_square_over_the_root_of_n) {
  const ShearScene scene = scene_of(Chute{});
  const MeshOptions mesh{.elements = 12};
  constexpr double shift = 0.25, nodes = 25;
  const Errors off = errors(interpolated(scene, mesh, [](double) { return shift; }), scene);
  BOOST_TEST(off.paper_rms == shift / std::sqrt(nodes), tolerance(1e-12));
  BOOST_TEST(off.nodal_max == shift, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_perturbed_exact_solution_has_the_errors_of_its_perturbation) {
  for (const ShearScene& scene : scenes()) {
    const MeshOptions mesh{.elements = 400};
    const Errors exact = errors(interpolated(scene, mesh, [](double) { return 0; }), scene);
    const auto bump = [&](double x) { return 0.1 * x / scene.length; };
    const Errors wrong = errors(interpolated(scene, mesh, bump), scene);
    BOOST_TEST(exact.nodal_max < 1e-14);
    BOOST_TEST(exact.max < 1e-2);
    BOOST_TEST(wrong.l2 == 0.1 * std::sqrt(scene.length / 3), tolerance(1e-3));
    BOOST_TEST(wrong.nodal_max == 0.1, tolerance(1e-12));
    BOOST_TEST(wrong.max >= wrong.nodal_max);
    BOOST_TEST(wrong.l2 > 10 * exact.l2);
  }
}

BOOST_AUTO_TEST_CASE(distances_between_solutions_are_those_of_their_difference) {
  const ShearScene scene = scene_of(Chute{});
  const MeshOptions mesh{.elements = 12};
  const Solution a = interpolated(scene, mesh, [](double) { return 0; });
  const Solution b = interpolated(scene, mesh, [](double x) { return x * x; });
  BOOST_TEST(distance(a, a).l2 == 0);
  BOOST_TEST(distance(a, b).l2 == std::sqrt(std::pow(14., 5) / 5), tolerance(1e-12));
  BOOST_TEST(distance(a, b).max == 14. * 14, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(velocities_between_the_nodes_are_those_of_the_parabolas) {
  const ShearScene scene = scene_of(Bagnold{});
  const auto parabola = [](double z) { return 3 + z * (2 - 0.1 * z); };
  const Solution solution = interpolated(scene, {.elements = 5, .grading = 2}, [&](double z) {
    return parabola(z) - scene.exact_velocity(z);
  });
  for (const double z : {0., 0.1, 3.3, 9.99, 13.7, 14.})
    BOOST_TEST(velocity_at(solution, z) == parabola(z), tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(rates_and_stresses_made_by_hand_have_the_errors_they_were_given) {
  const Bagnold bagnold;
  const ShearScene scene = scene_of(bagnold);
  const MeshOptions mesh{.elements = 7, .grading = 1.5};
  const double H = bagnold.height, shift = 0.25;
  const Errors exact = errors(made_by_hand(scene, mesh, 1, 0), scene);
  for (const double error :
       {exact.shear_rate.l2, exact.shear_rate.max, exact.stress.l2, exact.stress.max})
    BOOST_TEST(error == 0);

  const Errors shifted = errors(made_by_hand(scene, mesh, 1, shift), scene);
  for (const PointNorms& norms : {shifted.shear_rate, shifted.stress}) {
    BOOST_TEST(norms.l2 == shift * std::sqrt(H), tolerance(1e-12));
    BOOST_TEST(norms.max == shift, tolerance(1e-12));
  }

  // Off by 1%. The squares of the exact fields are polynomials: (H - z) and (H - z)².
  const Solution off = made_by_hand(scene, mesh, 1.01, 0);
  const Errors wrong = errors(off, scene);
  const double last = off.space.points().front().position[0];  // where both are largest
  BOOST_TEST(wrong.shear_rate.l2 == 0.01 * scene.exact_shear_rate(0) * std::sqrt(H / 2),
             tolerance(1e-10));
  BOOST_TEST(wrong.shear_rate.max == 0.01 * scene.exact_shear_rate(last), tolerance(1e-10));
  BOOST_TEST(wrong.stress.l2 == 0.01 * scene.exact_stress(0) * std::sqrt(H / 3), tolerance(1e-10));
  BOOST_TEST(wrong.stress.max == 0.01 * scene.exact_stress(last), tolerance(1e-10));

  const Errors apart = distance(off, made_by_hand(scene, mesh, 1, 0));
  BOOST_TEST(apart.shear_rate.l2 == wrong.shear_rate.l2, tolerance(1e-10));
  BOOST_TEST(apart.stress.max == wrong.stress.max, tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(a_solution_without_rates_and_stresses_has_no_errors_of_them) {
  const ShearScene scene = scene_of(Chute{});
  Solution solution = made_by_hand(scene, {.elements = 3}, 1, 0);
  solution.shear_rate.clear();
  const Errors none = errors(solution, scene);
  BOOST_TEST(std::isnan(none.shear_rate.l2));
  BOOST_TEST(std::isnan(none.shear_rate.max));
  BOOST_TEST(none.stress.max == 0);
  solution.stress.back() = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(std::isnan(errors(solution, scene).stress.l2));
  BOOST_TEST(std::isnan(errors(solution, scene).stress.max));
}

// Off by a half, so that no computed column is like an exact one.
BOOST_AUTO_TEST_CASE(columns_of_the_profile_hold_what_their_names_say) {
  for (const ShearScene& scene : scenes()) {
    const Solution off = made_by_hand(scene, {.elements = 7}, 1.5, 0.125);
    const io::Table table = profile_table(scene, off);
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
      const auto column = [&](const std::string& name) {
        const auto found = std::ranges::find(table.header, name);
        BOOST_REQUIRE(found != table.header.end());
        return io::number_in(table.rows[k][static_cast<std::size_t>(found - table.header.begin())]);
      };
      const double x = column(scene.coordinate), p = scene.pressure(x);
      const double rate = scene.exact_shear_rate(x), stress = scene.exact_stress(x);
      BOOST_TEST(x == off.space.points()[k].position[0]);
      BOOST_TEST(column(scene.velocity + "_exact") == scene.exact_velocity(x));
      BOOST_TEST(column("shear_rate") == 1.5 * rate + 0.125);
      BOOST_TEST(column("shear_rate_exact") == rate);
      BOOST_TEST(column("I") == scene.law().inertial_number(1.5 * rate + 0.125, p));
      BOOST_TEST(column("I_exact") == scene.law().inertial_number(rate, p));
      BOOST_TEST(column("stress") == 1.5 * stress + 0.125);
      BOOST_TEST(column("stress_exact") == stress);
    }
  }
}

// Half a point of the nodes is off: a middle node of one element alone.
BOOST_AUTO_TEST_CASE(a_middle_node_that_is_off_is_in_every_norm) {
  const ShearScene scene = scene_of(Chute{});
  const MeshOptions mesh{.elements = 12};
  const double middle = 2.5 * scene.length / 12;
  const Errors off = errors(
      interpolated(scene, mesh, [&](double x) { return std::abs(x - middle) < 1e-9 ? -0.5 : 0.0; }),
      scene);
  BOOST_TEST(off.nodal_max == 0.5, tolerance(1e-12));
  BOOST_TEST(off.paper_rms == 0.5 / 25, tolerance(1e-9));
}

// One order below the velocity's: rates come from its slope.
BOOST_AUTO_TEST_CASE(rates_and_stresses_of_a_solved_scene_tend_to_the_exact_ones) {
  const ShearScene scene = scene_of(Bagnold{});
  const auto solved = [&](int elements) {
    SolveOptions options;
    options.lambda_r = 1e-8;
    return errors(
        oned::solve(scene, boundaries(scene, {.elements = elements, .grading = 3}), options),
        scene);
  };
  const Errors coarse = solved(20), fine = solved(40);
  BOOST_TEST(std::log2(coarse.shear_rate.l2 / fine.shear_rate.l2) == 2, tolerance(0.05));
  BOOST_TEST(std::log2(coarse.stress.l2 / fine.stress.l2) > 1.9);
}

BOOST_AUTO_TEST_CASE(every_error_of_the_summary_is_under_the_name_of_its_norm) {
  const ShearScene scene = scene_of(Bagnold{});
  Solution solution = made_by_hand(scene, {.elements = 8}, 1.2, 0.1);
  solution.end = solve::End::converged;
  solution.newton.newton.history = {{0, 0}};
  const Errors error = errors(solution, scene);
  const nlohmann::json results = summary(scene, {}, solution).at("results");
  const std::vector<std::pair<std::string, double>> expected = {
      {"error_l2", error.l2},
      {"error_max", error.max},
      {"error_nodal_max", error.nodal_max},
      {"error_paper_rms", error.paper_rms},
      {"error_shear_rate_l2", error.shear_rate.l2},
      {"error_shear_rate_max", error.shear_rate.max},
      {"error_stress_l2", error.stress.l2},
      {"error_stress_max", error.stress.max}};
  std::set<double> values;
  for (const auto& [name, value] : expected) {
    BOOST_TEST(results.at(name) == value, name);
    values.insert(value);
  }
  BOOST_TEST(values.size() >= expected.size() - 1);  // the largest may be that of a node
}

BOOST_AUTO_TEST_CASE(profiles_name_coordinate_and_velocity_as_the_scene_does) {
  const auto header = [](const ShearScene& scene) {
    return profile_table(scene, made_by_hand(scene, {.elements = 2}, 1, 0)).header;
  };
  const std::vector<std::string> rest{"shear_rate", "shear_rate_exact", "I",
                                      "I_exact",    "stress",           "stress_exact"};
  std::vector<std::string> chute{"y", "w", "w_exact"}, plane{"z", "u", "u_exact"};
  chute.insert(chute.end(), rest.begin(), rest.end());
  plane.insert(plane.end(), rest.begin(), rest.end());
  BOOST_TEST(header(scene_of(Chute{})) == chute, boost::test_tools::per_element());
  BOOST_TEST(header(scene_of(Bagnold{})) == plane, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
