#include "oned/errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/fem/quadrature.hpp"
#include "common/solve/extremes.hpp"

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

// All norms of a function given element by element, smooth but for a kink in at most one of them.
Errors norms(const std::vector<Element>& elements, std::optional<double> kink,
             const std::function<double(std::size_t element, double x)>& f) {
  constexpr int samples = 40;  // an element; even, so that the nodes are among them
  Errors result;
  double square = 0, nodal_square = 0;
  const auto add_node = [&](double value) {
    result.nodal_max = solve::nan_max(result.nodal_max, std::abs(value));
    nodal_square += value * value;
  };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto [start, end, velocity] = elements[i];
    const auto squared = [&, i](double x) { return f(i, x) * f(i, x); };
    const double split = std::clamp(kink.value_or(start), start, end);
    square += integral(start, split, squared) + integral(split, end, squared);
    for (int k = 0; k <= samples; ++k)
      result.max = solve::nan_max(result.max, std::abs(f(i, start + (end - start) * k / samples)));
    add_node(f(i, start));
    add_node(f(i, 0.5 * (start + end)));
  }
  add_node(f(elements.size() - 1, elements.back().end));
  result.l2 = std::sqrt(square);
  result.paper_rms = std::sqrt(nodal_square) / static_cast<double>(2 * elements.size() + 1);
  return result;
}

// Of values at the quadrature points apart from others there; NaN unless both are known at all.
PointNorms point_norms(const shear::CrossSection<1>& space, const std::vector<double>& values,
                       const std::vector<double>& others) {
  const auto& points = space.points();
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (values.size() != points.size() || others.size() != points.size()) return {unknown, unknown};
  PointNorms norms;
  double square = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double apart = std::abs(values[k] - others[k]);
    square += points[k].weight * apart * apart;
    norms.max = solve::nan_max(norms.max, apart);
  }
  norms.l2 = std::sqrt(square);
  return norms;
}

std::vector<double> at_points(const shear::CrossSection<1>& space,
                              const std::function<double(double)>& profile) {
  std::vector<double> values;
  for (const auto& point : space.points()) values.push_back(profile(point.position[0]));
  return values;
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
  const auto elements = elements_of(solution);
  Errors all = norms(elements, scene.kink, [&](std::size_t i, double x) {
    return elements[i].at(x) - scene.exact_velocity(x);
  });
  const auto& space = solution.space;
  all.shear_rate =
      point_norms(space, solution.shear_rate, at_points(space, scene.exact_shear_rate));
  all.stress = point_norms(space, solution.stress, at_points(space, scene.exact_stress));
  return all;
}

Errors distance(const Solution& a, const Solution& b) {
  const auto of_a = elements_of(a), of_b = elements_of(b);
  Errors all = norms(of_a, std::nullopt,
                     [&](std::size_t i, double x) { return of_a[i].at(x) - of_b[i].at(x); });
  all.shear_rate = point_norms(a.space, a.shear_rate, b.shear_rate);
  all.stress = point_norms(a.space, a.stress, b.stress);
  return all;
}

}  // namespace talus::oned
