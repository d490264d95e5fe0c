#include "threed/unidirectional_solve.hpp"

#include "common/mixed/mixed_jacobian.hpp"
#include "common/mixed/mixed_tangent.hpp"
#include "common/solve/stopwatch.hpp"

namespace talus::threed {

template <int Dim>
mixed::MixedFlow<Dim> problem_of(const oned::ShearScene& scene, const mixed::MixedSpace<Dim>& space,
                                 const UnidirectionalOptions& options) {
  mixed::MixedFlow<Dim> problem(space, {scene.law(), options.regularisation, options.lambda_r},
                                threed::load_of<Dim>(scene), options.penalty);
  mixed::set_tangent(problem, options.tangent_term);
  return problem;
}

namespace {

template <int Dim>
solve::ContinuationSummary solve_from_rest(mixed::MixedFlow<Dim>& problem,
                                           typename mixed::MixedFlow<Dim>::State& state,
                                           const UnidirectionalOptions& options) {
  solve::NewtonOptions newton = options.newton;
  newton.line_search = solve::LineSearch::none;
  const auto rest = state;
  solve::ContinuationSummary direct{solve::newton(problem, state, newton), {}, options.lambda_r};
  if (solve::is_success(direct.newton.end) || options.continuation == shear::Continuation::never)
    return direct;
  state = rest;
  newton.line_search = solve::LineSearch::residual_norm;
  auto summary = solve::newton_along_path(problem, state, newton, options.path);
  summary.path.insert(summary.path.begin(),
                      {options.lambda_r, direct.newton.end, direct.newton.iterations()});
  return summary;
}

// Where the flow enters, at the quadrature points of the line's own space.
template <int Dim>
void add_line(const oned::ShearScene& scene, const rheology::Rheology& rheology,
              UnidirectionalSolution<Dim>& solution) {
  const auto& space = *solution.space;
  oned::Solution& line = solution.line;
  line.velocity = line_across(space, solution.state, line.space.node_count());
  const std::size_t in_a_row = space.element_count() / line.space.element_count();
  fem::Point<Dim> reference = -fem::Point<Dim>::Ones();
  for (std::size_t e = 0; e < space.element_count(); e += in_a_row)
    for (const auto& point : fem::gauss_rule<1>(3)) {
      reference[Dim - 1] = point.position[0];
      const auto at = space.values_at(solution.state, e, reference);
      const double pressure = scene.pressure(at.position[Dim - 1]) + at.pressure;
      line.shear_rate.push_back(at.shear_rate());
      line.stress.push_back(rheology.local_state(at.shear_rate(), pressure).stress());
    }
}

}  // namespace

template <int Dim>
UnidirectionalSolution<Dim> solve_unidirectional(const oned::ShearScene& scene,
                                                 std::span<const double> across,
                                                 const UnidirectionalOptions& options) {
  const solve::Stopwatch watch;
  UnidirectionalSolution<Dim> solution{
      .space = std::make_unique<mixed::MixedSpace<Dim>>(space_of<Dim>(scene, across)),
      .state = {},
      .line = {{}, oned::space_of(scene, across)}};
  auto problem = problem_of(scene, *solution.space, options);
  solution.state = solution.space->start(options.precision);
  solution.line.newton = solve_from_rest(problem, solution.state, options);
  solution.line.end = solution.line.newton.newton.end;
  solution.factorisations = problem.factorisations();
  solution.unknowns = solution.space->size();
  solution.condensed = problem.system().unknowns();
  solution.factor_entries = problem.system().factor_entries();
  solution.line.seconds = watch.seconds();

  add_line(scene, problem.rheology(), solution);
  const auto departure =
      mixed::departure(*solution.space, solution.state, solution.line.velocity, 1);
  const Eigen::VectorXd& velocity = solution.line.velocity.value();
  solution.cross_flow = departure.cross_flow * velocity.lpNorm<Eigen::Infinity>();
  solution.dynamic_pressure = departure.pressure;
  solution.change_along = departure.velocity;
  return solution;
}

template <int Dim>
std::vector<solve::NamedCheck> check_unidirectional(const oned::ShearScene& scene,
                                                    std::span<const double> across,
                                                    const UnidirectionalOptions& options) {
  const auto space = space_of<Dim>(scene, across);
  return mixed::check_jacobian(problem_of(scene, space, options), largest_pressure(scene, space));
}

#define TALUS_FOR(Dim)                                                                       \
  template mixed::MixedFlow<Dim> problem_of(                                                 \
      const oned::ShearScene&, const mixed::MixedSpace<Dim>&, const UnidirectionalOptions&); \
  template UnidirectionalSolution<Dim> solve_unidirectional(                                 \
      const oned::ShearScene&, std::span<const double>, const UnidirectionalOptions&);       \
  template std::vector<solve::NamedCheck> check_unidirectional<Dim>(                         \
      const oned::ShearScene&, std::span<const double>, const UnidirectionalOptions&);
TALUS_FOR(2)
TALUS_FOR(3)
#undef TALUS_FOR

}  // namespace talus::threed
