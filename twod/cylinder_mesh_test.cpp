#include "twod/cylinder_mesh.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <set>

#include <boost/test/unit_test.hpp>

#include "common/fem/mesh_tools.hpp"

BOOST_AUTO_TEST_SUITE(cylinder_mesh_test)

using namespace talus;
using namespace talus::twod;
using Eigen::Vector2d;
using fem::Face;
using fem::measure;
using Mesh = fem::Mesh<2>;

namespace {

constexpr double pi = std::numbers::pi;

CylinderMeshOptions both_halves(CylinderMeshOptions options = {}) {
  options.full = true;
  return options;
}

bool lies_on(const Mesh& mesh, const std::string& name,
             const std::function<bool(const Vector2d&)>& is_there) {
  for (const Face& face : mesh.boundaries.at(name))
    for (const std::size_t a : fem::face_nodes<2>(face.side))
      if (!is_there(mesh.nodes[static_cast<std::size_t>(mesh.elements[face.element][a])]))
        return false;
  return true;
}

bool boundaries_lie_on_the_geometry(const Mesh& mesh, double outlet = 15) {
  return lies_on(mesh, "cylinder",
                 [](const Vector2d& x) { return std::abs(x.norm() - 0.5) <= 1e-15; }) &&
         lies_on(mesh, "wall", [](const Vector2d& x) { return std::abs(x[0]) == 10; }) &&
         lies_on(mesh, "top", [](const Vector2d& x) { return x[1] == 15; }) &&
         lies_on(mesh, "bottom", [=](const Vector2d& x) { return x[1] == -outlet; });
}

double length(const Mesh& mesh, const std::string& name) {
  return measure(mesh, mesh.boundaries.at(name));
}

// Every outer face is in exactly one named boundary.
bool names_cover_all_outer_faces(const Mesh& mesh) {
  std::multiset<std::pair<std::size_t, int>> named, outer;
  for (const auto& [name, faces] : mesh.boundaries)
    for (const Face& face : faces) named.insert({face.element, face.side});
  for (const Face& face : fem::outer_faces(mesh)) outer.insert({face.element, face.side});
  return named == outer;
}

// Whether two nodes share a place: sorted by rounded x, then by z, they are neighbours.
bool has_duplicates(const Mesh& mesh) {
  auto nodes = mesh.nodes;
  std::sort(nodes.begin(), nodes.end(), [](const Vector2d& a, const Vector2d& b) {
    const auto rounded = [](double x) { return std::lround(x * 1e9); };
    return std::pair(rounded(a[0]), a[1]) < std::pair(rounded(b[0]), b[1]);
  });
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if ((nodes[i] - nodes[i - 1]).norm() < 1e-9) return true;
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_default_mesh_is_that_of_the_paper) {
  const Mesh mesh = cylinder_mesh({});
  BOOST_TEST(mesh.elements.size() == 21'138U);
  BOOST_TEST(mesh.boundaries.at("cylinder").size() == 80U);
  BOOST_TEST(mesh.boundaries.size() == 5U);
  BOOST_TEST(mesh.fixed.size() == mesh.nodes.size());
  BOOST_TEST(smallest_jacobian(mesh) > 0);
  // Euler: nodes = vertices + edges + elements of a simply connected domain.
  const std::size_t outer = fem::outer_faces(mesh).size(), elements = mesh.elements.size();
  const std::size_t edges = (4 * elements + outer) / 2, vertices = 1 + edges - elements;
  BOOST_TEST(mesh.nodes.size() == vertices + edges + elements);
  BOOST_TEST(!has_duplicates(mesh));
  // The first layer, straight below the cylinder.
  BOOST_TEST(std::count_if(mesh.nodes.begin(), mesh.nodes.end(), [](const Vector2d& x) {
               return x[0] == 0 && std::abs(x[1] + 0.52) < 1e-12;
             }) == 1);
}

BOOST_AUTO_TEST_CASE(boundaries_lie_on_the_geometry_and_cover_it) {
  const auto close = boost::test_tools::tolerance(1e-12);
  const Mesh half = cylinder_mesh({}), full = cylinder_mesh(both_halves());
  for (const Mesh* mesh : {&half, &full}) {
    BOOST_TEST(boundaries_lie_on_the_geometry(*mesh));
    BOOST_TEST(names_cover_all_outer_faces(*mesh));
  }
  BOOST_TEST(lies_on(half, "symmetry", [](const Vector2d& x) { return x[0] == 0; }));
  BOOST_TEST(length(half, "symmetry") == 29, close);
  BOOST_TEST(length(half, "wall") == 30, close);
  BOOST_TEST(length(half, "top") == 10, close);
  BOOST_TEST(length(half, "bottom") == 10, close);
  BOOST_TEST(std::abs(length(half, "cylinder") - 0.5 * pi) < 1e-8);
  BOOST_TEST(length(full, "wall") == 60, close);
  BOOST_TEST(length(full, "top") == 20, close);
  BOOST_TEST(length(full, "bottom") == 20, close);
  BOOST_TEST(std::abs(length(full, "cylinder") - pi) < 2e-8);
}

BOOST_AUTO_TEST_CASE(the_area_converges_at_the_order_of_quadratic_curves) {
  double previous = 0;
  for (const int around : {16, 32, 64, 128}) {
    const Mesh mesh = cylinder_mesh(refined_to(around));
    const double error = std::abs(measure(mesh) - (300 - pi / 8));
    BOOST_TEST_MESSAGE(around << " around: " << mesh.elements.size() << " elements, area error "
                              << error << ", smallest Jacobian " << smallest_jacobian(mesh));
    BOOST_TEST(smallest_jacobian(mesh) > 0);
    BOOST_TEST(boundaries_lie_on_the_geometry(mesh));
    if (previous > 0) {
      const double order = std::log2(previous / error);
      BOOST_TEST((3.8 < order && order < 4.2), "order " << order);
    }
    previous = error;
  }
}

BOOST_AUTO_TEST_CASE(the_full_mesh_is_the_half_and_its_mirror_image) {
  const Mesh half = cylinder_mesh({});
  const auto start = std::chrono::steady_clock::now();
  const Mesh full = cylinder_mesh(both_halves());
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  BOOST_TEST_MESSAGE(full.elements.size() << " elements, " << full.nodes.size() << " nodes in "
                                          << elapsed.count() << " s");
  BOOST_TEST(full.elements.size() == 42'276U);
  BOOST_TEST(!full.boundaries.contains("symmetry"));
  BOOST_TEST(full.boundaries.at("cylinder").size() == 160U);
  const auto on_axis = static_cast<std::size_t>(std::count_if(
      half.nodes.begin(), half.nodes.end(), [](const Vector2d& x) { return x[0] == 0; }));
  BOOST_TEST(full.nodes.size() == 2 * half.nodes.size() - on_axis);
  BOOST_TEST(smallest_jacobian(full) == smallest_jacobian(half),
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(measure(full) == 2 * measure(half), boost::test_tools::tolerance(1e-12));
  std::set<std::pair<double, double>> places;
  for (const Vector2d& x : full.nodes) places.insert({x[0], x[1]});
  BOOST_TEST(std::all_of(full.nodes.begin(), full.nodes.end(), [&](const Vector2d& x) {
    return places.contains({-x[0], x[1]});
  }));
}

BOOST_AUTO_TEST_CASE(one_node_moved_is_seen_by_the_checks) {
  const Mesh mesh = cylinder_mesh(refined_to(32));
  Mesh moved = mesh;
  const auto inside = static_cast<std::size_t>(mesh.elements.front()[8]);
  moved.nodes[inside] += Vector2d(0, 0.5);
  BOOST_TEST(smallest_jacobian(moved) < 0);
  Mesh dented = mesh;
  const Face face = mesh.boundaries.at("cylinder").front();
  dented.nodes[static_cast<std::size_t>(middle_node(mesh, face))] *= 1 + 1e-14;
  BOOST_TEST(!boundaries_lie_on_the_geometry(dented));
  Mesh torn = mesh;  // an element with a face of its own
  torn.nodes.push_back(torn.nodes[static_cast<std::size_t>(mesh.elements[0][5])]);
  torn.elements[0][5] = static_cast<Eigen::Index>(torn.nodes.size()) - 1;
  BOOST_TEST(!names_cover_all_outer_faces(torn));
  BOOST_TEST((has_duplicates(torn) && !has_duplicates(mesh)));
}

BOOST_AUTO_TEST_CASE(a_mesh_can_be_made_with_any_multiple_of_eight) {
  for (const int around : {8, 24, 40, 72, 88}) {
    const Mesh mesh = cylinder_mesh(both_halves(refined_to(around)));
    BOOST_TEST(smallest_jacobian(mesh) > 0);
    BOOST_TEST(names_cover_all_outer_faces(mesh));
    BOOST_TEST(mesh.boundaries.size() == 4U);
    BOOST_TEST(length(mesh, "wall") == 60, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(elements_are_counted_without_making_them) {
  for (const int around : {8, 16, 72, 160})
    for (const bool full : {false, true})
      for (const double outlet : {6.0, 15.0, 31.0}) {
        CylinderMeshOptions options = refined_to(around);
        options.full = full;
        options.outlet = outlet;
        BOOST_TEST(element_count(options) == cylinder_mesh(options).elements.size(),
                   around << " around, outlet at " << outlet);
      }
}

BOOST_AUTO_TEST_CASE(the_outlet_can_be_moved_in_without_a_change_above_it) {
  CylinderMeshOptions options = refined_to(80);
  const Mesh mesh = cylinder_mesh(options);
  options.outlet = 8;
  const Mesh shorter = cylinder_mesh(options);
  BOOST_TEST(boundaries_lie_on_the_geometry(shorter, 8));
  BOOST_TEST(length(shorter, "symmetry") == 22, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::abs(measure(shorter) - (230 - pi / 8)) < 1e-6);
  BOOST_TEST(mesh.elements.size() - shorter.elements.size() == 28U * 40);  // 0.25 wide and high
  BOOST_TEST(names_cover_all_outer_faces(shorter));
}

BOOST_AUTO_TEST_SUITE_END()
