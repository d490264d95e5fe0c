#include "oned/solver.hpp"

#include "common/flow/jacobian_problems.hpp"
#include "common/io/stopwatch.hpp"

namespace talus::oned {
namespace {

using Position = Eigen::Matrix<double, 1, 1>;

auto pressure_of(const ShearScene& scene) {
  return [&scene](const Position& x) { return scene.pressure(x[0]); };
}

auto body_force_of(const ShearScene& scene) {
  return [&scene](const Position&) { return scene.body_force; };
}

void solve_by_newton(const ShearScene& scene, const SolveOptions& options, Solution& solution) {
  flow::ShearFlow<1> problem = regularised_problem(scene, solution.space, options);
  solution.velocity = solve::CompensatedVector(solution.space.node_count(), options.precision);
  if (options.start)
    for (Eigen::Index i = 0; i < solution.velocity.size(); ++i)
      solution.velocity.set(
          i, options.start(solution.space.mesh().nodes[static_cast<std::size_t>(i)][0]));
  if (options.continuation)
    solution.newton = solve::newton_with_continuation(problem, solution.velocity, options.newton);
  else
    solution.newton.newton =
        solve::newton(problem, solution.velocity, options.newton, options.observe);
  solution.end = solution.newton.newton.end;
  std::vector<Position> gradients;
  solution.space.gradients(solution.velocity, gradients);
  for (std::size_t k = 0; k < gradients.size(); ++k) {
    const double shear_rate = gradients[k].norm();
    const double pressure = scene.pressure(solution.space.points()[k].position[0]);
    solution.shear_rate.push_back(shear_rate);
    solution.stress.push_back(problem.rheology().evaluate(shear_rate, pressure).eta * shear_rate);
  }
}

void solve_by_interior_point(const ShearScene& scene, const SolveOptions& options,
                             Solution& solution) {
  flow::InteriorPoint<1> problem = unregularised_problem(scene, solution.space);
  flow::ConeState<1> state = problem.start();
  solution.interior_point = problem.solve(state, options.interior_point);
  solution.end = solution.interior_point.end;
  solution.velocity = state.velocity;
  for (std::size_t k = 0; k < state.gradient.size(); ++k) {
    solution.shear_rate.push_back(state.gradient[k].norm());
    solution.stress.push_back(state.stress[k].norm());
  }
}

}  // namespace

int Solution::iterations() const {
  return interior_point.history.empty() ? newton.total_iterations()
                                        : interior_point.factorisations();
}

flow::CrossSection<1> space_of(const ShearScene& scene, std::span<const double> boundaries) {
  return flow::CrossSection<1>(
      flow::line_mesh(boundaries, scene.wall_at_start, !scene.wall_at_start));
}

flow::ShearFlow<1> regularised_problem(const ShearScene& scene, flow::CrossSection<1>& space,
                                       const SolveOptions& options) {
  flow::ShearFlow<1> problem(space, {scene.law, options.regularisation, options.lambda_r},
                             pressure_of(scene), body_force_of(scene));
  problem.set_tangent_term(options.tangent_term);
  return problem;
}

flow::InteriorPoint<1> unregularised_problem(const ShearScene& scene,
                                             flow::CrossSection<1>& space) {
  return {space, scene.law, pressure_of(scene), body_force_of(scene)};
}

Solution solve(const ShearScene& scene, std::span<const double> boundaries,
               const SolveOptions& options) {
  const io::Stopwatch watch;
  Solution solution{space_of(scene, boundaries), {}, {}, {}, {}, {}, {}, 0};
  if (options.method == Method::newton)
    solve_by_newton(scene, options, solution);
  else
    solve_by_interior_point(scene, options, solution);
  solution.seconds = watch.seconds();
  return solution;
}

std::vector<NamedCheck> check_jacobian(const ShearScene& scene, std::span<const double> boundaries,
                                       const SolveOptions& options) {
  std::vector<NamedCheck> checks;
  if (options.method == Method::newton) {
    // A right tangent finds the states, whichever is checked.
    SolveOptions right = options;
    right.tangent_term = flow::TangentTerm::full;
    Solution solution = solve(scene, boundaries, right);
    flow::ShearFlow<1> problem = regularised_problem(scene, solution.space, options);
    const double scale = std::max(1e-3, solution.velocity.value().lpNorm<Eigen::Infinity>());
    const solve::CompensatedVector rest(solution.space.node_count());
    for (const auto& [name, share] :
         {std::pair{"at rest", 0.0}, {"half way", 0.5}, {"solution", 1.0}})
      checks.push_back(
          {name, solve::check_jacobian(flow::jacobian_problem(problem, solution.space,
                                                              rest.moved(share, solution.velocity)),
                                       scale)});
    return checks;
  }
  flow::CrossSection<1> space = space_of(scene, boundaries);
  flow::InteriorPoint<1> problem = unregularised_problem(scene, space);
  for (const auto& [name, factorisations] :
       {std::pair{"start", 0}, {"after 3 steps", 3}, {"after 6 steps", 6}}) {
    flow::ConeState<1> state = problem.start();
    flow::InteriorPointOptions few = options.interior_point;
    few.max_factorisations = factorisations;
    problem.solve(state, few);
    checks.push_back({name, solve::check_jacobian(flow::jacobian_problem(problem, space, state))});
  }
  return checks;
}

}  // namespace talus::oned
