// The heap's cross-section against reference values from other tools, and against itself.
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/shear/shear_jacobian.hpp"
#include "twod/section_report.hpp"

BOOST_AUTO_TEST_SUITE(section_test)

using namespace talus;
using namespace talus::twod;

namespace {

constexpr Wall both_walls[] = {Wall::no_slip, Wall::friction};

double rate(const SectionMesh& mesh, double angle, const shear::ShearOptions& options,
            Wall wall = Wall::no_slip) {
  Section section;
  section.angle = angle;
  section.wall = wall;
  auto space = space_of(section, mesh);
  const auto solution = twod::solve(section, space, options);
  BOOST_TEST(solve::is_success(solution.end));
  return flow_rate(solution, space);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_unregularised_flow_rate_is_that_of_another_solver) {
  // An augmented-Lagrangian solver without regularisation found 81.6587 on this mesh.
  BOOST_TEST(rate({18, 25}, 0.42, default_options()) == 81.6587,
             boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(the_paper_s_mesh_gives_the_reference_flow_rate_to_nine_digits) {
  Section section;
  auto space = space_of(section, {});
  const auto solution = twod::solve(section, space, newton_options(1e-5));
  BOOST_TEST((solution.end == solve::End::converged));
  BOOST_TEST(solution.newton.path.size() == 2U);  // a rough solve at λr = 1e-2 first
  BOOST_TEST(solution.iterations() <= 20);
  BOOST_TEST(flow_rate(solution, space) == 49.19365195, boost::test_tools::tolerance(2e-10));
  const SurfaceProfile surface = surface_profile(solution, space);
  BOOST_TEST(surface.velocity.front() == 3.734911, boost::test_tools::tolerance(2e-7));
  BOOST_TEST(surface.velocity.back() == 0.0);
  BOOST_TEST(surface.depth_1.back() == 0.0);
  // The layer flows deeper in the middle, and deeper to 1% of its velocity than to 5%.
  BOOST_TEST(surface.depth_1.front() > surface.depth_1[100]);
  BOOST_TEST(surface.depth_1.front() > surface.depth_5.front());
}

BOOST_AUTO_TEST_CASE(newton_needs_few_iterations_at_every_angle_on_graded_meshes_too) {
  for (const double grading : {1., 3.})
    for (const double angle : {0.37, 0.42, 0.46, 0.5})
      for (const auto& [lambda_r, most] : {std::pair{1e-5, 25}, {1e-8, 60}})
        for (const Wall wall : both_walls) {
          Section section;
          section.angle = angle;
          section.wall = wall;
          auto space = space_of(section, {14, 20, grading, grading});
          const auto solution = twod::solve(section, space, newton_options(lambda_r));
          BOOST_TEST_CONTEXT("grading " << grading << ", angle " << angle << ", λr " << lambda_r) {
            BOOST_TEST(is_success(solution.end), name_of(solution.end));
            BOOST_TEST(solution.iterations() <= most);
          }
        }
}

BOOST_AUTO_TEST_CASE(newton_s_own_tangent_from_rest_does_not_reach_what_the_primal_dual_form_does) {
  Section section;
  section.angle = 0.5;
  auto space = space_of(section, {14, 20, 3, 3});
  shear::ShearOptions plain = newton_options(1e-5);
  plain.tangent_term = shear::TangentTerm::full;
  plain.continuation = shear::Continuation::never;
  const auto solution = twod::solve(section, space, plain);
  BOOST_TEST((!solve::is_success(solution.end) || solution.iterations() > 35));
}

BOOST_AUTO_TEST_CASE(the_relaxed_wall_lowers_the_mesh_error_and_raises_its_order) {
  constexpr double limit = 82.495;  // meshes graded quadratically, up to 140x200
  std::vector<double> error[2];
  for (const int across : {7, 14, 28})
    for (const Wall wall : both_walls)
      error[static_cast<int>(wall)].push_back(
          limit - rate({across, across * 10 / 7}, 0.42, default_options(), wall));
  for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(error[1][i] < 0.5 * error[0][i]);
  BOOST_TEST(std::log2(error[0][0] / error[0][2]) / 2 < 1.15);
  BOOST_TEST(std::log2(error[1][0] / error[1][2]) / 2 > 1.25);
}

BOOST_AUTO_TEST_CASE(the_wall_slips_only_where_its_stress_reaches_the_largest_friction) {
  Section section;
  section.angle = 0.42;
  section.wall = Wall::friction;
  const auto load = load_of(section);
  auto space = space_of(section, {14, 20});
  for (const auto& options : {default_options(), newton_options(1e-8)}) {
    const auto solution = twod::solve(section, space, options);
    int slipping = 0, holding = 0;
    for (std::size_t k = 0; k < space.points().size(); ++k) {
      if (!space.points()[k].on_wall) continue;
      const double share =
          solution.stress[k] / (load.law.mu_2() * load.pressure(space.points()[k].position));
      BOOST_TEST(share < 1 + 1e-6);
      if (solution.shear_rate[k] > 1e-2) {
        ++slipping;
        BOOST_TEST(share > 1 - 1e-4);
      } else {
        ++holding;
      }
    }
    BOOST_TEST(slipping > 0);
    BOOST_TEST(holding > 0);
  }
}

BOOST_AUTO_TEST_CASE(a_wall_with_friction_that_nowhere_slips_is_one_without_slip) {
  // Just above the onset only the middle of the channel flows.
  shear::ShearOptions options = default_options();
  options.interior_point.tolerance = 1e-10;
  const double held = rate({14, 20}, 0.37, options);
  BOOST_TEST(held > 0.1);
  BOOST_TEST(rate({14, 20}, 0.37, options, Wall::friction) == held,
             boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(the_depth_by_the_yield_criterion_bounds_what_flows) {
  Section section;
  section.angle = 0.393;
  auto space = space_of(section, {14, 20});
  const auto solution = twod::solve(section, space, default_options());
  const SurfaceProfile surface = surface_profile(solution, space);
  for (std::size_t i = 0; i + 1 < surface.y.size(); ++i) {
    BOOST_TEST(surface.depth_yield[i] < section.height);
    BOOST_TEST(surface.depth_yield[i] > surface.depth_5[i]);
  }
  BOOST_TEST(surface.depth_yield.front() > surface.depth_yield[22]);
  section.angle = 0.36;
  for (const double depth :
       surface_profile(twod::solve(section, space, default_options()), space).depth_yield)
    BOOST_TEST(depth == 0);
}

BOOST_AUTO_TEST_CASE(the_error_of_the_regularisation_is_linear_in_lambda_r) {
  const SectionMesh mesh{14, 20};
  const double exact = rate(mesh, 0.42, default_options());
  const double coarse = rate(mesh, 0.42, newton_options(1e-4)) - exact;
  const double fine = rate(mesh, 0.42, newton_options(1e-5)) - exact;
  BOOST_TEST(coarse > 0);
  BOOST_TEST(coarse / fine > 9);
  BOOST_TEST(coarse / fine < 11);
}

BOOST_AUTO_TEST_CASE(the_interior_point_needs_few_factorisations_on_graded_meshes_too) {
  for (const double angle : {0.37, 0.393, 0.42, 0.5}) {
    Section section;
    section.angle = angle;
    auto space = space_of(section, {14, 20, 3, 3});
    const auto solution = twod::solve(section, space, default_options());
    BOOST_TEST((solution.end == solve::End::converged));
    BOOST_TEST(solution.iterations() <= 60);
  }
}

BOOST_AUTO_TEST_CASE(without_side_walls_it_is_bagnold_s_profile) {
  // A channel of slip walls is not offered; a very wide one comes near in its middle.
  Section section;
  section.width = 1e6;
  section.angle = 0.406;
  section.height = 14;
  auto space = space_of(section, {8, 40, 10, 1});
  const auto solution = twod::solve(section, space, default_options());
  const double I_alpha = section.law.I0 * (std::tan(section.angle) - section.law.mu_s) /
                         (section.law.mu_2() - std::tan(section.angle));
  const double bagnold = 2. / 3 * I_alpha *
                         std::sqrt(section.law.solid_fraction * std::cos(section.angle)) *
                         std::pow(section.height, 1.5);
  BOOST_TEST(surface_profile(solution, space).velocity.front() == bagnold,
             boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(below_the_angle_of_repose_it_rests) {
  Section section;
  section.angle = 0.36;
  auto space = space_of(section, {7, 10});
  const auto solution = twod::solve(section, space, default_options());
  BOOST_TEST(solution.interior_point.at_rest);
  BOOST_TEST(solution.velocity.value().norm() == 0);
  BOOST_TEST(yielded_share(solution, space) == 0);
}

BOOST_AUTO_TEST_CASE(past_the_largest_friction_the_mesh_has_no_solution_and_says_so) {
  Section section;
  section.angle = 0.65;
  section.width = 1e6;  // side walls carry part of the load
  BOOST_TEST((regime(section) == rheology::Regime::no_steady_state));
  auto space = space_of(section, {2, 10});
  BOOST_TEST((twod::solve(section, space, default_options()).end == solve::End::no_steady_state));
}

BOOST_AUTO_TEST_CASE(every_tangent_is_the_derivative_of_its_residual) {
  for (const Wall wall : both_walls) {
    Section section;
    section.wall = wall;
    auto space = space_of(section, {2, 3});
    for (const auto& regularisation : rheology::regularisations()) {
      shear::ShearOptions options = newton_options(1e-4);
      options.regularisation = regularisation;
      for (const auto& named : shear::check_jacobian(space, load_of(section), options))
        BOOST_TEST(named.check.passed(), rheology::name_of(regularisation) << ", " << named.state);
    }
    for (const auto& named : shear::check_jacobian(space, load_of(section), default_options()))
      BOOST_TEST(named.check.passed(), "interior point, " << named.state);
  }
}

BOOST_AUTO_TEST_CASE(a_tangent_without_the_viscosity_s_derivative_is_caught) {
  Section section;
  auto space = space_of(section, {3, 4});
  for (const auto term : {shear::TangentTerm::frozen, shear::TangentTerm::wrong_sign}) {
    shear::ShearOptions options = newton_options(1e-4);
    options.tangent_term = term;
    BOOST_CHECK(shear::check_jacobian(space, load_of(section), options).back().check.verdict() ==
                solve::Verdict::wrong);
  }
}

BOOST_AUTO_TEST_CASE(the_elimination_solves_the_linearised_optimality_system) {
  // On the central path only: off it the symmetric part of the tangent is used.
  Section section;
  auto space = space_of(section, {3, 4});
  const auto load = load_of(section);
  shear::InteriorPoint<2> problem(space, load.law, load.pressure, load.body_force);
  BOOST_TEST(shear::elimination_error(problem, problem.start()) < 1e-12);
}

BOOST_AUTO_TEST_CASE(the_grid_lists_every_cell_with_its_nine_nodes_and_all_fields) {
  Section section;
  auto space = space_of(section, {3, 4});
  const auto solution = twod::solve(section, space, default_options());
  const io::QuadraticGrid quads = grid(solution, space);
  BOOST_TEST(quads.cells.size() == 12U);
  BOOST_TEST(quads.points.size() == 63U);
  for (const auto& cell : quads.cells) {
    // The middles lie between the corners they follow, the centre in the middle of all.
    for (std::size_t edge = 0; edge < 4; ++edge)
      for (std::size_t d = 0; d < 3; ++d) {
        const auto at = [&](std::size_t i) {
          return quads.points[static_cast<std::size_t>(cell[i])][d];
        };
        BOOST_TEST(at(4 + edge) == 0.5 * (at(edge) + at((edge + 1) % 4)),
                   boost::test_tools::tolerance(1e-12));
        BOOST_TEST(at(8) == 0.25 * (at(0) + at(1) + at(2) + at(3)),
                   boost::test_tools::tolerance(1e-12));
      }
  }
  const std::string vtu = io::to_vtu(quads);
  for (const char* text : {"NumberOfPoints=\"63\"", "NumberOfCells=\"12\"", "velocity",
                           "inertial_number", "</VTKFile>"})
    BOOST_TEST(vtu.find(text) != std::string::npos, text);
}

BOOST_AUTO_TEST_SUITE_END()
