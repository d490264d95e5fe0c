#include "common/fem/mesh_check.hpp"

#include <limits>
#include <string>

#include <boost/test/unit_test.hpp>

#include "common/mixed/mixed_space.hpp"
#include "common/mixed/mixed_test_problems.hpp"
#include "common/shear/cross_section.hpp"

BOOST_AUTO_TEST_SUITE(mesh_check_test)

using namespace talus;
using namespace talus::fem;

namespace {

const std::vector<double> line{0, 0.4, 1, 1.5};

Mesh<2> plane() {
  return tensor_mesh<2>({line, line});
}
Mesh<3> box() {
  return box_mesh(line, line, line);
}

// What a mesh is refused with; empty if it is not.
std::string complaint(const auto& mesh) {
  try {
    checked(mesh);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

template <int Dim>
mixed::BoundaryConditions<Dim> walls(const Mesh<Dim>& mesh) {
  mixed::BoundaryConditions<Dim> conditions;
  for (const auto& [name, faces] : mesh.boundaries) conditions[name] = mixed::no_slip<Dim>();
  return conditions;
}

}  // namespace

BOOST_AUTO_TEST_CASE(meshes_that_are_right_pass_whatever_their_size_and_shape) {
  BOOST_TEST(complaint(line_mesh(line, true, false)).empty());
  BOOST_TEST(complaint(mixed::awkward_mesh2(6, 6)).empty());
  BOOST_TEST(complaint(mixed::awkward_mesh3()).empty());
  BOOST_TEST(complaint(annulus_mesh(1, 3, 2, 2)).empty());
  for (const double size : {1e-100, 1e-9, 1e9}) {
    Mesh<2> thin = plane();  // elements a thousand million times as long as wide
    for (auto& node : thin.nodes) node = {size * node[0], 1e-9 * size * node[1]};
    BOOST_TEST(complaint(thin).empty(), complaint(thin));
  }
}

BOOST_AUTO_TEST_CASE(an_element_inside_out_is_refused_by_name_in_every_dimension) {
  Mesh<1> on_line = line_mesh(line, true, false);
  std::swap(on_line.elements[2][0], on_line.elements[2][2]);
  Mesh<2> in_plane = plane();
  for (std::size_t row = 0; row < 9; row += 3)
    std::swap(in_plane.elements[5][row], in_plane.elements[5][row + 2]);
  Mesh<3> in_space = box();
  for (std::size_t row = 0; row < 27; row += 3)
    std::swap(in_space.elements[13][row], in_space.elements[13][row + 2]);
  for (const std::string& text : {complaint(on_line), complaint(in_plane), complaint(in_space)}) {
    BOOST_TEST(says(text, "turned inside out"), text);
    BOOST_TEST(says(text, "det dx/dξ = -"), text);
  }
  BOOST_TEST(says(complaint(on_line), "element 2 "));
  BOOST_TEST(says(complaint(in_plane), "element 5 "));
  BOOST_TEST(says(complaint(in_space), "element 13 "));
}

BOOST_AUTO_TEST_CASE(an_element_that_folds_over_at_one_corner_is_refused) {
  Mesh<2> mesh = plane();
  mesh.nodes[static_cast<std::size_t>(mesh.elements[4][8])] -= Eigen::Vector2d(0.7, 0.7);
  BOOST_TEST(says(complaint(mesh), "element 4 is turned inside out or folds over"));
}

BOOST_AUTO_TEST_CASE(an_element_without_extent_is_refused) {
  Mesh<1> point = line_mesh(line, true, false);
  for (auto& node : point.elements[1]) node = point.elements[1][0];
  BOOST_TEST(says(complaint(point), "element 1 has no extent: det dx/dξ = 0 "));
  Mesh<2> flat = plane();
  for (auto& node : flat.nodes) node[1] = 0.3 * node[0];
  BOOST_TEST(says(complaint(flat), "element 0 "), complaint(flat));
  Mesh<3> sheet = box();
  for (auto& node : sheet.nodes) node[2] = 0.3 * node[0] - node[1];
  BOOST_TEST(says(complaint(sheet), "element 0 "), complaint(sheet));
}

BOOST_AUTO_TEST_CASE(nodes_that_are_not_finite_or_not_there_are_refused) {
  Mesh<2> mesh = plane();
  mesh.nodes[static_cast<std::size_t>(mesh.elements[4][4])][0] = std::nan("");
  BOOST_TEST(says(complaint(mesh), "element 4 has nodes that are not finite"));
  for (const Eigen::Index node : {Eigen::Index{-1}, std::ssize(plane().nodes)}) {
    mesh = plane();
    mesh.elements[8][3] = node;
    BOOST_TEST(says(complaint(mesh), "element 8 has node " + std::to_string(node)));
  }
}

BOOST_AUTO_TEST_CASE(no_space_takes_a_mesh_inside_out) {
  const auto turned = [](auto mesh) {
    for (auto& node : mesh.nodes) node[0] = -node[0];
    return mesh;
  };
  const Mesh<1> on_line = line_mesh(line, true, false);
  BOOST_CHECK_NO_THROW(shear::CrossSection<1>{on_line});
  BOOST_CHECK_THROW(shear::CrossSection<1>{turned(on_line)}, std::invalid_argument);
  const Mesh<2> section =
      rectangle_mesh(line, line, [](const Eigen::Vector2d& x) { return x[0] == 0; });
  BOOST_CHECK_NO_THROW(shear::CrossSection<2>{section});
  BOOST_CHECK_THROW(shear::CrossSection<2>{turned(section)}, std::invalid_argument);
  BOOST_CHECK_NO_THROW(mixed::MixedSpace<2>(plane(), walls(plane())));
  BOOST_CHECK_THROW(mixed::MixedSpace<2>(turned(plane()), walls(plane())), std::invalid_argument);
  BOOST_CHECK_NO_THROW(mixed::MixedSpace<3>(box(), walls(box())));
  BOOST_CHECK_THROW(mixed::MixedSpace<3>(turned(box()), walls(box())), std::invalid_argument);
}

BOOST_AUTO_TEST_SUITE_END()
