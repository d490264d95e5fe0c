// Meshes of quadratic tensor-product elements for cross-sections.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/fem/lagrange.hpp"

namespace talus::flow {

/// A mesh of quadratic elements; lengths in L. `fixed` marks the nodes without slip.
template <int Dim>
struct Mesh {
  static constexpr int nodes_per_element = fem::quadratic_nodes(Dim);
  std::vector<Eigen::Matrix<double, Dim, 1>> nodes;
  std::vector<std::array<Eigen::Index, nodes_per_element>> elements;
  std::vector<bool> fixed;
};

/// The line with these element boundaries, a node in the middle of each element.
Mesh<1> line_mesh(std::span<const double> boundaries, bool fixed_at_start, bool fixed_at_end);

/// The rectangle of these element boundaries in both directions; node i + 3j of an element lies at
/// the i-th place along the first and the j-th along the second. `is_fixed` decides by position.
Mesh<2> rectangle_mesh(std::span<const double> first, std::span<const double> second,
                       const std::function<bool(const Eigen::Vector2d&)>& is_fixed);

}  // namespace talus::flow
