#include "oned/solver.hpp"

#include "common/solve/stopwatch.hpp"

namespace talus::oned {

shear::CrossSection<1> space_of(const ShearScene& scene, std::span<const double> boundaries) {
  return shear::CrossSection<1>(
      fem::line_mesh(boundaries, scene.wall_at_start, !scene.wall_at_start));
}

shear::ShearLoad<1> load_of(const ShearScene& scene) {
  using Position = shear::ShearLoad<1>::Position;
  return {scene.law(), [&scene](const Position& x) { return scene.pressure(x[0]); },
          [&scene](const Position& x) { return scene.body_force(x[0]); }};
}

Solution solve(const ShearScene& scene, std::span<const double> boundaries,
               const SolveOptions& options) {
  const solve::Stopwatch watch;
  shear::CrossSection<1> space = space_of(scene, boundaries);
  shear::ShearStart<1> start{solve::CompensatedVector(space.node_count(), options.precision)};
  if (options.start)
    for (Eigen::Index i = 0; i < start.velocity.size(); ++i)
      start.velocity.set(i, options.start(space.mesh().nodes[static_cast<std::size_t>(i)][0]));
  Solution solution{shear::solve_shear(space, load_of(scene), options, &start), std::move(space)};
  solution.seconds = watch.seconds();
  return solution;
}

std::vector<solve::NamedCheck> check_jacobian(const ShearScene& scene,
                                              std::span<const double> boundaries,
                                              const SolveOptions& options) {
  shear::CrossSection<1> space = space_of(scene, boundaries);
  return shear::check_jacobian(space, load_of(scene), options);
}

}  // namespace talus::oned
