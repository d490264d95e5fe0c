#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/test/unit_test.hpp>

#include "common/fem/geometry.hpp"
#include "common/fem/line_mesh.hpp"
#include "common/fem/mesh_tools.hpp"
#include "common/mixed/layer.hpp"

BOOST_AUTO_TEST_SUITE(mesh_test)

using namespace talus;
using namespace talus::fem;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using Line = std::vector<double>;
const Line x_line = {0, 1, 3}, y_line = {-1, 0.5, 1, 2}, z_line = {0, 0.25};

Mesh<2> unit_square(int n) {
  const Line line = fem::graded_line(0, 1, n, 1);
  return tensor_mesh<2>({line, line});
}

Mesh<3> unit_cube(int n) {
  const Line line = fem::graded_line(0, 1, n, 1);
  return box_mesh(line, line, line);
}

// Whether every node of an element is the mean of its tensor-product neighbours' vertices.
bool is_bilinear(const Mesh<2>& mesh) {
  for (const auto& element : mesh.elements) {
    const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(element[a])]; };
    for (const std::size_t low : {0U, 3U, 6U})
      if ((at(low) + at(low + 2) - 2 * at(low + 1)).norm() > 1e-14) return false;
    if ((at(0) + at(6) - 2 * at(3)).norm() > 1e-14) return false;
    if ((at(2) + at(8) - 2 * at(5)).norm() > 1e-14) return false;
  }
  return true;
}

// Largest deviation of an element from a parallelogram.
double non_affinity(const Mesh<2>& mesh) {
  double largest = 0;
  for (const auto& element : mesh.elements) {
    const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(element[a])]; };
    largest = std::max(largest, (at(0) + at(8) - at(2) - at(6)).norm());
  }
  return largest;
}

template <int Dim>
bool lies_on(const Mesh<Dim>& mesh, const std::string& name, int coordinate, double value) {
  for (const Face& face : mesh.boundaries.at(name))
    for (const std::size_t a : face_nodes<Dim>(face.side)) {
      const auto node = static_cast<std::size_t>(mesh.elements[face.element][a]);
      if (mesh.nodes[node][coordinate] != value) return false;
    }
  return true;
}

template <int Dim>
std::size_t named_faces(const Mesh<Dim>& mesh) {
  std::size_t count = 0;
  for (const auto& [name, faces] : mesh.boundaries) count += faces.size();
  return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_line_has_a_node_in_the_middle_of_each_element_and_named_ends) {
  const Mesh<1> mesh = line_mesh(y_line, true, false);
  BOOST_TEST(mesh.nodes.size() == 7U);
  BOOST_TEST(mesh.elements.size() == 3U);
  BOOST_TEST(mesh.nodes[1][0] == -0.25);
  BOOST_TEST(measure(mesh) == 3, boost::test_tools::tolerance(1e-14));
  BOOST_TEST((mesh.fixed.front() && !mesh.fixed.back()));
  BOOST_TEST((lies_on(mesh, "left", 0, -1) && lies_on(mesh, "right", 0, 2)));
}

BOOST_AUTO_TEST_CASE(a_rectangle_numbers_nodes_and_elements_along_its_first_axis) {
  const Mesh<2> mesh = rectangle_mesh(x_line, y_line, [](const Vector2d& x) { return x[0] == 3; });
  BOOST_TEST(mesh.nodes.size() == 35U);
  BOOST_TEST(mesh.elements.size() == 6U);
  BOOST_TEST((mesh.nodes[7 * 5 - 1] == Vector2d(3, 2)));
  const std::array<Eigen::Index, 9> second = {2, 3, 4, 7, 8, 9, 12, 13, 14};
  BOOST_TEST(mesh.elements[1] == second, boost::test_tools::per_element());
  BOOST_TEST(std::count(mesh.fixed.begin(), mesh.fixed.end(), true) == 7);
  BOOST_TEST((lies_on(mesh, "left", 0, 0) && lies_on(mesh, "right", 0, 3)));
  BOOST_TEST((lies_on(mesh, "bottom", 1, -1) && lies_on(mesh, "top", 1, 2)));
  BOOST_TEST(!lies_on(mesh, "top", 1, -1));
  BOOST_TEST(measure(mesh, mesh.boundaries.at("left")) == 3, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(measure(mesh) == 9, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_box_has_six_named_sides_that_are_all_its_outer_faces) {
  const Mesh<3> mesh = box_mesh(x_line, y_line, z_line);
  BOOST_TEST(mesh.nodes.size() == 5U * 7 * 3);
  BOOST_TEST(mesh.elements.size() == 6U);
  BOOST_TEST(measure(mesh) == 3 * 3 * 0.25, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(smallest_jacobian(mesh) > 0);
  BOOST_TEST(mesh.boundaries.size() == 6U);
  BOOST_TEST(named_faces(mesh) == outer_faces(mesh).size());
  const std::array<std::pair<const char*, double>, 6> sides = {
      {{"left", 0}, {"right", 3}, {"bottom", -1}, {"top", 2}, {"back", 0}, {"front", 0.25}}};
  for (std::size_t i = 0; i < 6; ++i)
    BOOST_TEST(lies_on(mesh, sides[i].first, static_cast<int>(i / 2), sides[i].second));
  BOOST_TEST(measure(mesh, mesh.boundaries.at("front")) == 9, boost::test_tools::tolerance(1e-14));
  for (std::size_t a = 0; a < 27; ++a) {
    const auto& node = mesh.nodes[static_cast<std::size_t>(mesh.elements[0][a])];
    const Vector3d expected(0.5 * static_cast<double>(a % 3),
                            -1 + 0.75 * static_cast<double>(a / 3 % 3),
                            0.125 * static_cast<double>(a / 9));
    BOOST_TEST((node - expected).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(a_turned_element_or_one_with_a_node_moved_has_a_negative_jacobian) {
  Mesh<2> mesh = unit_square(4);
  BOOST_TEST(smallest_jacobian(mesh) == 1. / 64, boost::test_tools::tolerance(1e-12));
  Mesh<2> moved = mesh;
  moved.nodes[static_cast<std::size_t>(mesh.elements[5][8])] += Vector2d(-0.3, -0.3);
  BOOST_TEST(smallest_jacobian(moved) < 0);
  for (auto& node : mesh.nodes) node[0] = -node[0];  // a mirror that forgets the elements
  BOOST_TEST(smallest_jacobian(mesh) < 0);
}

BOOST_AUTO_TEST_CASE(a_mirror_image_keeps_the_sign_of_jacobians_and_the_names) {
  const Mesh<3> box = box_mesh(x_line, y_line, z_line);
  for (const int axis : {0, 1, 2}) {
    const Mesh<3> image = mirrored(box, axis);
    BOOST_TEST(smallest_jacobian(image) == smallest_jacobian(box),
               boost::test_tools::tolerance(1e-12));
    BOOST_TEST(lies_on(image, "right", 0, axis == 0 ? -3 : 3));
    BOOST_TEST(lies_on(image, "top", 1, axis == 1 ? -2 : 2));
    BOOST_TEST(lies_on(image, "front", 2, axis == 2 ? -0.25 : 0.25));
  }
}

BOOST_AUTO_TEST_CASE(joined_parts_share_nodes_and_lose_the_faces_between_them) {
  const Line upper = {2, 5}, apart = {2.001, 5};
  const Mesh<2> mesh = tensor_mesh<2>({x_line, y_line});
  const Mesh<2> both = joined<2>({mesh, tensor_mesh<2>({x_line, upper})});
  BOOST_TEST(both.nodes.size() == 5U * 9);
  BOOST_TEST(both.elements.size() == 8U);
  BOOST_TEST(lies_on(both, "top", 1, 5));
  BOOST_TEST(both.boundaries.at("top").size() == 2U);
  BOOST_TEST(named_faces(both) == outer_faces(both).size());
  BOOST_TEST(measure(both) == 18, boost::test_tools::tolerance(1e-14));
  const Mesh<2> two = joined<2>({mesh, tensor_mesh<2>({x_line, apart})});
  BOOST_TEST(two.nodes.size() == 5U * 10);
}

BOOST_AUTO_TEST_CASE(joining_forgives_rounding_wherever_it_falls) {
  for (int n = 3; n < 40; ++n) {
    const Line line = fem::graded_line(0, 1. / n, n, 1);
    Mesh<2> mesh = tensor_mesh<2>({line, line}), image = mirrored(mesh, 0);
    for (auto& node : image.nodes) node *= 1 + 1e-15;
    const std::size_t side = 2 * static_cast<std::size_t>(n) + 1;
    BOOST_TEST(joined<2>({mesh, image}).nodes.size() == side * (2 * side - 1));
  }
}

BOOST_AUTO_TEST_CASE(a_fixed_node_stays_fixed_when_parts_are_joined) {
  const Line right = {3, 4};
  const auto at_the_seam = [](const Vector2d& x) { return x[0] == 3; };
  const auto nowhere = [](const Vector2d&) { return false; };
  const Mesh<2> both = joined<2>(
      {rectangle_mesh(x_line, y_line, nowhere), rectangle_mesh(right, y_line, at_the_seam)});
  for (std::size_t i = 0; i < both.nodes.size(); ++i)
    BOOST_TEST(both.fixed[i] == at_the_seam(both.nodes[i]));
}

BOOST_AUTO_TEST_CASE(nodes_of_an_annulus_lie_on_circles_and_its_area_converges_at_order_four) {
  const double exact = 0.25 * std::numbers::pi * (4 - 1);
  double previous = 0;
  for (const int n : {4, 8, 16}) {
    const Mesh<2> mesh = annulus_mesh(1, 2, n, n);
    BOOST_TEST(smallest_jacobian(mesh) > 0);
    BOOST_TEST(mesh.boundaries.size() == 4U);
    BOOST_TEST(named_faces(mesh) == outer_faces(mesh).size());
    for (const auto& [name, radius] : {std::pair{"inner", 1.}, {"outer", 2.}})
      for (const Face& face : mesh.boundaries.at(name))
        for (const std::size_t a : face_nodes<2>(face.side)) {
          const auto node = static_cast<std::size_t>(mesh.elements[face.element][a]);
          BOOST_TEST(std::abs(mesh.nodes[node].norm() - radius) < 1e-15);
        }
    BOOST_TEST(lies_on(mesh, "start", 1, 0));
    BOOST_TEST(measure(mesh, mesh.boundaries.at("end")) == 1, boost::test_tools::tolerance(1e-14));
    const double error = std::abs(measure(mesh) - exact);
    if (previous > 0) {
      const double order = std::log2(previous / error);
      BOOST_TEST((3.8 < order && order < 4.2), "order " << order);
    }
    previous = error;
  }
}

BOOST_AUTO_TEST_CASE(a_distorted_rectangle_is_bilinear_not_affine_and_keeps_its_boundary) {
  const Mesh<2> mesh = unit_square(8), moved = distorted(mesh, 0.2, 1);
  BOOST_TEST(is_bilinear(moved));
  BOOST_TEST(non_affinity(mesh) < 1e-15);
  BOOST_TEST(non_affinity(moved) > 0.1 / 8);
  BOOST_TEST(!is_bilinear(annulus_mesh(1, 2, 3, 3)));
  BOOST_TEST(smallest_jacobian(moved) > 0);
  BOOST_TEST(measure(moved) == 1, boost::test_tools::tolerance(1e-13));
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    const Vector2d step = moved.nodes[i] - mesh.nodes[i];
    BOOST_TEST(step.cwiseAbs().maxCoeff() <= 0.2 / 8);
    if (mesh.nodes[i].minCoeff() == 0 || mesh.nodes[i].maxCoeff() == 1)
      BOOST_TEST(step.norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(a_distortion_depends_on_its_seed_only) {
  const Mesh<2> mesh = unit_square(4);
  const Mesh<2> first = distorted(mesh, 0.2, 1), again = distorted(mesh, 0.2, 1);
  BOOST_TEST((first.nodes == again.nodes));
  BOOST_TEST((first.nodes != distorted(mesh, 0.2, 2).nodes));
  // The first value of mt19937(1) is 1791095845 on every machine: the first inner vertex.
  const std::size_t vertex = 2 + 2 * 9;
  BOOST_TEST(first.nodes[vertex][0] == 0.25 + 0.2 * 0.25 * (2 * 1791095845. / 4294967295. - 1),
             boost::test_tools::tolerance(1e-15));
}

BOOST_AUTO_TEST_CASE(a_distorted_box_keeps_its_volume_and_too_much_distortion_is_seen) {
  const Mesh<3> mesh = unit_cube(3), moved = distorted(mesh, 0.2, 7);
  BOOST_TEST(measure(moved) == 1, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(smallest_jacobian(moved) > 0);
  BOOST_TEST((moved.nodes != mesh.nodes));
  BOOST_TEST(smallest_jacobian(distorted(unit_square(16), 1.5, 1)) < 0);
}

BOOST_AUTO_TEST_CASE(an_extruded_mesh_has_the_volume_the_order_and_the_boundaries_of_its_plane) {
  const Mesh<2> plane = annulus_mesh(0.5, 1.5, 3, 2);
  const Line line = {-1, 0, 0.5};
  const Mesh<3> mesh = mixed::extruded_mesh(plane, line);
  BOOST_TEST(mesh.elements.size() == 2 * plane.elements.size());
  BOOST_TEST(mesh.nodes.size() == 5 * plane.nodes.size());
  BOOST_TEST(smallest_jacobian(mesh) > 0);
  BOOST_TEST(measure(mesh) == 1.5 * measure(plane), boost::test_tools::tolerance(1e-14));
  for (const auto& [name, faces] : plane.boundaries)
    BOOST_TEST(measure(mesh, mesh.boundaries.at(name)) == 1.5 * measure(plane, faces),
               boost::test_tools::tolerance(1e-14));
  for (const auto* end : {"back", "front"})
    BOOST_TEST(measure(mesh, mesh.boundaries.at(end)) == measure(plane),
               boost::test_tools::tolerance(1e-14));
  BOOST_TEST(lies_on(mesh, "back", 2, -1));
  BOOST_TEST(lies_on(mesh, "front", 2, 0.5));
  std::size_t named = 0;
  for (const auto& [name, faces] : mesh.boundaries) named += faces.size();
  BOOST_TEST(named == outer_faces(mesh).size());
}

BOOST_AUTO_TEST_CASE(an_extruded_rectangle_is_the_box) {
  const Mesh<3> box = box_mesh(x_line, y_line, z_line);
  const Mesh<3> mesh = mixed::extruded_mesh(tensor_mesh<2>({x_line, y_line}), z_line);
  BOOST_TEST((mesh.nodes == box.nodes));
  BOOST_TEST((mesh.elements == box.elements));
  for (const auto& [name, faces] : box.boundaries)
    BOOST_TEST(measure(mesh, mesh.boundaries.at(name)) == measure(box, faces),
               boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_place_in_a_box_is_found_again) {
  const Mesh<3> mesh = box_mesh(x_line, y_line, z_line);
  for (std::size_t element = 0; element < mesh.elements.size(); ++element)
    for (const Vector3d& reference : {Vector3d(0.3, -0.7, 0), Vector3d(-0.9, 0.2, 0.99)}) {
      const ElementPoint<3> at(mesh, element, reference);
      const auto place = locate<3>({x_line, y_line, z_line}, at.position);
      BOOST_TEST(place.element == element);
      BOOST_TEST((place.reference - reference).norm() < 1e-14);
    }
  // On the boundary it is in the element there, beyond it in the nearest one.
  BOOST_TEST(locate<2>({x_line, y_line}, Vector2d(3, 2)).element == 5U);
  const auto beyond = locate<2>({x_line, y_line}, Vector2d(3.5, -1));
  BOOST_TEST(beyond.element == 1U);
  BOOST_TEST((beyond.reference - Vector2d(1.5, -1)).norm() < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
