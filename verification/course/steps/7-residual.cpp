#include <vector>

#include "common/shear/cross_section.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_7)
using namespace course;
using namespace talus;

const std::vector<double> line{0, 0.5, 2, 3}, side{0, 0.4, 1};

BOOST_AUTO_TEST_CASE(a_constant_stress_pulls_at_the_ends_only) {
  const shear::CrossSection<1> space(fem::line_mesh(line, true, false));
  const std::vector<shear::CrossSection<1>::Vector> stress(
      space.points().size(), shear::CrossSection<1>::Vector::Constant(2));
  const Eigen::VectorXd force = space.internal_force(stress);
  for (Eigen::Index node = 0; node < force.size(); ++node)
    BOOST_TEST(std::abs(seen(force[node]) - (node + 1 == force.size() ? 2 : 0)) < 1e-12);
}

// Σ w_i F_i = ∫ τ·grad w, the work of a stress in a motion that the elements hold exactly.
BOOST_AUTO_TEST_CASE(its_work_is_an_integral) {
  const shear::CrossSection<1> space(fem::line_mesh(line, true, false));
  std::vector<shear::CrossSection<1>::Vector> stress;
  for (const auto& point : space.points()) stress.push_back(point.position);
  const Eigen::VectorXd force = space.internal_force(stress);
  double work = 0;
  for (Eigen::Index i = 0; i < force.size(); ++i)
    work += force[i] * std::pow(space.mesh().nodes[static_cast<std::size_t>(i)][0], 2);
  BOOST_TEST(seen(work) == 18, tolerance(1e-12));  // ∫ x 2x from 0 to 3
}

BOOST_AUTO_TEST_CASE(so_it_is_on_a_surface) {
  const shear::CrossSection<2> space(
      fem::rectangle_mesh(side, side, [](const auto& x) { return x[0] == 0; }));
  std::vector<Eigen::Vector2d> stress;
  for (const auto& point : space.points())
    stress.push_back({point.position[1], 3 * point.position[0]});
  const Eigen::VectorXd force = space.internal_force(stress);
  double work = 0;
  for (Eigen::Index i = 0; i < force.size(); ++i)
    work += force[i] * space.mesh().nodes[static_cast<std::size_t>(i)].prod();
  BOOST_TEST(seen(work) == 4. / 3, tolerance(1e-12));  // ∫ y² + 3x² over the unit square
}

BOOST_AUTO_TEST_SUITE_END()
