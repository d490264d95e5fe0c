// Quadratic Lagrange bases: P2 on the line and their tensor products, Q9 and H27.
#pragma once

#include <array>

#include <Eigen/Core>

namespace talus::fem {

/// Values of the basis with nodes -1, 0, 1 at x.
inline std::array<double, 3> quadratic_basis(double x) {
  // course 6: shape functions
  return {0.5 * x * (x - 1), (1 - x) * (1 + x), 0.5 * x * (x + 1)};
  // end of course 6
}

/// Derivatives with respect to x.
inline std::array<double, 3> quadratic_basis_derivative(double x) {
  // course 6: shape functions
  return {x - 0.5, -2 * x, x + 0.5};
  // end of course 6
}

/// 3^dim: nodes of the quadratic tensor-product element.
constexpr int quadratic_nodes(int dim) {
  return dim == 0 ? 1 : 3 * quadratic_nodes(dim - 1);
}

/// All basis functions of the tensor-product element at one reference point.
/// Node i + 3j + 9k sits at (i - 1, j - 1, k - 1); node (3^dim - 1)/2 is interior.
template <int Dim>
struct QuadraticBasis {
  static constexpr int nodes = quadratic_nodes(Dim);
  Eigen::Matrix<double, nodes, 1> values;
  Eigen::Matrix<double, Dim, nodes> gradients;  ///< with respect to the reference coordinates

  explicit QuadraticBasis(const Eigen::Matrix<double, Dim, 1>& x) {
    for (int node = 0; node < nodes; ++node) {
      values[node] = 1;
      gradients.col(node).setOnes();
      // course 6: shape functions
      for (int d = 0, index = node; d < Dim; ++d, index /= 3) {
        const auto k = static_cast<std::size_t>(index % 3);
        const double value = quadratic_basis(x[d])[k];
        values[node] *= value;
        for (int other = 0; other < Dim; ++other)
          gradients(other, node) *= other == d ? quadratic_basis_derivative(x[d])[k] : value;
      }
      // end of course 6
    }
  }
};

}  // namespace talus::fem
