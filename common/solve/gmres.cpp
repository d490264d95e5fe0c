#include "common/solve/gmres.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Jacobi>

namespace talus::solve {

GmresSummary gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product,
                   const Eigen::VectorXd& b, Eigen::VectorXd& x, const GmresOptions& options) {
  constexpr int too_early_to_tell = 2;  // iterations
  GmresSummary summary;
  const double size = b.norm();
  x = Eigen::VectorXd::Zero(b.size());
  if (size == 0) return {true, 0, 0};
  const Eigen::Index most = options.max_iterations;
  std::vector<Eigen::VectorXd> basis{b / size};  // Arnoldi's, orthonormal
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd rest = size * Eigen::VectorXd::Unit(most + 1, 0);  // rotated with the triangle
  std::vector<Eigen::JacobiRotation<double>> rotations;
  while (summary.iterations < most && !summary.converged) {
    const Eigen::Index k = summary.iterations++;
    auto column = triangle.col(k);
    Eigen::VectorXd next = product(basis.back());
    for (Eigen::Index i = 0; i <= k; ++i) {
      const auto& other = basis[static_cast<std::size_t>(i)];
      column[i] = other.dot(next);
      next -= column[i] * other;
    }
    column[k + 1] = next.norm();
    if (!std::isfinite(column[k + 1])) return {false, summary.iterations, summary.reduction};
    if (column[k + 1] > 0) basis.push_back(next / column[k + 1]);
    for (Eigen::Index i = 0; i < k; ++i)
      column.applyOnTheLeft(i, i + 1, rotations[static_cast<std::size_t>(i)].adjoint());
    rotations.emplace_back().makeGivens(column[k], column[k + 1]);
    column.applyOnTheLeft(k, k + 1, rotations.back().adjoint());
    rest.applyOnTheLeft(k, k + 1, rotations.back().adjoint());
    if (column[k] == 0) return {false, summary.iterations, summary.reduction};  // A is singular
    summary.reduction = std::abs(rest[k + 1]) / size;
    summary.converged = summary.reduction <= options.tolerance;
    const double reachable =
        std::pow(summary.reduction, static_cast<double>(most) / summary.iterations);
    if (summary.iterations > too_early_to_tell && reachable > options.tolerance) break;
  }
  const Eigen::Index k = summary.iterations;
  const Eigen::VectorXd y =
      triangle.topLeftCorner(k, k).triangularView<Eigen::Upper>().solve(rest.head(k));
  for (Eigen::Index i = 0; i < k; ++i) x += y[i] * basis[static_cast<std::size_t>(i)];
  return summary;
}

}  // namespace talus::solve
