#include "oned/errors.hpp"

#include <algorithm>
#include <cmath>

#include "common/fem/quadrature.hpp"

namespace talus::oned {
namespace {

struct Element {
  double start, end;
  std::array<double, 3> velocity;

  double at(double x) const {
    const auto basis = fem::quadratic_basis(2 * (x - start) / (end - start) - 1);
    return velocity[0] * basis[0] + velocity[1] * basis[1] + velocity[2] * basis[2];
  }
};

std::vector<Element> elements_of(const Solution& solution) {
  std::vector<Element> elements;
  const auto& mesh = solution.space.mesh();
  const Eigen::VectorXd& w = solution.velocity.value();
  for (const auto& nodes : mesh.elements)
    elements.push_back({mesh.nodes[static_cast<std::size_t>(nodes[0])][0],
                        mesh.nodes[static_cast<std::size_t>(nodes[2])][0],
                        {w[nodes[0]], w[nodes[1]], w[nodes[2]]}});
  return elements;
}

// Gauss quadrature, fine enough for the kink at the yield point and the singular end.
double integral(double start, double end, const std::function<double(double)>& f) {
  static const auto rule = fem::gauss_legendre(10);
  double sum = 0;
  for (const auto& point : rule)
    sum += point.weight * f(start + 0.5 * (end - start) * (1 + point.position));
  return 0.5 * (end - start) * sum;
}

}  // namespace

double velocity_at(const Solution& solution, double x) {
  const auto elements = elements_of(solution);
  auto found = std::upper_bound(elements.begin(), elements.end(), x,
                                [](double value, const Element& e) { return value < e.end; });
  if (found == elements.end()) --found;
  return found->at(x);
}

Errors errors(const Solution& solution, const ShearScene& scene) {
  constexpr int samples = 40;  // an element
  Errors result;
  double square = 0;
  for (const Element& e : elements_of(solution)) {
    const auto error = [&](double x) { return e.at(x) - scene.exact_velocity(x); };
    const auto squared = [&](double x) { return error(x) * error(x); };
    const double kink = std::clamp(scene.yield_point.value_or(e.start), e.start, e.end);
    square += integral(e.start, kink, squared) + integral(kink, e.end, squared);
    for (int i = 0; i <= samples; ++i)
      result.max = std::max(result.max,
                            std::abs(error(e.start + (e.end - e.start) * i / samples)));
  }
  result.l2 = std::sqrt(square);
  double sum = 0;
  const auto& nodes = solution.space.mesh().nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double error = solution.velocity.value()[static_cast<Eigen::Index>(i)] -
                         scene.exact_velocity(nodes[i][0]);
    result.nodal_max = std::max(result.nodal_max, std::abs(error));
    sum += error * error;
  }
  result.paper_rms = std::sqrt(sum) / static_cast<double>(nodes.size());
  return result;
}

double l2_distance(const Solution& a, const Solution& b) {
  double square = 0;
  const auto of_a = elements_of(a), of_b = elements_of(b);
  for (std::size_t e = 0; e < of_a.size(); ++e)
    square += integral(of_a[e].start, of_a[e].end, [&](double x) {
      const double difference = of_a[e].at(x) - of_b[e].at(x);
      return difference * difference;
    });
  return std::sqrt(square);
}

}  // namespace talus::oned
