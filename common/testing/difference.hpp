// What the tests hold derivatives against: a central difference of fourth order.
#pragma once

#include <functional>

namespace talus::testing {

/// f'(x), f smooth on the length `scale` around x: off by about 1e-12 |f|/scale in all.
inline double difference(const std::function<double(double)>& f, double x, double scale) {
  const double h = 1e-3 * scale;
  return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h);
}

}  // namespace talus::testing
