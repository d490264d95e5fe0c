// Symmetric tridiagonal systems, solved by GSL.
#pragma once

#include <Eigen/Core>

namespace talus::solve {

/// The matrix of the vertices of a line mesh: diagonal (n) and off-diagonal (n - 1).
struct TridiagonalMatrix {
  Eigen::VectorXd diagonal, off_diagonal;
};

/// x = A⁻¹ b. False where GSL meets a zero pivot or the result is not finite.
bool solve_tridiagonal(const TridiagonalMatrix& matrix, const Eigen::VectorXd& b,
                       Eigen::VectorXd& x);

}  // namespace talus::solve
