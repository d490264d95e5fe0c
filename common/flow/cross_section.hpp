// The finite-element space of unidirectional flow: quadratic elements on a cross-section of any
// dimension, interior nodes condensed.
//
// The velocity w(x) along the flow solves div(A grad w) + f = 0 with a point tangent A; both Newton
// and the interior point build their linear systems here from values at the quadrature points.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/fem/lagrange.hpp"
#include "common/solve/compensated_vector.hpp"
#include "common/solve/tridiagonal.hpp"

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

/// The global system left when interior nodes are condensed.
template <int Dim>
class Skeleton;

/// On a line: velocities of the vertices and fluxes of the elements, in turn from a fixed end.
/// With stiffness k an element says q/k - (w_right - w_left) = 0 and a vertex Σ q = b: a symmetric
/// tridiagonal system whose pivots are sums of compliances 1/k. The usual one in w alone cancels
/// them: where a plug (k ~ μs p/λr) meets the flow, k_plug + k_flow - k_plug loses all digits of
/// k_flow once λr h is small enough.
template <>
class Skeleton<1> {
 public:
  explicit Skeleton(const Mesh<1>& mesh);
  void set_zero() {}
  /// The condensed matrix of an element is k [1 -1; -1 1].
  void add(std::size_t element, const Eigen::Matrix2d& matrix);
  /// Solves for the vertices from the forces on them; velocities of fixed vertices are zero.
  bool solve(const Eigen::VectorXd& force, solve::CompensatedVector& velocity) const;

 private:
  struct Row {
    Eigen::Index node = -1;  // of a velocity row; -1 for a flux row
    Eigen::Index from = -1;  // of a flux row: the vertices of its element, in order of elimination
    Eigen::Index to = -1;
  };
  std::vector<Row> rows_;
  std::vector<Eigen::Index> row_of_element_;
  solve::TridiagonalMatrix matrix_;
};

template <int Dim>
class CrossSection {
 public:
  static constexpr int nodes_per_element = fem::quadratic_nodes(Dim);
  static constexpr int interior = (nodes_per_element - 1) / 2;
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Tangent = Eigen::Matrix<double, Dim, Dim>;
  using NodalValues = Eigen::Matrix<double, nodes_per_element, 1>;
  using LongNodalValues = Eigen::Matrix<long double, nodes_per_element, 1>;

  /// One quadrature point of one element.
  struct Point {
    Eigen::Matrix<double, Dim, nodes_per_element> gradients;  ///< of the basis, in physical space
    NodalValues values;
    Vector position;
    double weight = 0;  ///< quadrature weight times the area of the element there

    /// grad w from relative velocities. Where a stiff point shares its element with soft ones, its
    /// gradient is what two large slopes leave: summed in extended precision.
    Vector gradient(const LongNodalValues& relative) const {
      return (gradients.template cast<long double>() * relative).template cast<double>();
    }
  };

  explicit CrossSection(Mesh<Dim> mesh, int points_per_direction = 3);

  const Mesh<Dim>& mesh() const { return mesh_; }
  Eigen::Index node_count() const { return static_cast<Eigen::Index>(mesh_.nodes.size()); }
  std::size_t element_count() const { return mesh_.elements.size(); }
  std::size_t points_per_element() const { return points_.size() / mesh_.elements.size(); }
  /// All quadrature points, those of an element together.
  const std::vector<Point>& points() const { return points_; }

  /// Nodal velocities of an element relative to its interior node: their gradient is the same, and
  /// the differences are exact where velocities hardly differ.
  LongNodalValues relative_velocities(const solve::CompensatedVector& w,
                                      std::size_t element) const {
    const auto& nodes = mesh_.elements[element];
    LongNodalValues d;
    for (int a = 0; a < nodes_per_element; ++a)
      d[a] = w.difference(nodes[static_cast<std::size_t>(a)], nodes[interior]);
    return d;
  }
  /// grad w at every quadrature point.
  void gradients(const solve::CompensatedVector& w, std::vector<Vector>& g) const;
  /// Σ weight Gᵀτ at every node; zero at fixed nodes.
  Eigen::VectorXd internal_force(std::span<const Vector> stress) const;
  /// ∫ f N at every node; zero at fixed nodes.
  Eigen::VectorXd load(const std::function<double(const Vector&)>& f) const;

  /// Assembles ∫ grad v · A grad w from symmetric point tangents and condenses interior nodes.
  void assemble(std::span<const Tangent> tangents);
  /// Solves the system last assembled; false if it is singular or the solution not finite.
  bool solve(const Eigen::VectorXd& right_hand_side, solve::CompensatedVector& solution) const;
  /// The product of the uncondensed matrix of these point tangents with x; zero at fixed nodes.
  Eigen::VectorXd product(std::span<const Tangent> tangents,
                          const solve::CompensatedVector& x) const;
  void clear_fixed(Eigen::VectorXd& values) const;

 private:
  Mesh<Dim> mesh_;
  std::vector<Point> points_;
  Skeleton<Dim> skeleton_;
  std::vector<NodalValues> interior_rows_;  // of the element matrices, divided by the pivot
  std::vector<double> interior_pivots_;
};

extern template class CrossSection<1>;

}  // namespace talus::flow
