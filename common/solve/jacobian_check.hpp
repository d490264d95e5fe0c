// Is the tangent the derivative of the residual? Taylor remainders, block by block, and entries.
//
// R(x + εv) - R(x) - εJv falls like ε² for a right tangent and like ε for a wrong one, whatever the
// problem. The slope is fitted where the remainder still stands clear of the computed round-off.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/solve/newton.hpp"

namespace talus::solve {

/// A named set of rows or columns.
struct Block {
  std::string name;
  std::vector<Eigen::Index> indices;
};

/// What is checked: a residual around a fixed state and its claimed derivative there.
struct JacobianProblem {
  Eigen::Index size = 0;
  std::function<Residual(const Eigen::VectorXd& displacement)> residual;
  std::function<Eigen::VectorXd(const Eigen::VectorXd& direction)> product;  ///< J v
  std::vector<Block> rows, columns;
};

/// Remainders over halving steps, for one block.
struct TaylorTest {
  std::string rows, columns;
  std::vector<double> steps, remainders, round_off;  ///< remainders in the units of the residual
  double slope = 0;     ///< of log remainder against log step; NaN where it never leaves round-off
  bool passed = false;  ///< slope of at least 1.8, or no remainder at all

  bool is_linear() const { return !(slope == slope); }
};

/// The entry that differs most from a central difference, in units of its column's largest entry.
struct EntryTest {
  Eigen::Index row = 0, column = 0;
  double analytic = 0, difference = 0;
  double worst = 0;
  bool passed = false;  ///< worst below 1e-5
};

struct JacobianCheck {
  std::vector<TaylorTest> blocks;  ///< first the whole matrix, then every block
  EntryTest entries;
  bool passed() const;
  double smallest_slope() const;  ///< over the blocks that are not linear; NaN if all are
};

/// Random directions (fixed seed) of the size `scale` in every column block.
JacobianCheck check_jacobian(const JacobianProblem& problem, double scale = 1, unsigned seed = 1);

/// The blocks alone; the entries, two evaluations a step of each column, pass untested.
JacobianCheck check_blocks(const JacobianProblem& problem, double scale = 1, unsigned seed = 1);

/// One line a block and one for the entries.
void print(std::ostream& out, const JacobianCheck& check);

}  // namespace talus::solve
