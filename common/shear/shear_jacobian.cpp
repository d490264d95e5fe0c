#include "common/shear/shear_jacobian.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <random>

namespace talus::shear {
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

// Of every node: what changes the gradient at no point around it by more than `width`.
template <int Dim>
Eigen::VectorXd nodal_scale(const CrossSection<Dim>& space, const std::vector<double>& width) {
  Eigen::VectorXd scale =
      Eigen::VectorXd::Constant(space.node_count(), std::numeric_limits<double>::infinity());
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const std::size_t k : space.points_of(e))
      for (int a = 0; a < CrossSection<Dim>::nodes_per_element; ++a) {
        double& at = scale[space.mesh().elements[e][static_cast<std::size_t>(a)]];
        at = std::min(at, width[k] / space.points()[k].gradients.col(a).norm());
      }
  return scale;
}

// How far a random system is from solved, without refinement, relative to its right-hand side.
template <int Dim>
double solve_error(ShearFlow<Dim> problem, const CrossSection<Dim>& space,
                   const typename ShearFlow<Dim>::State& state) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd b(space.node_count());
  for (double& each : b) each = uniform(random);
  space.clear_fixed(b);
  problem.evaluate(state);
  typename ShearFlow<Dim>::State x;
  if (!problem.linear_solve(b, x) || !space.solve_once(b, x))  // the first assembles and factors
    return std::numeric_limits<double>::infinity();
  return (b - problem.tangent_product(x)).template lpNorm<Eigen::Infinity>() /
         b.template lpNorm<Eigen::Infinity>();
}

// Σ w |Gᵀ||τ| at every node: what equilibrium sums up.
template <int Dim>
Eigen::VectorXd force_size(const CrossSection<Dim>& space, const ConeState<Dim>& state) {
  Eigen::VectorXd size = Eigen::VectorXd::Zero(space.node_count());
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const std::size_t k : space.points_of(e))
      for (int a = 0; a < CrossSection<Dim>::nodes_per_element; ++a)
        size[space.mesh().elements[e][static_cast<std::size_t>(a)]] +=
            space.points()[k].weight * space.points()[k].gradients.col(a).norm() *
            state.stress[k].norm();
  return size;
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
                                        const typename ShearFlow<Dim>::State& state) {
  const auto blocks = node_blocks(space);
  const auto admissible = [&space](Eigen::VectorXd v) {
    space.clear_fixed(v);
    return typename ShearFlow<Dim>::State(v);
  };
  const auto linearised = std::make_shared<ShearFlow<Dim>>(problem);
  linearised->evaluate(state);
  // The viscosity curves over the shear rate itself, or over λr where that is larger.
  std::vector<typename CrossSection<Dim>::Vector> gradients;
  space.gradients(state, gradients);
  std::vector<double> width;
  for (const auto& g : gradients) width.push_back(std::max(g.norm(), problem.rheology().lambda_r));
  return {space.node_count(),
          [&problem, state, admissible](const Eigen::VectorXd& displacement) {
            return problem.evaluate(state.moved(1, admissible(displacement)));
          },
          [linearised, admissible](const Eigen::VectorXd& direction) {
            return linearised->tangent_product(admissible(direction));
          },
          blocks,
          blocks,
          nodal_scale(space, width),
          [linearised, &space, state] {
            return solve::SystemError{solve_error(*linearised, space, state)};
          }};
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
  Eigen::VectorXd scale(nodes + (2 + Dim) * points);
  scale.head(nodes) = nodal_scale(space, state.bound);
  for (Eigen::Index k = 0; k < points; ++k) {
    const auto q = static_cast<std::size_t>(k);
    scale[nodes + k] = state.bound[q];
    scale[nodes + points + k] = state.dual_bound[q];
    scale.segment<Dim>(nodes + 2 * points + Dim * k).setConstant(state.dual_bound[q]);
  }
  return {nodes + (2 + Dim) * points,
          [&problem, &space, state](const Eigen::VectorXd& displacement) {
            const auto moved = problem.moved(state, 1, unpack(space, displacement));
            const ConeResidual<Dim> value = problem.residual(moved);
            ConeResidual<Dim> size{force_size(space, moved), {}, {}, {}};
            for (std::size_t k = 0; k < moved.bound.size(); ++k) {
              const double t = std::abs(moved.bound[k]), z = std::abs(moved.dual_bound[k]);
              const double g = moved.gradient[k].norm(), stress = moved.stress[k].norm();
              size.law.push_back(std::abs(value.law[k]) + 2 * z);
              size.product.push_back(t * z + g * stress);
              size.alignment.push_back(ConeState<Dim>::Vector::Constant(z * g + t * stress));
            }
            solve::Residual r{pack(value), pack(size), {}};
            r.round_off = 16 * std::numeric_limits<double>::epsilon() * r.magnitude;
            return r;
          },
          [&problem, &space, state](const Eigen::VectorXd& direction) {
            return pack(problem.linearised(state, unpack(space, direction)));
          },
          blocks({"equilibrium", "law", "product", "alignment"}),
          blocks({"velocity", "bound t", "dual bound z", "stress"}),
          scale};
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
                                                 const ShearFlow<1>::State&);
template solve::JacobianProblem jacobian_problem(const InteriorPoint<1>&, const CrossSection<1>&,
                                                 const ConeState<1>&);
template double elimination_error(InteriorPoint<1>&, const ConeState<1>&);
template solve::JacobianProblem jacobian_problem(ShearFlow<2>&, const CrossSection<2>&,
                                                 const ShearFlow<2>::State&);
template solve::JacobianProblem jacobian_problem(const InteriorPoint<2>&, const CrossSection<2>&,
                                                 const ConeState<2>&);
template double elimination_error(InteriorPoint<2>&, const ConeState<2>&);

}  // namespace talus::shear
