#include "common/flow/jacobian_problems.hpp"

#include <algorithm>
#include <limits>

namespace talus::flow {
namespace {

std::vector<Eigen::Index> range(Eigen::Index start, Eigen::Index length) {
  std::vector<Eigen::Index> indices;
  for (Eigen::Index i = 0; i < length; ++i) indices.push_back(start + i);
  return indices;
}

// Node numbers split into those condensed inside elements and the others; fixed nodes left out.
template <int Dim>
std::vector<solve::Block> node_blocks(const CrossSection<Dim>& space) {
  std::vector<bool> is_interior(static_cast<std::size_t>(space.node_count()), false);
  for (const auto& element : space.mesh().elements)
    is_interior[static_cast<std::size_t>(element[CrossSection<Dim>::interior])] = true;
  solve::Block outer{"skeleton", {}}, inner{"interior", {}};
  for (std::size_t i = 0; i < is_interior.size(); ++i)
    if (!space.mesh().fixed[i])
      (is_interior[i] ? inner : outer).indices.push_back(static_cast<Eigen::Index>(i));
  return {outer, inner};
}

// A ConeStep as one vector: velocity of all nodes, then t, z and τ of all points.
template <int Dim>
ConeStep<Dim> unpack(const CrossSection<Dim>& space, const Eigen::VectorXd& v) {
  const Eigen::Index nodes = space.node_count();
  const auto points = static_cast<Eigen::Index>(space.points().size());
  Eigen::VectorXd velocity = v.head(nodes);
  space.clear_fixed(velocity);
  ConeStep<Dim> step;
  step.velocity = solve::CompensatedVector(velocity);
  space.gradients(step.velocity, step.gradient);
  for (Eigen::Index k = 0; k < points; ++k) {
    step.bound.push_back(v[nodes + k]);
    step.dual_bound.push_back(v[nodes + points + k]);
    step.stress.push_back(v.segment<Dim>(nodes + 2 * points + Dim * k));
  }
  return step;
}

template <int Dim>
Eigen::VectorXd pack(const ConeResidual<Dim>& r) {
  const Eigen::Index nodes = r.equilibrium.size();
  const auto points = static_cast<Eigen::Index>(r.law.size());
  Eigen::VectorXd v(nodes + (2 + Dim) * points);
  v.head(nodes) = r.equilibrium;
  for (Eigen::Index k = 0; k < points; ++k) {
    const auto q = static_cast<std::size_t>(k);
    v[nodes + k] = r.law[q];
    v[nodes + points + k] = r.product[q];
    v.segment<Dim>(nodes + 2 * points + Dim * k) = r.alignment[q];
  }
  return v;
}

}  // namespace

template <int Dim>
solve::JacobianProblem jacobian_problem(ShearFlow<Dim>& problem, const CrossSection<Dim>& space,
                                        const solve::CompensatedVector& state) {
  const auto blocks = node_blocks(space);
  const auto admissible = [&space](Eigen::VectorXd v) {
    space.clear_fixed(v);
    return solve::CompensatedVector(v);
  };
  return {space.node_count(),
          [&problem, state, admissible](const Eigen::VectorXd& displacement) {
            return problem.evaluate(state.moved(1, admissible(displacement)));
          },
          [&problem, state, admissible](const Eigen::VectorXd& direction) {
            problem.evaluate(state);
            return problem.tangent_product(admissible(direction));
          },
          blocks, blocks};
}

template <int Dim>
solve::JacobianProblem jacobian_problem(const InteriorPoint<Dim>& problem,
                                        const CrossSection<Dim>& space,
                                        const ConeState<Dim>& state) {
  const Eigen::Index nodes = space.node_count();
  const auto points = static_cast<Eigen::Index>(space.points().size());
  const auto blocks = [&](std::vector<std::string> names) {
    solve::Block nodal{names[0], {}};
    for (const solve::Block& block : node_blocks(space))
      nodal.indices.insert(nodal.indices.end(), block.indices.begin(), block.indices.end());
    return std::vector<solve::Block>{nodal,
                                     {names[1], range(nodes, points)},
                                     {names[2], range(nodes + points, points)},
                                     {names[3], range(nodes + 2 * points, Dim * points)}};
  };
  return {nodes + (2 + Dim) * points,
          [&problem, &space, state](const Eigen::VectorXd& displacement) {
            const auto moved = problem.moved(state, 1, unpack(space, displacement));
            solve::Residual r;
            r.value = pack(problem.residual(moved));
            // Every row is a short sum of products of numbers no larger than these.
            const double largest =
                std::max({1.0, *std::max_element(moved.bound.begin(), moved.bound.end()),
                          *std::max_element(moved.dual_bound.begin(), moved.dual_bound.end())});
            r.magnitude = Eigen::VectorXd::Constant(r.value.size(), largest * largest);
            r.round_off = 16 * std::numeric_limits<double>::epsilon() * r.magnitude;
            return r;
          },
          [&problem, &space, state](const Eigen::VectorXd& direction) {
            return pack(problem.linearised(state, unpack(space, direction)));
          },
          blocks({"equilibrium", "law", "product", "alignment"}),
          blocks({"velocity", "bound t", "dual bound z", "stress"})};
}

template <int Dim>
double elimination_error(InteriorPoint<Dim>& problem, const ConeState<Dim>& state) {
  const ConeResidual<Dim> residual = problem.residual(state);
  ConeStep<Dim> step;
  problem.assemble(state);
  if (!problem.newton_step(residual, step)) return std::numeric_limits<double>::infinity();
  const Eigen::VectorXd before = pack(residual);
  const Eigen::VectorXd left = before + pack(problem.linearised(state, step));
  return left.lpNorm<Eigen::Infinity>() / before.lpNorm<Eigen::Infinity>();
}

template solve::JacobianProblem jacobian_problem(ShearFlow<1>&, const CrossSection<1>&,
                                                 const solve::CompensatedVector&);
template solve::JacobianProblem jacobian_problem(const InteriorPoint<1>&, const CrossSection<1>&,
                                                 const ConeState<1>&);
template double elimination_error(InteriorPoint<1>&, const ConeState<1>&);
template solve::JacobianProblem jacobian_problem(ShearFlow<2>&, const CrossSection<2>&,
                                                 const solve::CompensatedVector&);
template solve::JacobianProblem jacobian_problem(const InteriorPoint<2>&, const CrossSection<2>&,
                                                 const ConeState<2>&);
template double elimination_error(InteriorPoint<2>&, const ConeState<2>&);

}  // namespace talus::flow
