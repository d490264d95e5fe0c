#include "common/solve/jacobian_check.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <ostream>
#include <random>

#include <gsl/gsl_fit.h>

namespace talus::solve {
namespace {

constexpr double smallest_passing_slope = 1.8;
constexpr double largest_passing_entry_error = 1e-5;
constexpr double smallest_size = std::numeric_limits<double>::min();  // keeps 0/0 out of ratios

double largest(const Eigen::VectorXd& v, const std::vector<Eigen::Index>& rows) {
  double result = 0;
  for (const Eigen::Index i : rows) result = std::max(result, std::abs(v[i]));
  return result;
}

// Slope over the smallest steps whose remainder is clear of round-off: there a wrong derivative has
// nowhere to hide behind curvature.
void fit_slope(TaylorTest& test) {
  constexpr double clear_of_round_off = 30;
  constexpr std::size_t window = 8, fewest = 3;
  std::vector<double> x, y;
  for (std::size_t i = test.steps.size(); i-- > 0 && x.size() < window;) {
    if (test.remainders[i] <= clear_of_round_off * test.round_off[i]) {
      x.clear();
      y.clear();
      continue;
    }
    x.push_back(std::log(test.steps[i]));
    y.push_back(std::log(test.remainders[i]));
  }
  if (x.size() < fewest) {
    test.slope = std::numeric_limits<double>::quiet_NaN();
    test.passed = true;
    return;
  }
  double intercept, c00, c01, c11, sum;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &test.slope, &c00, &c01, &c11,
                 &sum);
  test.passed = test.slope >= smallest_passing_slope;
}

TaylorTest taylor_test(const JacobianProblem& problem, const Block& rows, const Block& columns,
                       double scale, std::mt19937& random) {
  constexpr int halvings = 56;
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(problem.size);
  for (const Eigen::Index i : columns.indices) direction[i] = scale * uniform(random);
  const Residual start = problem.residual(Eigen::VectorXd::Zero(problem.size));
  const Eigen::VectorXd product = problem.product(direction);
  TaylorTest test{rows.name, columns.name, {}, {}, {}, 0, false};
  for (int k = 0; k < halvings; ++k) {
    const double step = std::ldexp(1.0, -k);
    const Residual moved = problem.residual(step * direction);
    const Eigen::VectorXd remainder = moved.value - start.value - step * product;
    const Eigen::VectorXd round_off = moved.round_off + start.round_off;
    test.steps.push_back(step);
    test.remainders.push_back(largest(remainder, rows.indices));
    test.round_off.push_back(largest(round_off, rows.indices));
  }
  fit_slope(test);
  return test;
}

// The column of central differences at the step with the smallest estimated relative error: the
// change from the step before plus the round-off of the residual, whatever the claimed derivative
// says.
Eigen::VectorXd difference_column(const JacobianProblem& problem, Eigen::Index column,
                                  double scale) {
  constexpr int steps = 32;
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(problem.size, column);
  Eigen::VectorXd best, last;
  double smallest_error = std::numeric_limits<double>::infinity();
  for (int k = 1; k <= steps; ++k) {
    const double step = scale * std::pow(10.0, -0.5 * k);
    const Residual up = problem.residual(step * unit), down = problem.residual(-step * unit);
    const Eigen::VectorXd now = (up.value - down.value) / (2 * step);
    if (k > 1) {
      const double round_off =
          (up.round_off + down.round_off).lpNorm<Eigen::Infinity>() / (2 * step);
      const double error = ((now - last).lpNorm<Eigen::Infinity>() + round_off) /
                           std::max(now.lpNorm<Eigen::Infinity>(), smallest_size);
      if (error < smallest_error) {
        smallest_error = error;
        best = now;
      }
    }
    last = now;
  }
  return best;
}

EntryTest entry_test(const JacobianProblem& problem, double scale) {
  EntryTest worst;
  for (Eigen::Index column = 0; column < problem.size; ++column) {
    const Eigen::VectorXd analytic = problem.product(Eigen::VectorXd::Unit(problem.size, column));
    const Eigen::VectorXd difference = difference_column(problem, column, scale);
    const double size =
        std::max({analytic.lpNorm<Eigen::Infinity>(), difference.lpNorm<Eigen::Infinity>(),
                  std::numeric_limits<double>::min()});
    Eigen::Index row;
    const double error = (difference - analytic).cwiseAbs().maxCoeff(&row) / size;
    if (error > worst.worst) worst = {row, column, analytic[row], difference[row], error, false};
  }
  worst.passed = worst.worst < largest_passing_entry_error;
  return worst;
}

Block all_of(const std::vector<Block>& blocks) {
  Block all{"all", {}};
  for (const Block& block : blocks)
    all.indices.insert(all.indices.end(), block.indices.begin(), block.indices.end());
  return all;
}

}  // namespace

bool JacobianCheck::passed() const {
  return entries.passed &&
         std::all_of(blocks.begin(), blocks.end(), [](const TaylorTest& t) { return t.passed; });
}

double JacobianCheck::smallest_slope() const {
  double smallest = std::numeric_limits<double>::quiet_NaN();
  for (const TaylorTest& block : blocks)
    if (!block.is_linear()) smallest = std::fmin(smallest, block.slope);
  return smallest;
}

JacobianCheck check_blocks(const JacobianProblem& problem, double scale, unsigned seed) {
  std::mt19937 random(seed);
  JacobianCheck check;
  check.blocks.push_back(
      taylor_test(problem, all_of(problem.rows), all_of(problem.columns), scale, random));
  for (const Block& rows : problem.rows)
    for (const Block& columns : problem.columns)
      check.blocks.push_back(taylor_test(problem, rows, columns, scale, random));
  check.entries.passed = true;
  return check;
}

JacobianCheck check_jacobian(const JacobianProblem& problem, double scale, unsigned seed) {
  JacobianCheck check = check_blocks(problem, scale, seed);
  check.entries = entry_test(problem, scale);
  return check;
}

void print(std::ostream& out, const JacobianCheck& check) {
  const auto flags = out.flags();
  for (const TaylorTest& test : check.blocks) {
    out << "  " << std::left << std::setw(32) << (test.rows + " / " + test.columns) << " slope ";
    if (test.is_linear())
      out << "linear";
    else
      out << std::fixed << std::setprecision(3) << test.slope << " ";
    out << (test.passed ? "  ok" : "  WRONG") << '\n';
  }
  out << "  worst entry (" << check.entries.row << ", " << check.entries.column
      << "): " << std::scientific << std::setprecision(6) << check.entries.analytic
      << " against difference " << check.entries.difference << ", off by " << std::setprecision(1)
      << check.entries.worst << (check.entries.passed ? "  ok" : "  WRONG") << '\n';
  out.flags(flags);
}

}  // namespace talus::solve
