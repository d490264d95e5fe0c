// The claimed derivative as a matrix, and its entries against differences.
#pragma once

#include <Eigen/SparseCore>

#include "common/solve/jacobian_check.hpp"

namespace talus::solve {

/// The claimed derivative, column by column; a NaN is an entry.
Eigen::SparseMatrix<double> claimed_matrix(const JacobianProblem& problem);

/// Every entry of the claimed matrix in `problem.columns`, with displacements of `scale`.
EntryTest test_entries(const JacobianProblem& problem, const Eigen::SparseMatrix<double>& claimed,
                       const Eigen::VectorXd& scale);

}  // namespace talus::solve
