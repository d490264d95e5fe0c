// Sparse Cholesky factors of symmetric positive definite matrices: CHOLMOD, supernodal.
#pragma once

#include <cstdint>
#include <memory>

#include <Eigen/SparseCore>

namespace talus::solve {

/// Factors matrices that share one pattern; the analysis is done once.
class SparseCholesky {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, std::int64_t>;

  /// Analyses the pattern of a lower triangle (compressed). Throws OutOfMemory.
  explicit SparseCholesky(const Matrix& lower_triangle);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;

  /// False if the matrix is not positive definite. Throws OutOfMemory.
  bool factor(const Matrix& lower_triangle);
  /// x with A x = b; false without factors or if x is not finite. Throws OutOfMemory.
  bool solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const;
  /// Entries of the factor, as analysed.
  double factor_entries() const;

 private:
  struct Factors;  // keeps CHOLMOD out of this header
  std::unique_ptr<Factors> factors_;
};

}  // namespace talus::solve
