// Gauss-Legendre quadrature on [-1, 1], from GSL's tables.
#pragma once

#include <vector>

namespace talus::fem {

struct QuadraturePoint {
  double position = 0;
  double weight = 0;
};

/// n points, n >= 1: exact for polynomials of degree 2n - 1. Positions ascend.
std::vector<QuadraturePoint> gauss_legendre(int n);

}  // namespace talus::fem
