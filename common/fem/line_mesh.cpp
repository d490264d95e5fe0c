#include "common/fem/line_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace talus::fem {
namespace {

// The uniform part of an aligned line: so many elements of this width.
struct UniformPart {
  int elements;
  double width;
  double end() const { return elements * width; }
};

UniformPart uniform_part(double point, int elements, double fraction) {
  return {elements, point / (fraction == 0 ? elements : elements - 1 + fraction)};
}

// As many elements as a uniform mesh would have there, but enough to end before `length`.
UniformPart fitting_part(double length, int elements, double point, double fraction) {
  const double share = elements * point / length + (fraction == 0 ? 0 : 1 - fraction);
  int first = std::clamp(static_cast<int>(std::lround(share)), 1, std::max(elements - 1, 1));
  while (first < elements - 1 && uniform_part(point, first, fraction).end() >= length) ++first;
  return uniform_part(point, first, fraction);
}

}  // namespace

std::vector<double> graded_line(double start, double end, int elements, double exponent) {
  assert(elements >= 1 && exponent >= 1);
  std::vector<double> boundaries;
  boundaries.reserve(static_cast<std::size_t>(elements) + 1);
  for (int i = 0; i <= elements; ++i) {
    const double rest = std::pow(1 - static_cast<double>(i) / elements, exponent);
    boundaries.push_back(start + (end - start) * (1 - rest));
  }
  boundaries.back() = end;
  return boundaries;
}

double largest_grading(int elements) {
  return 14 / std::log10(elements);
}

std::vector<double> geometric_line(double start, double end, int elements, double first) {
  assert(elements >= 1 && 0 < first && first < end - start);
  const auto length = [&](double ratio) {
    double sum = 0;
    for (int i = 0; i < elements; ++i) sum = sum * ratio + first;
    return sum;
  };
  double low = 1e-3, high = 10;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double ratio = 0.5 * (low + high);
    (length(ratio) < end - start ? low : high) = ratio;
  }
  std::vector<double> boundaries = {start};
  for (double width = first; boundaries.size() <= static_cast<std::size_t>(elements); width *= low)
    boundaries.push_back(boundaries.back() + width);
  boundaries.back() = end;
  return boundaries;
}

std::vector<double> aligned_line(double length, int elements, double point, double fraction,
                                 double exponent) {
  assert(can_align(length, elements, point, fraction));
  const UniformPart part = fitting_part(length, elements, point, fraction);
  const double end = fraction == 0 ? point : part.end();
  std::vector<double> boundaries = graded_line(0, end, part.elements, 1);
  const auto rest = graded_line(end, length, elements - part.elements, exponent);
  boundaries.insert(boundaries.end(), rest.begin() + 1, rest.end());
  return boundaries;
}

bool can_align(double length, int elements, double point, double fraction) {
  return elements >= 2 && 0 < point && point < length &&
         fitting_part(length, elements, point, fraction).end() < length;
}

}  // namespace talus::fem
