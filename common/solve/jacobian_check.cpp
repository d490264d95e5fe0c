#include "common/solve/jacobian_check.hpp"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <optional>
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
constexpr double largest_hidden_error = 1e-2;  // by curvature and round-off, of J v
constexpr double clear_of_round_off = 30;
constexpr int halvings = 48;

double largest(const Eigen::VectorXd& v, const std::vector<Eigen::Index>& rows) {
  double result = 0;
  for (const Eigen::Index i : rows) result = nan_max(result, std::abs(v[i]));
  return result;
}

// What one displacement shows of every row.
struct Sample {
  double step = 0;
  Eigen::VectorXd remainder, round_off;
};

// What one direction of displacements shows of every row.
class Probe {
 public:
  Probe(const JacobianProblem& problem, const Eigen::SparseMatrix<double>& claimed,
        const Eigen::VectorXd& direction)
      : problem_(problem),
        direction_(direction),
        product_(problem.product(direction)),
        product_size_(claimed.cwiseAbs() * direction.cwiseAbs()),
        start_(problem.residual(Eigen::VectorXd::Zero(problem.size))),
        is_evaluated_(start_.value.allFinite()) {
    for (int k = 0; k < halvings; ++k) {
      if (auto sample = at(std::ldexp(1.0, -k)))
        samples_.push_back(std::move(*sample));
      else if (k > halvings / 2)
        is_evaluated_ = false;
    }
  }

  // Nothing where the residual is not finite.
  std::optional<Sample> at(double step) const {
    constexpr double product_roundings = 8 * std::numeric_limits<double>::epsilon();
    const Residual up = problem_.residual(step * direction_);
    const Residual down = problem_.residual(-step * direction_);
    if (!up.value.allFinite() || !down.value.allFinite()) return std::nullopt;
    const Eigen::VectorXd linear = step * product_;
    return Sample{step,
                  (up.value - start_.value - linear)
                      .cwiseAbs()
                      .cwiseMin((down.value - start_.value + linear).cwiseAbs()),
                  start_.round_off + up.round_off.cwiseMax(down.round_off) +
                      product_roundings * step * product_size_};
  }

  const Eigen::VectorXd& product() const { return product_; }      // J v
  const std::vector<Sample>& samples() const { return samples_; }  // halving steps from 1
  // At the state and for small steps; large ones may leave the domain.
  bool is_evaluated() const { return is_evaluated_; }

 private:
  const JacobianProblem& problem_;
  Eigen::VectorXd direction_, product_, product_size_;
  Residual start_;
  std::vector<Sample> samples_;
  bool is_evaluated_;
};

// Whether a thousandth of J v would have left round-off.
bool is_seen(double step, double product, double round_off) {
  constexpr double share = 1e-3;
  return share * step * product > clear_of_round_off * round_off;
}

// A remainder that stays in round-off says "linear", if J v is seen there.
Verdict verdict_without_slope(const TaylorTest& test, double product) {
  bool is_right = product == 0;
  for (std::size_t i = 0; i < test.steps.size(); ++i)
    is_right = is_right || is_seen(test.steps[i], product, test.round_off[i]);
  return is_right ? Verdict::right : Verdict::not_tested;
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
  if (test.linear_part <= largest_passing_linear_part)
    test.verdict = Verdict::right;
  else if (!(test.slope >= smallest_passing_slope))
    test.verdict = Verdict::wrong;
  else if (product == 0 || test.linear_part <= largest_hidden_error)
    test.verdict = Verdict::right;
}

// Beyond the scale, for a block that is too small to be seen within it. There the residual may
// curve, so there is one thing to learn: that it does not, until J v is seen.
Verdict verdict_from_afar(const Probe& probe, const Block& rows, double product) {
  for (int k = 1; k < halvings; ++k) {
    const auto sample = probe.at(std::ldexp(1.0, k));
    if (!sample) break;
    const double round_off = largest(sample->round_off, rows.indices);
    if (!(largest(sample->remainder, rows.indices) <= clear_of_round_off * round_off)) break;
    if (is_seen(sample->step, product, round_off)) return Verdict::right;
  }
  return Verdict::not_tested;
}

TaylorTest taylor_test(const Probe& probe, const Block& rows, const Block& columns) {
  TaylorTest test{rows.name, columns.name, {}, {}, {}};
  for (const Sample& sample : probe.samples()) {
    test.steps.push_back(sample.step);
    test.remainders.push_back(largest(sample.remainder, rows.indices));
    test.round_off.push_back(largest(sample.round_off, rows.indices));
  }
  const double product = largest(probe.product(), rows.indices);
  if (!probe.is_evaluated())
    test.verdict = Verdict::not_evaluated;
  else if (!std::isfinite(product))
    test.verdict = Verdict::wrong;
  else if (std::ranges::all_of(test.round_off, [](double r) { return std::isfinite(r); }))
    fit_slope(test, product);
  if (test.verdict == Verdict::not_tested && std::isnan(test.slope)) {
    test.verdict = verdict_from_afar(probe, rows, product);
    if (test.passed()) test.slope = std::numeric_limits<double>::infinity();
  }
  return test;
}

Verdict verdict_on(const SystemError& error) {
  constexpr double resolution = 1e-3;  // an error of a per cent is then seen
  const bool is_hidden = error.round_off > resolution;
  if (std::isinf(error.value) && is_hidden) return Verdict::not_tested;
  if (!(error.value - error.round_off <= largest_passing_system_error)) return Verdict::wrong;
  return is_hidden ? Verdict::not_tested : Verdict::right;
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
    return Probe(problem, claimed, direction);
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
    const SystemError error = problem.system_error();
    check.system = {true, error.value, verdict_on(error)};
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
