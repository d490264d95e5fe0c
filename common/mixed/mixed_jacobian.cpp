#include "common/mixed/mixed_jacobian.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <random>

#include <Eigen/LU>

#include "common/shear/law_check.hpp"
#include "common/solve/extremes.hpp"
#include "common/solve/sparse_lu.hpp"

namespace talus::mixed {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

template <int Dim>
Eigen::VectorXd random_vector(const MixedSpace<Dim>& space) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd v(space.size());
  for (double& each : v) each = uniform(random);
  space.clear_fixed(v);
  return v;
}

// Of the pressures of an element and the velocities of its nodes: what changes the shear rate and
// the total pressure at no point by more than themselves, or than what they are regularised with.
template <int Dim>
Eigen::VectorXd curvature_scale(const MixedFlow<Dim>& problem,
                                const solve::CompensatedVector& state) {
  const MixedSpace<Dim>& space = problem.space();
  const rheology::Rheology& law = problem.rheology();
  const double least_pressure = std::max(law.lambda_r, law.pressure_floor);
  Eigen::VectorXd scale =
      Eigen::VectorXd::Constant(space.size(), std::numeric_limits<double>::infinity());
  const auto lower = [&](Eigen::Index i, double bound) { scale[i] = std::min(scale[i], bound); };
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : fem::gauss_rule<Dim>(3)) {
      const fem::ElementPoint<Dim> at(space.mesh(), e, point.position);
      const auto values = space.values_at(state, e, point.position);
      const double rate = std::max(values.shear_rate(), law.lambda_r);
      for (int a = 0; a < MixedSpace<Dim>::nodes_per_element; ++a)
        for (int i = 0; i < Dim; ++i)
          lower(space.velocity_index(space.mesh().elements[e][static_cast<std::size_t>(a)], i),
                rate / at.gradients.col(a).norm());
      const double pressure = std::max(
          std::abs(values.pressure + problem.static_pressure(at.position)), least_pressure);
      const auto psi = space.pressure_basis(e, point.position, at.position);
      for (int k = 0; k <= Dim; ++k)
        lower(space.pressure_index(e, k), 0.5 * pressure / std::abs(psi[k]));
    }
  return scale;
}

// Velocities with a rate of strain of about `rate` everywhere and nowhere the same. No dynamic
// pressure: its rounding would hide the little viscosity there is at a negative one.
template <int Dim>
typename MixedSpace<Dim>::State sheared(const MixedSpace<Dim>& space, double rate) {
  auto state = space.start();
  for (std::size_t node = 0; node < space.mesh().nodes.size(); ++node) {
    const fem::Point<Dim>& x = space.mesh().nodes[node];
    for (int i = 0; i < Dim; ++i)
      state.set(space.velocity_index(static_cast<Eigen::Index>(node), i),
                rate * (0.8 * x[(i + 1) % Dim] + 0.3 * std::sin(2 * x[i] + x[0] * x[1] + i)));
  }
  return state;
}

// Condensed, a momentum row holds A_up A_pp⁻¹ times what a mass row sums up; 1/λp of it, against
// which a small viscosity is lost.
template <int Dim>
Eigen::VectorXd condensation_round_off(const MixedSpace<Dim>& space, const Matrix& matrix,
                                       const Eigen::VectorXd& size) {
  // Of the local inverse, its products, their sums and the factors.
  constexpr double roundings = 64 * std::numeric_limits<double>::epsilon();
  constexpr int pressures = MixedSpace<Dim>::pressures;
  Eigen::VectorXd pressure_size = Eigen::VectorXd::Zero(space.size());
  for (std::size_t e = 0; e < space.element_count(); ++e) {
    Eigen::Matrix<double, pressures, pressures> of_pressures;
    Eigen::Vector<double, pressures> mass_size;
    for (int k = 0; k < pressures; ++k) {
      mass_size[k] = size[space.pressure_index(e, k)];
      for (int l = 0; l < pressures; ++l)
        of_pressures(k, l) = matrix.coeff(space.pressure_index(e, k), space.pressure_index(e, l));
    }
    const Eigen::Vector<double, pressures> sums = of_pressures.inverse().cwiseAbs() * mass_size;
    for (int k = 0; k < pressures; ++k) pressure_size[space.pressure_index(e, k)] = sums[k];
  }
  return roundings * (matrix.cwiseAbs() * pressure_size);
}

// By the factors of the whole matrix, without condensing; empty where it is singular.
template <int Dim>
Eigen::VectorXd solve_uncondensed(const MixedSpace<Dim>& space, Matrix matrix,
                                  const Eigen::VectorXd& b) {
  for (Eigen::Index i = 0; i < space.velocity_count(); ++i)
    if (space.is_fixed(i)) matrix.coeffRef(i, i) = 1;
  const solve::SparseLu::Matrix whole = matrix;
  std::vector<int> each_alone(static_cast<std::size_t>(whole.rows()));
  std::iota(each_alone.begin(), each_alone.end(), 0);
  solve::SparseLu factors(whole, each_alone);
  Eigen::VectorXd x;
  if (!factors.factor(whole) || !factors.solve(b, x)) return {};
  return x;
}

// Condensing is the same algebra for every matrix: states that show it right stand for those where
// round-off hides it. That the matrix is the derivative is checked at each.
void ask_where_it_can_be_seen(std::vector<solve::NamedCheck>& checks) {
  const auto has = [&](solve::Verdict verdict) {
    return std::ranges::any_of(checks, [=](const solve::NamedCheck& each) {
      return each.check.system.is_asked && each.check.system.verdict == verdict;
    });
  };
  if (!has(solve::Verdict::right)) return;
  for (auto& [state, check] : checks)
    if (check.system.verdict == solve::Verdict::not_tested) check.system.is_asked = false;
}

}  // namespace

template <int Dim>
solve::JacobianProblem jacobian_problem(MixedFlow<Dim>& problem,
                                        const typename MixedFlow<Dim>::State& state) {
  const MixedSpace<Dim>& space = problem.space();
  solve::Block velocity{"velocity", {}}, pressure{"pressure", {}};
  for (Eigen::Index i = 0; i < space.size(); ++i)
    if (i >= space.velocity_count())
      pressure.indices.push_back(i);
    else if (!space.is_fixed(i))
      velocity.indices.push_back(i);
  const auto admissible = [&space](Eigen::VectorXd v) {
    space.clear_fixed(v);
    return v;
  };
  problem.evaluate(state);
  const auto matrix =
      std::make_shared<Matrix>(problem.tangent_matrix(MixedFlow<Dim>::TangentPenalty::of_residual));
  return {space.size(),
          [&problem, state, admissible](const Eigen::VectorXd& displacement) {
            return problem.evaluate(
                state.moved(1, typename MixedFlow<Dim>::State(admissible(displacement))));
          },
          [matrix, admissible](const Eigen::VectorXd& direction) -> Eigen::VectorXd {
            return *matrix * admissible(direction);
          },
          {velocity, pressure},
          {velocity, pressure},
          curvature_scale(problem, state),
          [&problem, state] {
            solve::SystemError error = condensation_error(problem, state);
            error.value = solve::nan_max(error.value, product_error(problem, state));
            return error;
          }};
}

template <int Dim>
double product_error(MixedFlow<Dim>& problem, const typename MixedFlow<Dim>::State& state) {
  problem.evaluate(state);
  const Matrix matrix = problem.tangent_matrix(MixedFlow<Dim>::TangentPenalty::of_residual);
  const Eigen::VectorXd v =
      random_vector(problem.space()).cwiseProduct(curvature_scale(problem, state));
  const Eigen::VectorXd off =
      (problem.tangent_product(solve::CompensatedVector(v)) - matrix * v).cwiseAbs();
  const Eigen::VectorXd size = matrix.cwiseAbs() * v.cwiseAbs();
  double worst = 0;
  for (Eigen::Index i = 0; i < off.size(); ++i)
    if (off[i] != 0) worst = solve::nan_max(worst, off[i] / size[i]);
  return worst;
}

template <int Dim>
solve::SystemError condensation_error(MixedFlow<Dim>& problem,
                                      const typename MixedFlow<Dim>::State& state) {
  const MixedSpace<Dim>& space = problem.space();
  const Eigen::VectorXd b = random_vector(space);
  problem.evaluate(state);
  const Matrix matrix = problem.tangent_matrix(MixedFlow<Dim>::TangentPenalty::of_solves);
  typename MixedFlow<Dim>::State refined;
  Eigen::VectorXd x;
  problem.linear_solve(b, refined);  // for its factors; whether refining helps is another question
  constexpr int refinements = 4;  // the condensing is asked for, not the round-off of the factors
  const bool is_solved = problem.system().solve(b, x, refinements);
  if (!is_solved) x = solve_uncondensed(space, matrix, b);  // is it round-off that hides this?
  if (x.size() == 0) return {std::numeric_limits<double>::infinity()};
  const Eigen::VectorXd off = (b - matrix * x).cwiseAbs();
  const Eigen::VectorXd size = matrix.cwiseAbs() * x.cwiseAbs() + b.cwiseAbs();
  const Eigen::VectorXd round_off = condensation_round_off(space, matrix, size);
  const Eigen::Index split = space.velocity_count();
  const auto largest = [](const auto& part) {
    double result = 0;
    for (const double each : part) result = solve::nan_max(result, each);
    return result;
  };
  const double momentum = largest(size.head(split));
  if (!is_solved)
    return {std::numeric_limits<double>::infinity(), largest(round_off.head(split)) / momentum};
  return {solve::nan_max(
              largest(off.head(split)) / momentum,
              largest(off.tail(off.size() - split)) / largest(size.tail(size.size() - split))),
          largest(round_off.head(split)) / momentum};
}

template <int Dim>
std::vector<solve::NamedCheck> check_jacobian(const MixedFlow<Dim>& scene, double pressure) {
  const rheology::Rheology& law = scene.rheology();
  std::vector<solve::NamedCheck> checks{shear::check_law(law, pressure)};
  const auto check = [&](const char* name, double rate, double about) {
    // Static pressures between half and one and a half times `about`.
    MixedFlow<Dim> flow = scene.under(
        {[=](const fem::Point<Dim>& x) { return about * (1 + 0.5 * std::sin(3 * x.sum())); },
         [](const fem::Point<Dim>&) -> fem::Point<Dim> { return fem::Point<Dim>::Zero(); }});
    const auto state = sheared(scene.space(), rate);
    checks.push_back({name, solve::check_jacobian(jacobian_problem(flow, state))});
  };
  const double flowing = law.law.reference_shear_rate(pressure);
  check("at rest", 0, pressure);
  check("in plug", 5e-3 * law.lambda_r, pressure);
  check("at yield", law.lambda_r, pressure);
  check("flowing", flowing, pressure);
  // Faster, inertia would hide the pressure, and a plain penalty what is left of the viscosity.
  const double tiny = std::max(law.lambda_r, law.pressure_floor);
  check("just flowing at a tiny pressure", 30 * tiny, tiny);
  check("flowing at a negative pressure", flowing, -pressure);
  ask_where_it_can_be_seen(checks);
  return checks;
}

template solve::JacobianProblem jacobian_problem(MixedFlow<2>&, const MixedFlow<2>::State&);
template solve::JacobianProblem jacobian_problem(MixedFlow<3>&, const MixedFlow<3>::State&);
template double product_error(MixedFlow<2>&, const MixedFlow<2>::State&);
template double product_error(MixedFlow<3>&, const MixedFlow<3>::State&);
template solve::SystemError condensation_error(MixedFlow<2>&, const MixedFlow<2>::State&);
template solve::SystemError condensation_error(MixedFlow<3>&, const MixedFlow<3>::State&);
template std::vector<solve::NamedCheck> check_jacobian(const MixedFlow<2>&, double);
template std::vector<solve::NamedCheck> check_jacobian(const MixedFlow<3>&, double);

}  // namespace talus::mixed
