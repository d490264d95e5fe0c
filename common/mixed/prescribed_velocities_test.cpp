// What holds where boundaries meet.
#include "common/mixed/prescribed_velocities.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include <boost/test/unit_test.hpp>

#include "common/mixed/mixed_space.hpp"

BOOST_AUTO_TEST_SUITE(prescribed_velocities_test)

using namespace talus;
using namespace talus::mixed;

namespace {

using Conditions = BoundaryConditions<2>;
using Vector = Eigen::Vector2d;

// The unit square, its lower side called `bottom`, the others after where they are.
fem::Mesh<2> square(const std::string& bottom = "bottom") {
  const std::vector<double> line{0, 0.5, 1};
  fem::Mesh<2> mesh = fem::tensor_mesh<2>({line, line});
  auto side = mesh.boundaries.extract("bottom");
  side.key() = bottom;
  mesh.boundaries.insert(std::move(side));
  return mesh;
}

BoundaryCondition<2> uniform(double x, double y, int precedence = 1) {
  return prescribed_velocity<2>([=](const Vector&) { return Vector(x, y); }, precedence);
}

// Velocity at the corner (0, 0), where "left" meets the bottom, as a space starts with it.
Vector corner(const BoundaryCondition<2>& left, const BoundaryCondition<2>& bottom,
              const std::string& bottom_name) {
  const Conditions conditions{{"left", left}, {bottom_name, bottom}, {"right", {}}, {"top", {}}};
  const MixedSpace<2> space(square(bottom_name), conditions);
  BOOST_TEST((space.is_fixed(0) && space.is_fixed(1)));
  return space.start().value().head<2>();
}

std::string complaint(const BoundaryCondition<2>& left, const BoundaryCondition<2>& bottom,
                      const std::string& bottom_name) {
  try {
    corner(left, bottom, bottom_name);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

const std::string names[] = {"a first", "z last"};  // before and after "left"

}  // namespace

BOOST_AUTO_TEST_CASE(a_velocity_goes_before_the_zero_of_a_wall_whatever_their_names) {
  for (const std::string& name : names) {
    BOOST_TEST((corner(uniform(0.3, -2), no_slip<2>(), name) == Vector(0.3, -2)), name);
    BOOST_TEST((corner(no_slip<2>(), uniform(0.3, -2), name) == Vector(0.3, -2)), name);
    BOOST_TEST((corner(no_slip<2>(), symmetry<2>(1), name) == Vector(0, 0)), name);
  }
}

BOOST_AUTO_TEST_CASE(conditions_are_merged_component_by_component) {
  BoundaryCondition<2> along = uniform(0.7, 9);
  along.fixed = {true, false};
  for (const std::string& name : names) {
    BOOST_TEST((corner(along, symmetry<2>(1), name) == Vector(0.7, 0)), name);
    BOOST_TEST((corner(symmetry<2>(1), along, name) == Vector(0.7, 0)), name);
  }
}

BOOST_AUTO_TEST_CASE(velocities_that_agree_are_one_to_their_rounding) {
  const auto wave = prescribed_velocity<2>([](const Vector& x) {
    return Vector(std::sin(std::numbers::pi * (1 - x[0])), 1 + x[1] / 3);
  });
  for (const std::string& name : names) {
    BOOST_TEST(complaint(wave, uniform(0, 1), name).empty());
    BOOST_TEST(!complaint(wave, uniform(1e-9, 1), name).empty());
  }
}

BOOST_AUTO_TEST_CASE(a_contradiction_names_both_boundaries_and_is_refused_whatever_their_names) {
  for (const std::string& name : names) {
    const std::string text = complaint(uniform(1, 0), uniform(2, 0), name);
    for (const std::string& part :
         {std::string("'left'"), "'" + name + "'", std::string("different")})
      BOOST_TEST((text.find(part) != std::string::npos), text << " lacks " << part);
  }
}

BOOST_AUTO_TEST_CASE(the_higher_precedence_settles_a_contradiction) {
  for (const std::string& name : names) {
    BOOST_TEST((corner(uniform(1, 0, 2), uniform(2, 0), name) == Vector(1, 0)), name);
    BOOST_TEST((corner(uniform(1, 0), uniform(2, 0, 2), name) == Vector(2, 0)), name);
    BoundaryCondition<2> wall = no_slip<2>();
    wall.precedence = 3;
    BOOST_TEST((corner(uniform(1, 0), wall, name) == Vector(0, 0)), name);
  }
}

BOOST_AUTO_TEST_CASE(a_velocity_that_is_not_finite_is_refused) {
  BOOST_TEST(complaint(uniform(std::nan(""), 0), {}, "bottom").find("'left'") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(every_node_of_a_boundary_and_no_other_is_prescribed) {
  const auto all = prescribed_velocities<2>(
      square(), {{"left", no_slip<2>()}, {"right", uniform(1, 2)}, {"bottom", {}}, {"top", {}}});
  BOOST_TEST(all.size() == 2U * (5 + 5));
  for (const auto& [index, value] : all) {
    const double x = square().nodes[static_cast<std::size_t>(index / 2)][0];
    BOOST_TEST(value == (x == 1 ? static_cast<double>(1 + index % 2) : 0.0));
    BOOST_TEST((x == 0 || x == 1));
  }
}

BOOST_AUTO_TEST_SUITE_END()
