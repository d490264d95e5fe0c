#include <vector>

#include "common/shear/interior_point_system.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_15)
using namespace course;
using namespace talus;

const std::vector<double> line{0, 0.3, 1};

// A layer of two elements in a state strictly inside both cones, none of its residuals zero.
struct Layer {
  shear::CrossSection<1> space{fem::line_mesh(line, true, false)};
  shear::InteriorPointSystem<1> system{
      space, {}, [](const auto&) { return 1.; }, [](const auto&) { return 0.5; }};
  shear::ConeState<1> state = system.start();
  shear::ConeStep<1> step;
  shear::ConeResidual<1> residual, change;

  Layer() {
    for (std::size_t k = 0; k < state.bound.size(); ++k) {
      state.bound[k] *= 1.1;
      state.dual_bound[k] *= 1.3;
      state.stress[k][0] = 0.2 + 0.01 * static_cast<double>(k);
    }
    residual = system.residual(state);
    system.assemble(state);
    BOOST_TEST_REQUIRE(system.newton_step(residual, step));
    change = system.linearised(state, step);
  }
};

BOOST_AUTO_TEST_CASE(the_step_takes_the_law_to_zero) {
  const Layer at;
  for (std::size_t k = 0; k < at.change.law.size(); ++k)
    BOOST_TEST(std::abs(seen(at.change.law[k]) + at.residual.law[k]) < 1e-12);
}

BOOST_AUTO_TEST_CASE(and_the_products_of_the_cone) {
  const Layer at;
  for (std::size_t k = 0; k < at.change.product.size(); ++k) {
    BOOST_TEST(std::abs(seen(at.change.product[k]) + at.residual.product[k]) < 1e-12);
    BOOST_TEST(std::abs(seen(at.change.alignment[k][0]) + at.residual.alignment[k][0]) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(and_the_equilibrium) {
  const Layer at;
  for (Eigen::Index i = 0; i < at.change.equilibrium.size(); ++i)
    BOOST_TEST(std::abs(seen(at.change.equilibrium[i]) + at.residual.equilibrium[i]) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
