#include "verification/fit.hpp"

#include <cmath>
#include <limits>

#include <gsl/gsl_fit.h>

namespace talus::verification {

double fitted_order(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    log_x.push_back(std::log(x[i]));
    log_y.push_back(std::log(y[i]));
  }
  double intercept, slope, c00, c01, c11, sum;
  gsl_fit_linear(log_x.data(), 1, log_y.data(), 1, x.size(), &intercept, &slope, &c00, &c01, &c11,
                 &sum);
  return slope;
}

}  // namespace talus::verification
