#include "twod/section_nested.hpp"

#include <algorithm>
#include <limits>

#include "common/fem/geometry.hpp"
#include "common/solve/stopwatch.hpp"

namespace talus::twod {
namespace {

// The same problem on the next coarser mesh, as a start; none if there is none or it fails.
std::optional<shear::ShearStart<2>> start_from_coarser(const Section& section,
                                                       const SectionMesh& mesh,
                                                       const shear::CrossSection<2>& space,
                                                       const shear::ShearOptions& options,
                                                       std::vector<MeshCost>& meshes) {
  const auto coarse = coarsened(mesh);
  if (!coarse) return std::nullopt;
  auto coarse_space = space_of(section, *coarse);
  shear::ShearOptions rough = options;
  rough.newton.tolerance = std::max(CoarserMesh::tolerance, options.newton.tolerance);
  rough.newton.distance = std::numeric_limits<double>::infinity();
  rough.lambda_r = CoarserMesh::lambda_r_for(options.lambda_r);
  SectionSolution solution = solve_nested(section, *coarse, coarse_space, rough);
  meshes = std::move(solution.meshes);
  if (!solve::is_success(solution.end)) return std::nullopt;
  return carried_over(solution, coarse_space, lines_of(section, *coarse), space);
}

}  // namespace

std::optional<SectionMesh> coarsened(const SectionMesh& mesh) {
  if (std::min(mesh.across, mesh.up) < 2 * CoarserMesh::fewest_elements) return std::nullopt;
  SectionMesh coarse = mesh;
  for (int* elements : {&coarse.across, &coarse.up}) *elements = (*elements + 1) / 2;
  return coarse;
}

shear::ShearStart<2> carried_over(const SectionSolution& solution,
                                  const shear::CrossSection<2>& space, const SectionLines& lines,
                                  const shear::CrossSection<2>& to) {
  const auto point_at = [&](const Eigen::Vector2d& position) {
    const auto place = fem::locate<2>({lines.across, lines.up}, position);
    const fem::ElementPoint<2> at(space.mesh(), place.element, place.reference);
    return std::pair(at, space.local_velocities(solution.velocity, place.element));
  };
  const auto velocity = [](const auto& at, const auto& velocities) {
    return at.values.dot(velocities.relative.template cast<double>()) +
           static_cast<double>(velocities.interior);
  };
  shear::ShearStart<2> start{solve::CompensatedVector(to.node_count())};
  for (Eigen::Index i = 0; i < to.node_count(); ++i) {
    if (to.mesh().fixed[static_cast<std::size_t>(i)]) continue;
    const auto [at, velocities] = point_at(to.mesh().nodes[static_cast<std::size_t>(i)]);
    start.velocity.set(i, velocity(at, velocities));
  }
  for (const auto& point : to.points()) {
    const auto [at, velocities] = point_at(point.position);
    if (point.on_wall)
      start.gradients.emplace_back(velocity(at, velocities), 0);  // the slip
    else
      start.gradients.push_back(at.gradients * velocities.relative.cast<double>());
  }
  return start;
}

SectionSolution solve_nested(const Section& section, const SectionMesh& mesh,
                             shear::CrossSection<2>& space, const shear::ShearOptions& options) {
  const solve::Stopwatch watch;
  std::vector<MeshCost> meshes;
  const auto start = start_from_coarser(section, mesh, space, options, meshes);
  const solve::Stopwatch watch_of_mesh;
  SectionSolution solution;
  if (start) solution = solve(section, space, options, &*start);
  if (!start || !solve::is_success(solution.end)) solution = solve(section, space, options);
  meshes.push_back({mesh, solution.end, solution.iterations(), watch_of_mesh.seconds()});
  solution.meshes = std::move(meshes);
  solution.seconds = watch.seconds();
  return solution;
}

}  // namespace talus::twod
