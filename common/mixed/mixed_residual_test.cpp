// How the residual of velocity and pressure is measured.
#include <boost/test/unit_test.hpp>

#include "common/mixed/mixed_test_problems.hpp"

BOOST_AUTO_TEST_SUITE(mixed_residual_test)

using namespace talus;
using namespace talus::mixed;

// Momentum and volume balance have units of their own: neither hides the other.
BOOST_AUTO_TEST_CASE(momentum_and_volume_are_each_relative_to_their_own) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>());
  MixedFlow<2> problem(space, {{}, rheology::ChauchatMedale{}, 1e-2}, test_load<2>(1));
  const solve::Residual residual = problem.evaluate(space.start());
  const Eigen::Index velocities = space.velocity_count();
  BOOST_TEST_REQUIRE(residual.block_ends.size() == 2u);
  BOOST_TEST(residual.block_ends[0] == velocities);
  BOOST_TEST(residual.block_ends[1] == space.size());
  Eigen::VectorXd x = Eigen::VectorXd::Ones(space.size());
  x.tail(space.size() - velocities).setConstant(7);
  BOOST_TEST(residual.leading_size(x) == 1);  // of the velocities
}

BOOST_AUTO_TEST_SUITE_END()
