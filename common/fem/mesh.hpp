// Meshes of quadratic tensor-product elements, with named boundaries.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/fem/lagrange.hpp"

namespace talus::fem {

/// A side of an element: 2d where reference coordinate d is -1, 2d + 1 where it is 1.
struct Face {
  std::size_t element = 0;
  int side = 0;
};

/// A mesh of quadratic elements, node i + 3j + 9k of an element at its reference coordinates
/// (i - 1, j - 1, k - 1); lengths in L. `fixed` marks the nodes without slip of a
/// cross-section; velocity-pressure flow takes its conditions by the name of the boundary.
template <int Dim>
struct Mesh {
  static constexpr int nodes_per_element = fem::quadratic_nodes(Dim);
  std::vector<Eigen::Matrix<double, Dim, 1>> nodes;
  std::vector<std::array<Eigen::Index, nodes_per_element>> elements;
  std::vector<bool> fixed;
  std::map<std::string, std::vector<Face>> boundaries;
};

/// Nodes of a side within an element, in the order of the remaining reference coordinates.
template <int Dim>
std::array<std::size_t, fem::quadratic_nodes(Dim - 1)> face_nodes(int side) {
  std::array<std::size_t, fem::quadratic_nodes(Dim - 1)> nodes{};
  const std::size_t stride = static_cast<std::size_t>(fem::quadratic_nodes(side / 2));
  std::size_t found = 0;
  for (std::size_t node = 0; node < Mesh<Dim>::nodes_per_element; ++node)
    if (node / stride % 3 == (side % 2 ? 2u : 0u)) nodes[found++] = node;
  return nodes;
}

/// The box of these element boundaries along each axis, a node in the middle of each element; nodes
/// and elements are numbered along the first axis first, none is fixed. Boundaries: "left", "right"
/// (ends of the first axis), "bottom", "top" (of the second), "back", "front" (of the third).
template <int Dim>
Mesh<Dim> tensor_mesh(const std::array<std::span<const double>, Dim>& boundaries);

/// A point of a mesh: an element and reference coordinates within it.
template <int Dim>
struct Place {
  std::size_t element = 0;
  Eigen::Matrix<double, Dim, 1> reference;
};

/// Where in the tensor mesh of these boundaries a position lies; outside, in the nearest element.
template <int Dim>
Place<Dim> locate(const std::array<std::span<const double>, Dim>& boundaries,
                  const Eigen::Matrix<double, Dim, 1>& position) {
  Place<Dim> place;
  for (std::size_t d = Dim; d-- > 0;) {
    const auto line = boundaries[d];
    const auto i = static_cast<Eigen::Index>(d);
    const auto after = std::upper_bound(line.begin() + 1, line.end() - 1, position[i]);
    const double start = *(after - 1), end = *after;
    place.reference[i] = (2 * position[i] - start - end) / (end - start);
    place.element =
        place.element * (line.size() - 1) + static_cast<std::size_t>(after - line.begin() - 1);
  }
  return place;
}

Mesh<1> line_mesh(std::span<const double> boundaries, bool fixed_at_start, bool fixed_at_end);

/// `is_fixed` decides by position.
Mesh<2> rectangle_mesh(std::span<const double> first, std::span<const double> second,
                       const std::function<bool(const Eigen::Vector2d&)>& is_fixed);

Mesh<3> box_mesh(std::span<const double> first, std::span<const double> second,
                 std::span<const double> third);

/// A sector of an annulus from the angle `start` to `end` (> start), its nodes on true circles.
/// Boundaries: "inner", "outer", "start", "end".
Mesh<2> annulus_mesh(double inner_radius, double outer_radius, int around, int layers,
                     double start = 0, double end = 0.5 * std::numbers::pi);

}  // namespace talus::fem
