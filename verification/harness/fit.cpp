#include "verification/harness/fit.hpp"

#include <cmath>
#include <limits>

#include <gsl/gsl_fit.h>

#include "common/io/table.hpp"
#include "common/solve/extremes.hpp"

namespace talus::verification {

double fitted_order(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  // course 13: order of convergence
  std::vector<double> log_x, log_y;
  for (std::size_t i = 0; i < x.size(); ++i) {
    log_x.push_back(std::log(x[i]));
    log_y.push_back(std::log(y[i]));
  }
  double intercept, slope, c00, c01, c11, sum;
  gsl_fit_linear(log_x.data(), 1, log_y.data(), 1, x.size(), &intercept, &slope, &c00, &c01, &c11,
                 &sum);
  return slope;
  // end of course 13
}

void Range::add(double value) {
  lower_ = is_empty_ ? value : solve::nan_min(lower_, value);
  upper_ = is_empty_ ? value : solve::nan_max(upper_, value);
  is_empty_ = false;
}

std::string Range::text(int digits) const {
  const std::string from = known(lower_, digits), to = known(upper_, digits);
  return from == to ? from : from + " to " + to;
}

std::string known(double value, int digits) {
  return std::isnan(value) ? "not known" : io::rounded(value, digits);
}

}  // namespace talus::verification
