#include "common/flow/dense_jacobian.hpp"

#include <limits>
#include <random>

namespace talus::flow {

template <int Dim>
solve::JacobianProblem jacobian_problem(DenseFlow<Dim>& problem,
                                        const solve::CompensatedVector& state) {
  const DenseSpace<Dim>& space = problem.space();
  solve::Block velocity{"velocity", {}}, pressure{"pressure", {}};
  for (Eigen::Index i = 0; i < space.size(); ++i)
    if (i >= space.velocity_count())
      pressure.indices.push_back(i);
    else if (!space.is_fixed(i))
      velocity.indices.push_back(i);
  const auto admissible = [&space](Eigen::VectorXd v) {
    space.clear_fixed(v);
    return solve::CompensatedVector(v);
  };
  return {space.size(),
          [&problem, state, admissible](const Eigen::VectorXd& displacement) {
            return problem.evaluate(state.moved(1, admissible(displacement)));
          },
          [&problem, state, admissible](const Eigen::VectorXd& direction) {
            problem.evaluate(state);
            return problem.tangent_product(admissible(direction));
          },
          {velocity, pressure},
          {velocity, pressure}};
}

template <int Dim>
double condensation_error(DenseFlow<Dim>& problem, const solve::CompensatedVector& state) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd b(problem.space().size());
  for (double& each : b) each = uniform(random);
  problem.space().clear_fixed(b);
  problem.evaluate(state);
  solve::CompensatedVector x;
  if (!problem.linear_solve(b, x)) return std::numeric_limits<double>::infinity();
  return (b - problem.tangent_product(x)).template lpNorm<Eigen::Infinity>() /
         b.template lpNorm<Eigen::Infinity>();
}

template solve::JacobianProblem jacobian_problem(DenseFlow<2>&, const solve::CompensatedVector&);
template solve::JacobianProblem jacobian_problem(DenseFlow<3>&, const solve::CompensatedVector&);
template double condensation_error(DenseFlow<2>&, const solve::CompensatedVector&);
template double condensation_error(DenseFlow<3>&, const solve::CompensatedVector&);

}  // namespace talus::flow
