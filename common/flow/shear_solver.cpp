#include "common/flow/shear_solver.hpp"

#include <algorithm>

#include "common/flow/jacobian_problems.hpp"
#include "common/solve/stopwatch.hpp"

namespace talus::flow {
namespace {

template <int Dim>
void solve_by_newton(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                     const ShearOptions& options, const ShearStart<Dim>* start,
                     ShearSolution& solution) {
  ShearFlow<Dim> problem = regularised_problem(space, load, options);
  solution.velocity =
      start ? start->velocity : solve::CompensatedVector(space.node_count(), options.precision);
  if (start) problem.carry_stress_of(start->gradients);
  if (options.continuation == Continuation::always && !start)
    solution.newton =
        solve::newton_along_path(problem, solution.velocity, options.newton, options.path);
  else if (options.continuation != Continuation::never)
    solution.newton =
        solve::newton_with_continuation(problem, solution.velocity, options.newton, options.path);
  else
    solution.newton.newton =
        solve::newton(problem, solution.velocity, options.newton, options.observe);
  solution.end = solution.newton.newton.end;
  std::vector<typename CrossSection<Dim>::Vector> gradients;
  space.gradients(solution.velocity, gradients);
  problem.evaluate(solution.velocity);
  for (std::size_t k = 0; k < gradients.size(); ++k) {
    solution.shear_rate.push_back(gradients[k].norm());
    solution.stress.push_back(problem.stress()[k].norm());
  }
}

template <int Dim>
void solve_by_interior_point(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                             const ShearOptions& options, ShearSolution& solution) {
  InteriorPoint<Dim> problem(space, load.law, load.pressure, load.body_force);
  ConeState<Dim> state = problem.start();
  solution.interior_point = problem.solve(state, options.interior_point);
  solution.end = solution.interior_point.end;
  solution.velocity = state.velocity;
  for (std::size_t k = 0; k < state.gradient.size(); ++k) {
    solution.shear_rate.push_back(state.gradient[k].norm());
    solution.stress.push_back(state.stress[k].norm());
  }
}

template <int Dim>
std::vector<NamedCheck> check_newton(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                     const ShearOptions& options) {
  // A right tangent finds the states, whichever is checked.
  ShearOptions right = options;
  if (options.tangent_term != TangentTerm::primal_dual) right.tangent_term = TangentTerm::full;
  const ShearSolution solution = solve_shear(space, load, right);
  ShearFlow<Dim> problem = regularised_problem(space, load, options);
  const double scale = std::max(1e-3, solution.velocity.value().template lpNorm<Eigen::Infinity>());
  const solve::CompensatedVector rest(space.node_count());
  std::vector<NamedCheck> checks;
  for (const auto& [name, share] :
       {std::pair{"at rest", 0.0}, {"half way", 0.5}, {"solution", 1.0}}) {
    const auto state = rest.moved(share, solution.velocity);
    checks.push_back({name, solve::check_jacobian(jacobian_problem(problem, space, state), scale)});
  }
  return checks;
}

template <int Dim>
std::vector<NamedCheck> check_interior_point(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                             const ShearOptions& options) {
  InteriorPoint<Dim> problem(space, load.law, load.pressure, load.body_force);
  std::vector<NamedCheck> checks;
  for (const auto& [name, factorisations] :
       {std::pair{"start", 0}, {"after 3 steps", 3}, {"after 6 steps", 6}}) {
    ConeState<Dim> state = problem.start();
    InteriorPointOptions few = options.interior_point;
    few.max_factorisations = factorisations;
    problem.solve(state, few);
    checks.push_back({name, solve::check_jacobian(jacobian_problem(problem, space, state))});
  }
  return checks;
}

}  // namespace

template <int Dim>
ShearFlow<Dim> regularised_problem(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                   const ShearOptions& options) {
  ShearFlow<Dim> problem(space, {load.law, options.regularisation, options.lambda_r}, load.pressure,
                         load.body_force);
  problem.set_tangent_term(options.tangent_term);
  return problem;
}

template <int Dim>
ShearSolution solve_shear(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                          const ShearOptions& options, const ShearStart<Dim>* start) {
  const solve::Stopwatch watch;
  ShearSolution solution;
  if (options.method == Method::newton)
    solve_by_newton(space, load, options, start, solution);
  else
    solve_by_interior_point(space, load, options, solution);
  solution.seconds = watch.seconds();
  return solution;
}

template <int Dim>
std::vector<NamedCheck> check_jacobian(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                       const ShearOptions& options) {
  return options.method == Method::newton ? check_newton(space, load, options)
                                          : check_interior_point(space, load, options);
}

template ShearFlow<1> regularised_problem(CrossSection<1>&, const ShearLoad<1>&,
                                          const ShearOptions&);
template ShearSolution solve_shear(CrossSection<1>&, const ShearLoad<1>&, const ShearOptions&,
                                   const ShearStart<1>*);
template std::vector<NamedCheck> check_jacobian(CrossSection<1>&, const ShearLoad<1>&,
                                                const ShearOptions&);
template ShearFlow<2> regularised_problem(CrossSection<2>&, const ShearLoad<2>&,
                                          const ShearOptions&);
template ShearSolution solve_shear(CrossSection<2>&, const ShearLoad<2>&, const ShearOptions&,
                                   const ShearStart<2>*);
template std::vector<NamedCheck> check_jacobian(CrossSection<2>&, const ShearLoad<2>&,
                                                const ShearOptions&);

}  // namespace talus::flow
