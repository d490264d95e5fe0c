// The section on ever finer meshes: what is carried over, and what it saves.
#include "twod/section_nested.hpp"

#include <boost/test/unit_test.hpp>

#include "twod/flow_rate_search.hpp"

BOOST_AUTO_TEST_SUITE(section_nested_test)

using namespace talus;
using namespace talus::twod;

namespace {

// A velocity that quadratic elements hold exactly, without slip only at the bottom.
double velocity(const Eigen::Vector2d& x) {
  return x[1] * (1 + 0.02 * x[0] - 0.01 * x[1]);
}
Eigen::Vector2d gradient(const Eigen::Vector2d& x) {
  return {0.02 * x[1], 1 + 0.02 * x[0] - 0.02 * x[1]};
}

}  // namespace

BOOST_AUTO_TEST_CASE(meshes_are_halved_until_that_saves_nothing) {
  const auto coarse = coarsened({35, 50, 2, 1.5});
  BOOST_REQUIRE(coarse.has_value());
  BOOST_TEST(coarse->across == 18);
  BOOST_TEST(coarse->up == 25);
  BOOST_TEST(coarse->grading_to_wall == 2);
  BOOST_TEST(coarse->grading_to_surface == 1.5);
  BOOST_TEST(!coarsened({15, 100}).has_value());
}

BOOST_AUTO_TEST_CASE(a_quadratic_velocity_is_carried_over_with_its_gradient_and_slip) {
  Section section;
  section.wall = Wall::friction;
  const SectionMesh coarse_mesh{3, 5, 2, 1.5}, fine_mesh{7, 8};
  const auto coarse = space_of(section, coarse_mesh), fine = space_of(section, fine_mesh);
  SectionSolution solution;
  solution.velocity = solve::CompensatedVector(coarse.node_count());
  for (Eigen::Index i = 0; i < coarse.node_count(); ++i)
    solution.velocity.set(i, velocity(coarse.mesh().nodes[static_cast<std::size_t>(i)]));

  const auto start = carried_over(solution, coarse, lines_of(section, coarse_mesh), fine);
  double apart = 0;
  for (Eigen::Index i = 0; i < fine.node_count(); ++i)
    apart = std::max(apart, std::abs(start.velocity.value()[i] -
                                     velocity(fine.mesh().nodes[static_cast<std::size_t>(i)])));
  BOOST_TEST(apart < 1e-11);
  apart = 0;
  BOOST_REQUIRE(start.gradients.size() == fine.points().size());
  for (std::size_t k = 0; k < fine.points().size(); ++k) {
    const auto& point = fine.points()[k];
    const Eigen::Vector2d expected =
        point.on_wall ? Eigen::Vector2d(velocity(point.position), 0) : gradient(point.position);
    apart = std::max(apart, (start.gradients[k] - expected).norm());
  }
  BOOST_TEST(apart < 1e-11);
}

BOOST_AUTO_TEST_CASE(nested_meshes_lead_to_the_same_flow_in_fewer_iterations_of_the_fine_mesh) {
  const SectionMesh mesh{35, 50};
  for (const Wall wall : {Wall::no_slip, Wall::friction})
    for (const double lambda_r : {1e-5, 1e-8}) {
      Section section;
      section.wall = wall;
      auto space = space_of(section, mesh);
      const auto rest = twod::solve(section, space, newton_options(lambda_r));
      const auto nested = solve_nested(section, mesh, space, newton_options(lambda_r));
      BOOST_TEST((nested.end == solve::End::converged));
      BOOST_TEST(flow_rate(nested, space) == flow_rate(rest, space),
                 boost::test_tools::tolerance(1e-9));
      BOOST_TEST_MESSAGE("rest " << rest.iterations() << ", nested " << nested.iterations());
      BOOST_TEST(nested.iterations() < rest.iterations());
      BOOST_REQUIRE(nested.meshes.size() == 3U);
      BOOST_TEST(nested.meshes.front().mesh.across == 9);
      BOOST_TEST(nested.meshes.back().iterations == nested.iterations());
    }
}

BOOST_AUTO_TEST_CASE(where_the_coarser_mesh_fails_the_finer_one_starts_from_rest) {
  const SectionMesh mesh{18, 25};
  const Section section;
  auto space = space_of(section, mesh);
  shear::ShearOptions options = newton_options(1e-5);
  options.continuation = shear::Continuation::never;
  options.newton.max_iterations = 1;
  const auto nested = solve_nested(section, mesh, space, options);
  const auto rest = twod::solve(section, space, options);
  BOOST_TEST((nested.end == solve::End::stagnated));
  BOOST_TEST((nested.meshes.front().end == solve::End::stagnated));
  BOOST_TEST((nested.velocity.value() == rest.velocity.value()));
}

BOOST_AUTO_TEST_CASE(a_search_for_a_flow_rate_may_set_out_on_nested_meshes) {
  const Section section;
  auto space = space_of(section, {32, 32});
  const auto solution =
      solve_for_flow_rate(39.71, section, {32, 32}, space, newton_options(1e-5), Start::nested);
  BOOST_TEST(flow_rate(solution, space) == 39.71, boost::test_tools::tolerance(1e-8));
}

BOOST_AUTO_TEST_SUITE_END()
