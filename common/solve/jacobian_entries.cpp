#include "common/solve/jacobian_entries.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/solve/extremes.hpp"

namespace talus::solve {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Columns = std::vector<Eigen::Index>;

constexpr double largest_passing_error = 1e-6;
constexpr double smallest_resolution = 1e-3;  // of an entry: an error of a per cent is then seen
constexpr double negligible = 1e-4;           // of the largest in its row: a per cent is 1e-6 then
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();  // of claimed entries
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Columns columns_of(const JacobianProblem& problem) {
  Columns all;
  for (const Block& block : problem.columns)
    all.insert(all.end(), block.indices.begin(), block.indices.end());
  return all;
}

// Columns that share no row of the claimed matrix: one difference shows them all. An entry that the
// matrix lacks shows up in a row of another.
std::vector<Columns> groups_of(const Matrix& claimed, const Columns& columns) {
  std::vector<Columns> groups;
  std::vector<std::vector<bool>> is_taken(static_cast<std::size_t>(claimed.rows()));  // by group
  for (const Eigen::Index column : columns) {
    const auto is_free = [&](std::size_t group) {
      for (Matrix::InnerIterator entry(claimed, column); entry; ++entry) {
        const auto& taken = is_taken[static_cast<std::size_t>(entry.row())];
        if (group < taken.size() && taken[group]) return false;
      }
      return true;
    };
    std::size_t group = 0;
    while (!is_free(group)) ++group;
    if (group >= groups.size()) groups.resize(group + 1);
    groups[group].push_back(column);
    for (Matrix::InnerIterator entry(claimed, column); entry; ++entry) {
      auto& taken = is_taken[static_cast<std::size_t>(entry.row())];
      if (taken.size() <= group) taken.resize(group + 1, false);
      taken[group] = true;
    }
  }
  return groups;
}

// A difference quotient over falling steps: its value where the estimated error is smallest, that
// error being the change from the steps before plus the round-off of the residual. The claimed
// derivative has no say in it.
class Difference {
 public:
  void add(double value, double round_off) {
    const double change = std::abs(value - last_);
    const double error = change + 0.1 * last_change_ + round_off;
    if (error < error_) {
      error_ = error;
      value_ = value;
    }
    last_ = value;
    last_change_ = change;
  }
  double value() const { return value_; }
  double error() const { return error_; }

 private:
  double last_ = not_a_number, last_change_ = not_a_number, value_ = not_a_number;
  double error_ = std::numeric_limits<double>::infinity();
};

// Central, and from one side: a kink of the law next to the state spoils all but one of them.
using Differences = std::array<Difference, 3>;

std::vector<Differences> differences_along(const JacobianProblem& problem,
                                           const Eigen::VectorXd& direction) {
  constexpr int steps = 20;
  std::vector<Differences> rows(static_cast<std::size_t>(problem.size));
  const Residual start = problem.residual(Eigen::VectorXd::Zero(problem.size));
  for (int k = 0; k < steps; ++k) {
    const double step = std::pow(10.0, -0.5 * k);
    const Residual up = problem.residual(step * direction);
    const Residual down = problem.residual(-step * direction);
    for (Eigen::Index i = 0; i < problem.size; ++i) {
      const double u = up.value[i], d = down.value[i], s = start.value[i];
      const double r = nan_max(up.round_off[i], down.round_off[i]) + start.round_off[i];
      auto& [central, forward, backward] = rows[static_cast<std::size_t>(i)];
      central.add((u - d) / (2 * step), r / step);
      forward.add((u - s) / step, r / step);
      backward.add((s - d) / step, r / step);
    }
  }
  return rows;
}

// The worst entry so far, and whether all could be seen.
struct Tally {
  EntryTest worst{.worst = -1};  // none yet
  bool is_seen = true, is_evaluated = true;

  void add(const EntryTest& entry) {
    if (std::isnan(worst.worst)) return;
    const bool is_larger = std::abs(entry.analytic) > std::abs(worst.analytic);
    if (!(entry.worst <= worst.worst) || (entry.worst == worst.worst && is_larger)) worst = entry;
  }
  void add(const Tally& other) {
    add(other.worst);
    is_seen = is_seen && other.is_seen;
    is_evaluated = is_evaluated && other.is_evaluated;
  }
};

// Entries of columns that share no row; `largest_in_row` in units of the scaled matrix.
Tally test_group(const JacobianProblem& problem, const Matrix& claimed, const Columns& columns,
                 const Eigen::VectorXd& scale, const Eigen::VectorXd& largest_in_row) {
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(problem.size);
  Eigen::VectorXd analytic = direction;
  Columns owner(static_cast<std::size_t>(problem.size), columns.front());
  for (const Eigen::Index column : columns) {
    direction[column] = scale[column];
    for (Matrix::InnerIterator entry(claimed, column); entry; ++entry) {
      analytic[entry.row()] = entry.value() * scale[column];
      owner[static_cast<std::size_t>(entry.row())] = column;
    }
  }
  Tally tally;
  const std::vector<Differences> differences = differences_along(problem, direction);
  for (const Block& rows : problem.rows)
    for (const Eigen::Index row : rows.indices) {
      const auto& each = differences[static_cast<std::size_t>(row)];
      const double value = analytic[row];
      double error = std::numeric_limits<double>::infinity(), difference = each[0].value();
      bool is_seen = false, is_evaluated = false;
      for (const Difference& d : each) {
        if (std::isnan(d.value())) continue;
        is_evaluated = true;
        const double size = std::max(std::abs(value), std::abs(d.value()));
        const double off = std::abs(d.value() - value) - d.error() - rounding * largest_in_row[row];
        const double relative = off > 0 || std::isnan(off) ? off / size : 0;
        is_seen = is_seen || value == 0 || d.error() <= smallest_resolution * size ||
                  size <= negligible * largest_in_row[row];
        if (relative < error) difference = d.value();
        error = std::isnan(relative) ? relative : std::min(error, relative);
      }
      tally.is_evaluated = tally.is_evaluated && is_evaluated;
      tally.is_seen = tally.is_seen && is_seen;
      const Eigen::Index column = owner[static_cast<std::size_t>(row)];
      if (is_evaluated)
        tally.add(EntryTest{row, column, value / scale[column], difference / scale[column], error});
    }
  return tally;
}

}  // namespace

Matrix claimed_matrix(const JacobianProblem& problem) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Eigen::Index column : columns_of(problem)) {
    const Eigen::VectorXd values = problem.product(Eigen::VectorXd::Unit(problem.size, column));
    for (Eigen::Index row = 0; row < problem.size; ++row)
      if (values[row] != 0)
        entries.emplace_back(static_cast<int>(row), static_cast<int>(column), values[row]);
  }
  Matrix matrix(problem.size, problem.size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

EntryTest test_entries(const JacobianProblem& problem, const Matrix& claimed,
                       const Eigen::VectorXd& scale) {
  if (!problem.residual(Eigen::VectorXd::Zero(problem.size)).value.allFinite())
    return {.verdict = Verdict::not_evaluated};
  Eigen::VectorXd largest_in_row = Eigen::VectorXd::Zero(problem.size);
  for (const Eigen::Index column : columns_of(problem))
    for (Matrix::InnerIterator entry(claimed, column); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        return {entry.row(), column, entry.value(), not_a_number, not_a_number, Verdict::wrong};
      largest_in_row[entry.row()] =
          nan_max(largest_in_row[entry.row()], std::abs(entry.value()) * scale[column]);
    }
  Tally all;
  for (const Columns& columns : groups_of(claimed, columns_of(problem))) {
    Tally group = test_group(problem, claimed, columns, scale, largest_in_row);
    if (columns.size() > 1 && !(group.worst.worst <= largest_passing_error)) {
      group = {};  // one of them: which?
      for (const Eigen::Index column : columns)
        group.add(test_group(problem, claimed, {column}, scale, largest_in_row));
    }
    all.add(group);
  }
  EntryTest result = all.worst;
  result.verdict = !(result.worst <= largest_passing_error) ? Verdict::wrong
                   : !all.is_evaluated                      ? Verdict::not_evaluated
                   : !all.is_seen || result.worst < 0       ? Verdict::not_tested
                                                            : Verdict::right;
  return result;
}

}  // namespace talus::solve
