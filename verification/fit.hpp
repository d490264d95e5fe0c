// Fitted orders of convergence.
#pragma once

#include <vector>

namespace talus::verification {

/// Least-squares slope of log y against log x (GSL); NaN for fewer than two points.
double fitted_order(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace talus::verification
