// The ways to solve a one-dimensional scene that the studies compare.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "common/solve/extremes.hpp"
#include "oned/errors.hpp"
#include "oned/scenes.hpp"
#include "oned/solver.hpp"

namespace talus::verification {

/// A labelled set of solver options.
struct NamedMethod {
  std::string label;
  oned::SolveOptions options;
};

/// The interior point, to the round-off of its duality gap: what regularised answers are measured
/// against.
NamedMethod reference_method();
/// Newton from rest, without the fallback to continuation.
NamedMethod newton_method(const rheology::Regularisation& regularisation, double lambda_r);
/// Newton with every regularisation of the registry.
std::vector<NamedMethod> newton_methods(double lambda_r);
/// Those that tend to eq. (4): what the paper compares.
std::vector<NamedMethod> yield_stress_methods(double lambda_r);

/// Whether a method's answers tend to those of eq. (4), which the interior point solves.
bool has_yield_stress(const NamedMethod& method);
/// The scene with the exact profiles of the law that a method tends to.
oned::ShearScene scene_for(const oned::ShearScene& scene, const NamedMethod& method);
/// What a method's answers are measured against on the same mesh: the interior point, or for a law
/// without yield stress, for which there is none, Newton at λr = 1e-14.
NamedMethod reference_for(const NamedMethod& method);

/// `value` if it may count, else NaN: a check on a case that did not succeed fails.
inline double if_counts(bool counts, double value) {
  return counts ? value : std::numeric_limits<double>::quiet_NaN();
}
/// The same of a number that a solve led to.
inline double if_success(solve::End end, double value) {
  return if_counts(solve::is_success(end), value);
}
/// Solves a scene; if that fails its velocities, rates and stresses are NaN, and errors with them.
oned::Solution solve_or_nan(const oned::ShearScene& scene, std::span<const double> boundaries,
                            const oned::SolveOptions& options);
/// Iterations, NaN of a solve that failed.
inline double counted_iterations(const oned::Solution& solution) {
  return if_success(solution.end, solution.iterations());
}

/// 5, 10, 20, ... up to `largest`.
std::vector<int> doubled_elements(int largest);
/// The mesh with so many elements, as far as its grading allows (fem::largest_grading).
std::vector<oned::MeshOptions> doubled_meshes(oned::MeshOptions mesh, int largest);

/// "1e-06" as "1e-6".
std::string short_power(double value);

}  // namespace talus::verification
