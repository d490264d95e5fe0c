#include "common/program/stream_function.hpp"

#include <boost/test/unit_test.hpp>

#include "common/mixed/mixed_test_problems.hpp"
#include "common/solve/extremes.hpp"

BOOST_AUTO_TEST_SUITE(stream_function_test)
using namespace talus;
using namespace talus::mixed;
using talus::program::stream_function;

namespace {

using Velocity = fem::Point<2> (*)(const fem::Point<2>&);

MixedSpace<2> space_on(fem::Mesh<2> mesh) {
  BoundaryConditions<2> conditions;
  for (const auto& [name, faces] : mesh.boundaries) conditions[name] = {};
  return {std::move(mesh), conditions};
}

MixedSpace<2>::State state_of(const MixedSpace<2>& space, Velocity velocity) {
  auto state = space.start();
  for (std::size_t node = 0; node < space.mesh().nodes.size(); ++node)
    for (int i = 0; i < 2; ++i)
      state.set(space.velocity_index(static_cast<Eigen::Index>(node), i),
                velocity(space.mesh().nodes[node])[i]);
  return state;
}

// How far ψ is from the known one at the nodes; both are known up to a constant.
double error(const MixedSpace<2>& space, const MixedSpace<2>::State& state,
             double (*known)(const fem::Point<2>&)) {
  const Eigen::VectorXd psi = stream_function(space, state);
  const auto& nodes = space.mesh().nodes;
  double largest = 0;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const double here = psi[static_cast<Eigen::Index>(node)] - psi[0];
    largest = solve::nan_max(largest, std::abs(here - (known(nodes[node]) - known(nodes[0]))));
  }
  return largest;
}

fem::Point<2> rotation(const fem::Point<2>& x) {
  return {-x[1], x[0]};
}
double of_rotation(const fem::Point<2>& x) {
  return -0.5 * x.squaredNorm();
}

fem::Mesh<2> box() {
  const std::vector<double> x = {0, 0.4, 1}, y = {0, 0.7, 1, 2};
  return fem::rectangle_mesh(x, y, [](const auto&) { return false; });
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_rotation_has_its_stream_function_on_curved_elements_too) {
  for (const auto& mesh : {box(), fem::annulus_mesh(0.5, 2, 5, 3), awkward_mesh2(3, 2)}) {
    const MixedSpace<2> space = space_on(mesh);
    BOOST_TEST(error(space, state_of(space, rotation), of_rotation) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(a_quadratic_shear_flow_is_integrated_exactly) {
  const auto space = space_on(box());
  const auto state =
      state_of(space, [](const fem::Point<2>& x) { return fem::Point<2>(x[1] * x[1], 2 * x[0]); });
  const auto known = [](const fem::Point<2>& x) { return x[1] * x[1] * x[1] / 3 - x[0] * x[0]; };
  BOOST_TEST(error(space, state, known) < 1e-13);
}

BOOST_AUTO_TEST_CASE(two_velocities_that_are_swapped_are_noticed) {
  const auto space = space_on(fem::annulus_mesh(0.5, 2, 5, 3));
  auto state = state_of(space, rotation);
  for (int i = 0; i < 2; ++i) {
    const auto one = space.velocity_index(7, i), other = space.velocity_index(29, i);
    const double value = state.value()[one];
    state.set(one, state.value()[other]);
    state.set(other, value);
  }
  BOOST_TEST(error(space, state, of_rotation) > 1e-3);
}

BOOST_AUTO_TEST_CASE(a_velocity_that_is_not_a_number_is_not_lost) {
  const auto space = space_on(box());
  auto state = state_of(space, rotation);
  state.set(space.velocity_index(9, 0), std::nan(""));
  BOOST_TEST(!(error(space, state, of_rotation) < 1));
}

BOOST_AUTO_TEST_SUITE_END()
