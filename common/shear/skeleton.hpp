// The global system of a cross-section, interior nodes condensed.
#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>

#include "common/fem/mesh.hpp"
#include "common/solve/compensated_vector.hpp"
#include "common/solve/tridiagonal.hpp"

namespace talus::shear {

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
  explicit Skeleton(const fem::Mesh<1>& mesh);
  void set_zero() {}
  /// The condensed matrix of an element is k [1 -1; -1 1].
  void add(std::size_t element, const Eigen::Matrix2d& matrix);
  /// Solves for the vertices from the forces on them; velocities of fixed vertices are zero.
  bool solve(const Eigen::VectorXd& force, solve::CompensatedVector& velocity) const;
  bool factor() { return true; }  // the tridiagonal solver does it all at once
  double factor_entries() const { return 3 * static_cast<double>(rows_.size()); }

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

/// On a surface: the nodes on the edges of the elements, a sparse positive definite system for
/// CHOLMOD's supernodal factorisation. The pattern is analysed once.
template <>
class Skeleton<2> {
 public:
  explicit Skeleton(const fem::Mesh<2>& mesh);
  ~Skeleton();
  Skeleton(Skeleton&&) noexcept;
  Skeleton& operator=(Skeleton&&) noexcept;

  void set_zero();
  /// Adds the condensed matrix of an element, rows in the order of its nodes without the middle
  /// one.
  void add(std::size_t element, const Eigen::Matrix<double, 8, 8>& matrix);
  /// False if the matrix is not positive definite. Throws solve::OutOfMemory.
  bool factor();
  /// Entries of the factor, as analysed.
  double factor_entries() const;
  /// Solves for the free edge nodes from the forces on them; fixed nodes get zero.
  bool solve(const Eigen::VectorXd& force, solve::CompensatedVector& velocity) const;

 private:
  struct System;  // keeps CHOLMOD out of this header
  std::unique_ptr<System> system_;
};

}  // namespace talus::shear
