// Sparse LU for matrices with a symmetric pattern and unsymmetric values: UMFPACK, symmetric
// strategy, nested dissection by METIS on the graph of the nodes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/SparseCore>

namespace talus::solve {

/// Factors matrices that share one pattern; the analysis is done once.
class SparseLu {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

  /// Analyses the pattern (compressed, symmetric). `node_of_row` groups the unknowns of a mesh
  /// node, numbered from 0: the graph to order is then that of the nodes, several times smaller.
  /// Throws OutOfMemory, and std::runtime_error if the analysis fails otherwise.
  SparseLu(const Matrix& pattern, const std::vector<int>& node_of_row);
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;

  /// False if the matrix is singular. Throws OutOfMemory. `matrix` must outlive the solves.
  bool factor(const Matrix& matrix);
  /// x with A x = b, without refinement; false if x is not finite. Throws OutOfMemory.
  bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  /// Sign of det A of the matrix last factored: -1, 0 or 1.
  int determinant_sign() const;
  /// Stored entries of L and U; 0 before the first factorisation.
  double factor_entries() const;
  /// How many solves cost as much as the last factorisation: counted in operations, so the same on
  /// every run.
  double solves_per_factorisation() const;

 private:
  struct Factors;  // keeps UMFPACK out of this header
  std::unique_ptr<Factors> factors_;
};

}  // namespace talus::solve
