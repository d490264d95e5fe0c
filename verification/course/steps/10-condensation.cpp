#include <vector>

#include "common/shear/cross_section.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_10)
using namespace course;
using namespace talus;

const std::vector<double> line{0, 0.3, 1}, side{0, 0.4, 1};

// The middle of an element is on the parabola only if its own load comes back to it.
BOOST_AUTO_TEST_CASE(a_uniform_load_gives_a_parabola_in_the_middles_too) {
  shear::CrossSection<1> space(fem::line_mesh(line, true, false));
  using Tangent = shear::CrossSection<1>::Tangent;
  space.assemble(std::vector<Tangent>(space.points().size(), Tangent::Constant(2)));
  solve::CompensatedVector w;
  BOOST_TEST_REQUIRE(space.solve(space.load([](const auto&) { return 1.; }), w));
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    const double x = space.mesh().nodes[static_cast<std::size_t>(i)][0];
    BOOST_TEST(std::abs(seen(w.value()[i]) - (x - x * x / 2) / 2) < 1e-12);  // -2 w'' = 1
  }
}

BOOST_AUTO_TEST_CASE(the_condensed_system_has_the_solution_of_the_whole_one) {
  shear::CrossSection<2> space(
      fem::rectangle_mesh(side, side, [](const auto& x) { return x[0] == 0; }));
  std::vector<Eigen::Matrix2d> tangents;
  for (const auto& point : space.points())
    tangents.push_back(Eigen::Matrix2d{{2 + point.position[1], 0.5}, {0.5, 1}});
  space.assemble(tangents);
  const Eigen::VectorXd load = space.load([](const auto& x) { return 1 + x[0]; });
  solve::CompensatedVector w;
  BOOST_TEST_REQUIRE(space.solve_once(load, w));
  const Eigen::VectorXd product = space.product(tangents, w);
  for (Eigen::Index i = 0; i < load.size(); ++i)
    BOOST_TEST(std::abs(seen(product[i]) - load[i]) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
