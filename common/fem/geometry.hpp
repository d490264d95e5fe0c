// Isoparametric geometry: from reference coordinates of an element to physical space.
#pragma once

#include <vector>

#include <Eigen/LU>

#include "common/fem/mesh.hpp"
#include "common/fem/quadrature.hpp"

namespace talus::fem {

template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;

/// The map of an element at one reference point.
template <int Dim>
struct ElementPoint {
  static constexpr int nodes = fem::quadratic_nodes(Dim);
  Eigen::Matrix<double, nodes, 1> values;       ///< of the basis
  Eigen::Matrix<double, Dim, nodes> gradients;  ///< of the basis, in physical space
  Point<Dim> position;
  Eigen::Matrix<double, Dim, Dim> inverse_jacobian;  ///< dξ_i/dx_j
  double determinant = 0;                            ///< of dx/dξ

  ElementPoint(const Mesh<Dim>& mesh, std::size_t element, const Point<Dim>& reference) {
    const fem::QuadraticBasis<Dim> basis(reference);
    Eigen::Matrix<double, Dim, nodes> nodal;
    for (int a = 0; a < nodes; ++a)
      nodal.col(a) =
          mesh.nodes[static_cast<std::size_t>(mesh.elements[element][static_cast<std::size_t>(a)])];
    const Eigen::Matrix<double, Dim, Dim> jacobian = nodal * basis.gradients.transpose();
    inverse_jacobian = jacobian.inverse();
    determinant = jacobian.determinant();
    values = basis.values;
    gradients = inverse_jacobian.transpose() * basis.gradients;
    position = nodal * basis.values;
  }
};

/// A point of the tensor-product Gauss rule.
template <int Dim>
struct ReferencePoint {
  Point<Dim> position;
  double weight = 1;
};

/// The Gauss rule with so many points in each direction; the first coordinate runs fastest.
template <int Dim>
std::vector<ReferencePoint<Dim>> gauss_rule(int points_per_direction) {
  const auto line = fem::gauss_legendre(points_per_direction);
  std::size_t count = 1;
  for (int d = 0; d < Dim; ++d) count *= line.size();
  std::vector<ReferencePoint<Dim>> rule(count);
  for (std::size_t q = 0; q < count; ++q)
    for (std::size_t d = 0, index = q; d < Dim; ++d, index /= line.size()) {
      rule[q].position[static_cast<Eigen::Index>(d)] = line[index % line.size()].position;
      rule[q].weight *= line[index % line.size()].weight;
    }
  return rule;
}

/// A quadrature point of a side, as a point of its element.
template <int Dim>
struct FacePoint {
  Point<Dim> reference;
  Point<Dim> normal;  ///< outward, of length one
  double weight = 0;  ///< quadrature weight times the area of the side there
};

/// The Gauss points of a side; normal and area from Nanson's formula det(J) J^{-T} n.
template <int Dim>
std::vector<FacePoint<Dim>> face_rule(const Mesh<Dim>& mesh, const Face& face,
                                      int points_per_direction = 3) {
  std::vector<FacePoint<Dim>> points;
  const int axis = face.side / 2;
  const double outward = face.side % 2 ? 1 : -1;
  for (const auto& each : gauss_rule<Dim - 1>(points_per_direction)) {
    FacePoint<Dim> point;
    for (int d = 0, from = 0; d < Dim; ++d)
      point.reference[d] = d == axis ? outward : each.position[from++];
    const ElementPoint<Dim> at(mesh, face.element, point.reference);
    const Point<Dim> area = outward * at.determinant * at.inverse_jacobian.row(axis).transpose();
    point.normal = area.normalized();
    point.weight = each.weight * area.norm();
    points.push_back(point);
  }
  return points;
}

}  // namespace talus::fem
