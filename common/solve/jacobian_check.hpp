// Is the tangent the derivative of the residual? Taylor remainders, block by block, and entries.
//
// R(x + εv) - R(x) - εJv falls like ε² for a right tangent and like ε for a wrong one, whatever the
// problem, down to round-off. The slope is fitted over the smallest steps whose remainder stands
// clear of the computed round-off. Both directions ±v are tried and the smaller remainder counts: a
// kink of the law next to the state spoils one side, a wrong derivative both.
#pragma once

#include <functional>
#include <iosfwd>
#include <limits>
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

/// Relative to the size of its terms, and how much of it may be round-off; the value is infinite
/// where the system could not be solved.
struct SystemError {
  double value = 0, round_off = 0;
};

/// What is checked: a residual around a fixed state and its claimed derivative there.
struct JacobianProblem {
  Eigen::Index size = 0;
  std::function<Residual(const Eigen::VectorXd& displacement)> residual;
  std::function<Eigen::VectorXd(const Eigen::VectorXd& direction)> product;  ///< J v
  std::vector<Block> rows, columns;
  /// Displacement of each unknown over which the residual may curve: steps go down from there.
  /// Empty: 1 for all.
  Eigen::VectorXd scale = {};
  /// How far the system that Newton factors and solves is from the claimed derivative. Empty: it is
  /// not asked.
  std::function<SystemError()> system_error = {};
};

/// What a test has found out. Only `right` is a pass.
enum class Verdict {
  right,
  not_tested,     ///< not asked for, or hidden by round-off: a wrong derivative would look the same
  not_evaluated,  ///< the residual itself is no number: nothing can be said of its derivative
  wrong
};
/// "ok", "not tested", "not evaluated" or "WRONG".
std::string name_of(Verdict verdict);

/// Remainders over halving steps, for one block.
struct TaylorTest {
  std::string rows, columns;
  std::vector<double> steps, remainders, round_off;  ///< remainders in the units of the residual
  /// Of log remainder against log step; infinite where it never leaves round-off, NaN if unknown.
  double slope = std::numeric_limits<double>::quiet_NaN();
  /// Bound on the part of the remainder that falls like the step, relative to J v.
  double linear_part = std::numeric_limits<double>::quiet_NaN();
  /// Right: slope of at least 1.8 and a linear part of at most a per cent, or one of at most 1e-7.
  /// The latter where second and third order cancel within the window, as at rest.
  Verdict verdict = Verdict::not_tested;

  bool passed() const { return verdict == Verdict::right; }
  bool is_linear() const { return slope == std::numeric_limits<double>::infinity(); }
};

/// The entry that differs most from a difference, relative to its own size. What the difference
/// itself may be off by (its change with the step, the round-off of the residual) does not count.
struct EntryTest {
  Eigen::Index row = 0, column = 0;
  double analytic = 0, difference = 0;
  double worst = 0;
  Verdict verdict = Verdict::not_tested;  ///< right: worst at most 1e-6

  bool passed() const { return verdict == Verdict::right; }
};

/// JacobianProblem::system_error.
struct SystemTest {
  bool is_asked = false;
  double error = 0;
  Verdict verdict = Verdict::not_tested;  ///< right: at most 1e-6 beyond round-off
};

struct JacobianCheck {
  std::vector<TaylorTest> blocks;  ///< first the whole matrix, then every block
  EntryTest entries;
  SystemTest system;

  /// The worst of all that was asked, wrong first: one thing untested is not a pass.
  Verdict verdict() const;
  bool passed() const { return verdict() == Verdict::right; }
  /// Over all blocks: infinite if all are linear, NaN if one is unknown.
  double smallest_slope() const;
};

/// A check at a named state.
struct NamedCheck {
  std::string state;
  JacobianCheck check;
};

/// Blocks, entries and the system. Random directions (fixed seed) of `scale` times the problem's
/// own in every column block; entries that share no row are differenced together.
JacobianCheck check_jacobian(const JacobianProblem& problem, double scale = 1, unsigned seed = 1);

/// The blocks alone, the entries and the system left untested: the check as a whole cannot pass.
JacobianCheck check_blocks(const JacobianProblem& problem, double scale = 1, unsigned seed = 1);

/// One line a block, one for the entries and one for the system.
void print(std::ostream& out, const JacobianCheck& check);

}  // namespace talus::solve
