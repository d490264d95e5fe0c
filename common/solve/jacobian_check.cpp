#include "common/solve/jacobian_check.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <ostream>
#include <random>

#include <gsl/gsl_fit.h>

#include "common/solve/extremes.hpp"
#include "common/solve/jacobian_entries.hpp"

namespace talus::solve {
namespace {

constexpr double smallest_passing_slope = 1.8;
constexpr double largest_passing_linear_part = 1e-7;
constexpr double largest_passing_system_error = 1e-6;
constexpr double clear_of_round_off = 30;
constexpr int halvings = 48;

double largest(const Eigen::VectorXd& v, const std::vector<Eigen::Index>& rows) {
  double result = 0;
  for (const Eigen::Index i : rows) result = nan_max(result, std::abs(v[i]));
  return result;
}

// What one direction of displacements shows of every row.
struct Probe {
  bool is_evaluated = true;  // at the state and for small steps; large ones may leave the domain
  Eigen::VectorXd product;   // J v
  std::vector<double> steps;
  std::vector<Eigen::VectorXd> remainders, round_off;  // by step, not finite ones left out
};

Probe probe(const JacobianProblem& problem, const Eigen::SparseMatrix<double>& claimed,
            const Eigen::VectorXd& direction) {
  constexpr double product_roundings = 8 * std::numeric_limits<double>::epsilon();
  Probe probe;
  probe.product = problem.product(direction);
  const Eigen::VectorXd product_size = claimed.cwiseAbs() * direction.cwiseAbs();
  const Residual start = problem.residual(Eigen::VectorXd::Zero(problem.size));
  probe.is_evaluated = start.value.allFinite();
  for (int k = 0; k < halvings; ++k) {
    const double step = std::ldexp(1.0, -k);
    const Residual up = problem.residual(step * direction);
    const Residual down = problem.residual(-step * direction);
    if (!up.value.allFinite() || !down.value.allFinite()) {
      if (k > halvings / 2) probe.is_evaluated = false;
      continue;
    }
    const Eigen::VectorXd linear = step * probe.product;
    probe.steps.push_back(step);
    probe.remainders.push_back((up.value - start.value - linear)
                                   .cwiseAbs()
                                   .cwiseMin((down.value - start.value + linear).cwiseAbs()));
    probe.round_off.push_back(start.round_off + up.round_off.cwiseMax(down.round_off) +
                              product_roundings * step * product_size);
  }
  return probe;
}

// A remainder that stays in round-off says "linear" if a thousandth of J v would have left it.
Verdict verdict_without_slope(const TaylorTest& test, double product) {
  constexpr double share = 1e-3;
  bool is_seen = product == 0;
  for (std::size_t i = 0; i < test.steps.size(); ++i)
    is_seen = is_seen || share * test.steps[i] * product > clear_of_round_off * test.round_off[i];
  return is_seen ? Verdict::right : Verdict::not_tested;
}

// A remainder aε + bε² + ... has |a| <= |remainder|/ε at every step, but for a chance zero: of two
// neighbouring steps the larger is taken.
double linear_part(const TaylorTest& test, double product) {
  double smallest = std::numeric_limits<double>::infinity(), last = smallest;
  for (std::size_t i = 0; i < test.steps.size(); ++i) {
    const double now = (test.remainders[i] + test.round_off[i]) / (test.steps[i] * product);
    smallest = std::min(smallest, nan_max(now, last));
    last = now;
  }
  return smallest;
}

// Slope over the smallest steps whose remainder is clear of round-off: there a wrong derivative has
// nowhere to hide behind curvature.
void fit_slope(TaylorTest& test, double product) {
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
    test.verdict = verdict_without_slope(test, product);
    if (test.passed()) test.slope = std::numeric_limits<double>::infinity();
    return;
  }
  double intercept, c00, c01, c11, sum;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &test.slope, &c00, &c01, &c11,
                 &sum);
  test.linear_part = linear_part(test, product);
  const bool is_right =
      test.slope >= smallest_passing_slope || test.linear_part <= largest_passing_linear_part;
  test.verdict = is_right ? Verdict::right : Verdict::wrong;
}

TaylorTest taylor_test(const Probe& probe, const Block& rows, const Block& columns) {
  TaylorTest test{rows.name, columns.name, {}, {}, {}};
  test.steps = probe.steps;
  for (std::size_t i = 0; i < probe.steps.size(); ++i) {
    test.remainders.push_back(largest(probe.remainders[i], rows.indices));
    test.round_off.push_back(largest(probe.round_off[i], rows.indices));
  }
  const double product = largest(probe.product, rows.indices);
  if (!probe.is_evaluated)
    test.verdict = Verdict::not_evaluated;
  else if (!std::isfinite(product))
    test.verdict = Verdict::wrong;
  else if (std::ranges::all_of(test.round_off, [](double r) { return std::isfinite(r); }))
    fit_slope(test, product);
  return test;
}

Block all_of(const std::vector<Block>& blocks) {
  Block all{"all", {}};
  for (const Block& block : blocks)
    all.indices.insert(all.indices.end(), block.indices.begin(), block.indices.end());
  return all;
}

Eigen::VectorXd scaled(const JacobianProblem& problem, double scale) {
  if (problem.scale.size() == 0) return Eigen::VectorXd::Constant(problem.size, scale);
  return scale * problem.scale;
}

std::vector<TaylorTest> test_blocks(const JacobianProblem& problem,
                                    const Eigen::SparseMatrix<double>& claimed,
                                    const Eigen::VectorXd& scale, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto probe_columns = [&](const Block& columns) {
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(problem.size);
    for (const Eigen::Index i : columns.indices) direction[i] = scale[i] * uniform(random);
    return probe(problem, claimed, direction);
  };
  const Block all = all_of(problem.columns);
  std::vector<TaylorTest> tests{taylor_test(probe_columns(all), all_of(problem.rows), all)};
  for (const Block& columns : problem.columns) {
    const Probe probe = probe_columns(columns);
    for (const Block& rows : problem.rows) tests.push_back(taylor_test(probe, rows, columns));
  }
  return tests;
}

}  // namespace

std::string name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return "ok";
    case Verdict::not_tested:
      return "not tested";
    case Verdict::not_evaluated:
      return "not evaluated";
    case Verdict::wrong:
      return "WRONG";
  }
  return {};
}

Verdict JacobianCheck::verdict() const {
  Verdict worst = std::max(entries.verdict, system.is_asked ? system.verdict : Verdict::right);
  for (const TaylorTest& block : blocks) worst = std::max(worst, block.verdict);
  return blocks.empty() ? std::max(worst, Verdict::not_tested) : worst;
}

double JacobianCheck::smallest_slope() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (const TaylorTest& block : blocks) smallest = nan_min(smallest, block.slope);
  return smallest;
}

JacobianCheck check_blocks(const JacobianProblem& problem, double scale, unsigned seed) {
  JacobianCheck check;
  check.blocks = test_blocks(problem, claimed_matrix(problem), scaled(problem, scale), seed);
  check.system.is_asked = static_cast<bool>(problem.system_error);
  return check;
}

JacobianCheck check_jacobian(const JacobianProblem& problem, double scale, unsigned seed) {
  const Eigen::SparseMatrix<double> claimed = claimed_matrix(problem);
  const Eigen::VectorXd scales = scaled(problem, scale);
  JacobianCheck check;
  check.blocks = test_blocks(problem, claimed, scales, seed);
  check.entries = test_entries(problem, claimed, scales);
  if (problem.system_error) {
    const double error = problem.system_error();
    check.system = {true, error,
                    error <= largest_passing_system_error ? Verdict::right : Verdict::wrong};
  }
  return check;
}

void print(std::ostream& out, const JacobianCheck& check) {
  const auto flags = out.flags();
  const auto precision = out.precision();
  for (const TaylorTest& test : check.blocks) {
    out << "  " << std::left << std::setw(32) << (test.rows + " / " + test.columns) << " slope ";
    if (test.is_linear())
      out << "linear";
    else if (std::isnan(test.slope))
      out << "none  ";
    else
      out << std::fixed << std::setprecision(3) << test.slope << " ";
    if (test.passed() && test.slope < smallest_passing_slope)
      out << " but linear below " << std::scientific << std::setprecision(0) << test.linear_part;
    out << "  " << name_of(test.verdict) << '\n';
  }
  const EntryTest& entries = check.entries;
  out << "  worst entry (" << entries.row << ", " << entries.column << "): " << std::scientific
      << std::setprecision(6) << entries.analytic << " against difference " << entries.difference
      << ", off by " << std::setprecision(1) << entries.worst << "  " << name_of(entries.verdict)
      << '\n';
  if (check.system.is_asked)
    out << "  the system that is solved, off by " << check.system.error << "  "
        << name_of(check.system.verdict) << '\n';
  out.flags(flags);
  out.precision(precision);
}

}  // namespace talus::solve
