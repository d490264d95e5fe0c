// GMRES without restart, for an operator close to the identity: a preconditioned matrix.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace talus::solve {

struct GmresOptions {
  double tolerance = 1e-3;  ///< on |b - A x| / |b|
  int max_iterations = 20;
};

struct GmresSummary {
  bool converged = false;
  int iterations = 0;    ///< products with A
  double reduction = 1;  ///< |b - A x| / |b| reached
};

/// x with A x ≈ b, from nothing (Saad & Schultz, SIAM J. Sci. Stat. Comput. 7, 1986). Gives up
/// early if, at the rate so far, the tolerance is out of reach within the iterations allowed.
GmresSummary gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& product,
                   const Eigen::VectorXd& b, Eigen::VectorXd& x, const GmresOptions& options = {});

}  // namespace talus::solve
