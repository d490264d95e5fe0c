#include "common/shear/shear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/shear/law_check.hpp"
#include "common/shear/shear_jacobian.hpp"
#include "common/solve/stopwatch.hpp"

namespace talus::shear {
namespace {

template <int Dim>
void solve_by_newton(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                     const ShearOptions& options, const ShearStart<Dim>* start,
                     ShearSolution& solution) {
  ShearFlow<Dim> problem = regularised_problem(space, load, options);
  typename ShearFlow<Dim>::State state(
      start                ? start->velocity
      : load.wall_velocity ? driven_start(space, load)
                           : solve::CompensatedVector(space.node_count(), options.precision));
  if (start) state.stress = problem.stress_of(start->gradients);
  if (options.continuation == Continuation::always && !start)
    solution.newton = solve::newton_along_path(problem, state, options.newton, options.path);
  else if (options.continuation != Continuation::never)
    solution.newton = solve::newton_with_continuation(problem, state, options.newton, options.path);
  else
    solution.newton.newton = solve::newton(problem, state, options.newton, options.observe);
  solution.newton.lambda_r = problem.rheology().lambda_r;
  solution.end = solution.newton.newton.end;
  std::vector<typename CrossSection<Dim>::Vector> gradients;
  space.gradients(state, gradients);
  problem.evaluate(state);
  for (std::size_t k = 0; k < gradients.size(); ++k) {
    solution.shear_rate.push_back(gradients[k].norm());
    solution.stress.push_back(problem.stress()[k].norm());
  }
  solution.velocity = std::move(state);
}

template <int Dim>
void solve_by_interior_point(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                             const ShearOptions& options, ShearSolution& solution) {
  InteriorPoint<Dim> problem(space, load.law, load.pressure, load.body_force);
  ConeState<Dim> state =
      load.wall_velocity ? problem.start(driven_start(space, load)) : problem.start();
  solution.interior_point = problem.solve(state, options.interior_point);
  solution.end = solution.interior_point.end;
  solution.velocity = state.velocity;
  for (std::size_t k = 0; k < state.gradient.size(); ++k) {
    solution.shear_rate.push_back(state.gradient[k].norm());
    solution.stress.push_back(state.stress[k].norm());
  }
}

// A velocity whose gradient is about `rate` everywhere, and nowhere the same.
template <int Dim>
solve::CompensatedVector sheared(const CrossSection<Dim>& space, double rate) {
  solve::CompensatedVector velocity(space.node_count());
  for (Eigen::Index i = 0; i < velocity.size(); ++i) {
    const auto& x = space.mesh().nodes[static_cast<std::size_t>(i)];
    double w = 0;
    for (int d = 0; d < Dim; ++d) w += (1 - 0.4 * d) * x[d] + 0.2 * std::sin(x[d] + d);
    velocity.set(i, rate * w);
  }
  return velocity;
}

template <int Dim>
double largest_pressure(const CrossSection<Dim>& space, const ShearLoad<Dim>& load) {
  double largest = 0;
  for (const auto& point : space.points())
    largest = std::max(largest, load.pressure(point.position));
  return largest;
}

template <int Dim>
std::vector<solve::NamedCheck> check_newton(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                            const ShearOptions& options) {
  ShearFlow<Dim> problem = regularised_problem(space, load, options);
  const double pressure = largest_pressure(space, load), lambda_r = options.lambda_r;
  std::vector<solve::NamedCheck> checks{check_law(problem.rheology(), pressure)};
  const auto check = [&](const char* name, double rate) {
    typename ShearFlow<Dim>::State state(sheared(space, rate));
    if (options.tangent_term == TangentTerm::primal_dual) {
      // With the stress of the state itself it is the derivative.
      space.gradients(state, state.stress);
      state.stress = problem.stress_of(state.stress);
    }
    checks.push_back({name, solve::check_jacobian(jacobian_problem(problem, space, state))});
  };
  check("at rest", 0);
  check("in plug", 5e-3 * lambda_r);
  check("at yield", lambda_r);
  check("flowing", load.law.reference_shear_rate(pressure));
  return checks;
}

// Strictly inside both cones about a velocity gradient of about `share` of t; stress and gradient
// are not aligned.
template <int Dim>
ConeState<Dim> state_in_cones(const InteriorPoint<Dim>& problem, const CrossSection<Dim>& space,
                              double rate, double share) {
  ConeState<Dim> state = problem.start();
  state.velocity = sheared(space, rate);
  space.gradients(state.velocity, state.gradient);
  for (std::size_t k = 0; k < state.gradient.size(); ++k) {
    const double g = state.gradient[k].norm();
    state.bound[k] = std::max(g / share, 1e-3 * state.bound[k]);
    const double k_ = static_cast<double>(k);
    state.stress[k] = 0.8 * state.dual_bound[k] * (1 + 0.1 * std::sin(k_)) *
                      (state.gradient[k] / g + 0.1 * ConeState<Dim>::Vector::Ones()).normalized();
  }
  return state;
}

template <int Dim>
std::vector<solve::NamedCheck> check_interior_point(CrossSection<Dim>& space,
                                                    const ShearLoad<Dim>& load) {
  InteriorPoint<Dim> problem(space, load.law, load.pressure, load.body_force);
  const double flowing = load.law.reference_shear_rate(largest_pressure(space, load));
  std::vector<solve::NamedCheck> checks;
  const auto check = [&](const char* name, const ConeState<Dim>& state, bool on_path) {
    auto jacobian = jacobian_problem(problem, space, state);
    // In two dimensions the elimination is exact on the central path only.
    if (Dim == 1 || on_path)
      jacobian.system_error = [&problem, state] {
        return solve::SystemError{elimination_error(problem, state)};
      };
    checks.push_back({name, solve::check_jacobian(jacobian)});
  };
  check("start", problem.start(), true);
  check("in plug", state_in_cones(problem, space, 1e-3 * flowing, 0.3), false);
  check("flowing", state_in_cones(problem, space, flowing, 0.9), false);
  return checks;
}

}  // namespace

template <int Dim>
ShearFlow<Dim> regularised_problem(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                   const ShearOptions& options) {
  ShearFlow<Dim> problem(space, {load.law, options.regularisation, options.lambda_r}, load.pressure,
                         load.body_force);
  problem.set_tangent_term(options.tangent_term);
  problem.set_slope_factor(options.slope_factor);
  return problem;
}

template <int Dim>
solve::CompensatedVector driven_start(CrossSection<Dim>& space, const ShearLoad<Dim>& load) {
  solve::CompensatedVector walls(space.node_count()), inside;
  for (Eigen::Index i = 0; i < walls.size(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    if (space.mesh().fixed[node]) walls.set(i, load.wall_velocity(space.mesh().nodes[node]));
  }
  std::vector<typename CrossSection<Dim>::Tangent> viscosity;
  for (const auto& point : space.points())
    viscosity.push_back(load.pressure(point.position) * CrossSection<Dim>::Tangent::Identity());
  space.assemble(viscosity);
  if (!space.solve(-space.product(viscosity, walls), inside))
    throw std::runtime_error("driven_start: singular");
  return walls.moved(1, inside);
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
std::vector<solve::NamedCheck> check_jacobian(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                              const ShearOptions& options) {
  ShearLoad<Dim> unloaded = load;
  unloaded.body_force = [](const auto&) { return 0.0; };
  return options.method == Method::newton ? check_newton(space, unloaded, options)
                                          : check_interior_point(space, unloaded);
}

template solve::CompensatedVector driven_start(CrossSection<1>&, const ShearLoad<1>&);
template solve::CompensatedVector driven_start(CrossSection<2>&, const ShearLoad<2>&);
template ShearFlow<1> regularised_problem(CrossSection<1>&, const ShearLoad<1>&,
                                          const ShearOptions&);
template ShearSolution solve_shear(CrossSection<1>&, const ShearLoad<1>&, const ShearOptions&,
                                   const ShearStart<1>*);
template std::vector<solve::NamedCheck> check_jacobian(CrossSection<1>&, const ShearLoad<1>&,
                                                       const ShearOptions&);
template ShearFlow<2> regularised_problem(CrossSection<2>&, const ShearLoad<2>&,
                                          const ShearOptions&);
template ShearSolution solve_shear(CrossSection<2>&, const ShearLoad<2>&, const ShearOptions&,
                                   const ShearStart<2>*);
template std::vector<solve::NamedCheck> check_jacobian(CrossSection<2>&, const ShearLoad<2>&,
                                                       const ShearOptions&);

}  // namespace talus::shear
