#include "common/fem/quadrature.hpp"

#include <gsl/gsl_integration.h>

namespace talus::fem {

std::vector<QuadraturePoint> gauss_legendre(int n) {
  const auto size = static_cast<std::size_t>(n);
  gsl_integration_glfixed_table* table = gsl_integration_glfixed_table_alloc(size);
  std::vector<QuadraturePoint> points(size);
  for (std::size_t i = 0; i < size; ++i)
    gsl_integration_glfixed_point(-1, 1, i, &points[i].position, &points[i].weight, table);
  gsl_integration_glfixed_table_free(table);
  return points;
}

}  // namespace talus::fem
