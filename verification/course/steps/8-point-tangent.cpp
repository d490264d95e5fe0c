#include <vector>

#include "common/shear/shear_flow.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_8)
using namespace course;
using namespace talus;

// K x beside the difference of residuals along x, node by node, about a sheared state.
template <int Dim>
void compare_tangent_with_differences(fem::Mesh<Dim> mesh) {
  shear::CrossSection<Dim> space(std::move(mesh));
  shear::ShearFlow<Dim> flow(
      space, {{}, rheology::Simple{}, 0.1}, [](const auto&) { return 1.; },
      [](const auto&) { return 0.; });
  typename shear::ShearFlow<Dim>::State state(space.node_count()), x(space.node_count());
  for (Eigen::Index i = 0; i < space.node_count(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    const auto& at = space.mesh().nodes[node];
    if (space.mesh().fixed[node]) continue;
    state.set(i, 0.2 * at[0] + 0.1 * at[Dim - 1] * at[Dim - 1]);
    x.set(i, at[0] * at[0] - 0.7 * at[Dim - 1]);
  }
  flow.evaluate(state);
  const Eigen::VectorXd product = flow.tangent_product(x);
  const double h = 1e-5;
  const Eigen::VectorXd ahead = flow.evaluate(state.moved(h, x)).value;
  const Eigen::VectorXd behind = flow.evaluate(state.moved(-h, x)).value;
  for (Eigen::Index i = 0; i < product.size(); ++i)
    BOOST_TEST(std::abs(seen(product[i]) - (ahead[i] - behind[i]) / (2 * h)) < 1e-6);
}

const std::vector<double> line{0, 0.5, 2}, side{0, 1};

BOOST_AUTO_TEST_CASE(on_a_line_it_is_the_slope_of_the_stress) {
  compare_tangent_with_differences<1>(fem::line_mesh(line, true, false));
}

BOOST_AUTO_TEST_CASE(on_a_surface_it_knows_the_direction_of_shear) {
  compare_tangent_with_differences<2>(
      fem::rectangle_mesh(side, side, [](const auto& x) { return x[0] == 0; }));
}

BOOST_AUTO_TEST_SUITE_END()
