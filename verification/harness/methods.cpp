#include "verification/harness/methods.hpp"

#include <algorithm>
#include <cmath>

#include "common/fem/line_mesh.hpp"
#include "common/io/table.hpp"

namespace talus::verification {

NamedMethod reference_method() {
  NamedMethod method{"interior point", {}};
  method.options.method = oned::Method::interior_point;
  method.options.interior_point.tolerance = 2e-15;
  return method;
}

NamedMethod newton_method(const rheology::Regularisation& regularisation, double lambda_r) {
  NamedMethod method{rheology::name_of(regularisation), {}};
  method.options.regularisation = regularisation;
  method.options.lambda_r = lambda_r;
  method.options.continuation = shear::Continuation::never;
  return method;
}

std::vector<NamedMethod> newton_methods(double lambda_r) {
  std::vector<NamedMethod> methods;
  for (const auto& regularisation : rheology::regularisations())
    methods.push_back(newton_method(regularisation, lambda_r));
  return methods;
}

std::vector<NamedMethod> yield_stress_methods(double lambda_r) {
  std::vector<NamedMethod> methods = newton_methods(lambda_r);
  std::erase_if(methods, [](const NamedMethod& method) { return !has_yield_stress(method); });
  return methods;
}

bool has_yield_stress(const NamedMethod& method) {
  return method.options.method == oned::Method::interior_point ||
         rheology::has_yield_stress(method.options.regularisation);
}

oned::ShearScene scene_for(const oned::ShearScene& scene, const NamedMethod& method) {
  return has_yield_stress(method) ? scene : scene.under(method.options.regularisation);
}

NamedMethod reference_for(const NamedMethod& method) {
  return has_yield_stress(method) ? reference_method()
                                  : newton_method(method.options.regularisation, 1e-14);
}

oned::Solution solve_or_nan(const oned::ShearScene& scene, std::span<const double> boundaries,
                            const oned::SolveOptions& options) {
  oned::Solution solution = oned::solve(scene, boundaries, options);
  if (solve::is_success(solution.end)) return solution;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  solution.velocity =
      solve::CompensatedVector(Eigen::VectorXd::Constant(solution.velocity.size(), nan));
  std::ranges::fill(solution.shear_rate, nan);
  std::ranges::fill(solution.stress, nan);
  return solution;
}

std::vector<int> doubled_elements(int largest) {
  std::vector<int> elements;
  for (int n = 5; n <= largest; n *= 2) elements.push_back(n);
  return elements;
}

std::vector<oned::MeshOptions> doubled_meshes(oned::MeshOptions mesh, int largest) {
  std::vector<oned::MeshOptions> meshes;
  for (const int n : doubled_elements(largest)) {
    if (mesh.grading > fem::largest_grading(n)) break;
    mesh.elements = n;
    meshes.push_back(mesh);
  }
  return meshes;
}

std::string short_power(double value) {
  return "1e" + std::to_string(static_cast<int>(std::lround(std::log10(value))));
}

}  // namespace talus::verification
