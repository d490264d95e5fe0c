#include "common/mixed/mixed_flow.hpp"

#include <limits>
#include <set>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include "common/mixed/mixed_jacobian.hpp"
#include "common/mixed/mixed_test_problems.hpp"

BOOST_AUTO_TEST_SUITE(mixed_flow_test)
using namespace talus;
using namespace talus::mixed;

namespace {

constexpr double lambda_r = 1e-2;
const TestState flowing{"flow with inertia", 1, 1, 0.5, 1};

rheology::Rheology rheology_of(const rheology::Regularisation& regularisation) {
  return {{}, regularisation, lambda_r};
}

// The uncondensed matrix, column by column, without fixed velocities.
template <int Dim>
Eigen::MatrixXd full_matrix(MixedFlow<Dim>& problem, const typename MixedFlow<Dim>::State& state) {
  const MixedSpace<Dim>& space = problem.space();
  problem.evaluate(state);
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < space.size(); ++i)
    if (i >= space.velocity_count() || !space.is_fixed(i)) free.push_back(i);
  const auto count = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd matrix(count, count);
  for (Eigen::Index j = 0; j < count; ++j)
    matrix.col(j) = problem.tangent_product(solve::CompensatedVector(
        Eigen::VectorXd::Unit(space.size(), free[static_cast<std::size_t>(j)])))(free);
  return matrix;
}

// Sign of a determinant from an elimination with pivoting: the product itself may leave the range.
int determinant_sign(const Eigen::MatrixXd& matrix) {
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
  double sign = lu.permutationP().determinant() > 0 ? 1 : -1;
  for (const double pivot : lu.matrixLU().diagonal()) sign *= pivot > 0 ? 1 : -1;
  return static_cast<int>(sign);
}

bool is_positive_definite(const Eigen::MatrixXd& matrix) {
  return Eigen::LLT<Eigen::MatrixXd>(0.5 * (matrix + matrix.transpose())).info() == Eigen::Success;
}

double distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

solve::NewtonSummary solve_to_round_off(MixedFlow<2>& problem, MixedFlow<2>::State& state) {
  return solve::newton(problem, state,
                       {.tolerance = 1e-15, .line_search = solve::LineSearch::residual_norm});
}

}  // namespace

// Without refinement, against the assembled matrix: four refinements would hide a system that is
// wrong by a per cent.
BOOST_AUTO_TEST_CASE(condensing_changes_nothing) {
  const MixedSpace<2> space(awkward_mesh2(3, 3), mixed_conditions<2>());
  const MixedSpace<3> space3(awkward_mesh3(), mixed_conditions<3>());
  for (const auto& law : rheology::regularisations())
    for (const PenaltyOptions& penalty : {PenaltyOptions{}, PenaltyOptions{Penalty::plain, 1e-4}}) {
      for (const TestState& test : test_states(lambda_r)) {
        MixedFlow<2> problem(space, rheology_of(law), test_load<2>(test.inertia), penalty);
        // Round-off: 1.5e-9 in plug where a compiler rounds otherwise. Hardly any viscosity is left
        // where the pressure is negative, and the penalty outweighs it.
        const double bound = test.pressure < 0 ? 1e-6 : 1e-8;
        BOOST_TEST(condensation_error(problem, state_of(space, test)).value < bound,
                   rheology::name_of(law) << ", " << test.name);
      }
      MixedFlow<3> problem(space3, rheology_of(law), test_load<3>(1), penalty);
      BOOST_TEST(condensation_error(problem, state_of(space3, flowing)).value < 1e-9);
    }
}

BOOST_AUTO_TEST_CASE(the_product_without_a_matrix_is_that_of_the_assembled_one) {
  const MixedSpace<2> space(awkward_mesh2(3, 3), mixed_conditions<2>());
  const MixedSpace<3> space3(awkward_mesh3(), mixed_conditions<3>());
  for (const auto& law : rheology::regularisations())
    for (const TangentFactors& factors :
         {TangentFactors{}, {0, 1, 1}, {1, 0.5, 1}, {-1, 2, 0}})  // the broken ones as well
      for (const TestState& test : test_states(lambda_r)) {
        const PenaltyOptions penalty{Penalty::plain, 1e-2};
        MixedFlow<2> problem(space, rheology_of(law), test_load<2>(test.inertia), penalty);
        MixedFlow<3> problem3(space3, rheology_of(law), test_load<3>(test.inertia), penalty);
        problem.set_tangent_factors(factors);
        problem3.set_tangent_factors(factors);
        BOOST_TEST(product_error(problem, state_of(space, test)) < 1e-11, rheology::name_of(law)
                                                                              << ", " << test.name);
        BOOST_TEST(product_error(problem3, state_of(space3, test)) < 1e-11,
                   rheology::name_of(law) << ", " << test.name);
      }
}

BOOST_AUTO_TEST_CASE(a_tangent_of_another_state_does_not_solve_this_one) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>());
  MixedFlow<2> problem(space, rheology_of(rheology::ChauchatMedale{}), test_load<2>(1));
  const auto b = problem.evaluate(state_of(space, flowing)).value;
  MixedFlow<2>::State x;
  BOOST_REQUIRE(problem.linear_solve(b, x));
  BOOST_TEST(distance(problem.tangent_product(x), b) < 1e-9);
  problem.evaluate(state_of(space, {"", 1.1, 1, 0.5, 1}));
  BOOST_TEST(distance(problem.tangent_product(x), b) > 1e-3);
}

BOOST_AUTO_TEST_CASE(the_sign_of_the_determinant_is_that_of_the_full_matrix) {
  std::set<int> seen;
  for (const int across : {2, 3})  // 12 or 9 pressures, each a negative eigenvalue
    for (const double factor : {1.0, -1.0, -4.0, -30.0, -200.0}) {  // and more of them in velocity
      const MixedSpace<2> space(awkward_mesh2(across, across == 2 ? 2 : 1), mixed_conditions<2>());
      MixedFlow<2> problem(space, rheology_of(rheology::ChauchatMedale{}), test_load<2>(1),
                           {Penalty::plain, 1e-2});
      problem.set_tangent_factors({1, factor, factor});
      const auto state = state_of(space, flowing);
      const int expected = determinant_sign(full_matrix(problem, state));
      MixedFlow<2>::State x;
      BOOST_REQUIRE(problem.linear_solve(Eigen::VectorXd::Zero(space.size()), x));
      BOOST_TEST(problem.determinant_sign() == expected, across << " x, " << factor);
      seen.insert(expected * (across == 2 ? 1 : -1));
    }
  BOOST_TEST(seen.size() == 2);  // not only the sign of the pressures
}

// Eq. (8): with -∫ p div v in the momentum equation the penalty must read div u + λp p = 0.
BOOST_AUTO_TEST_CASE(with_the_printed_sign_of_the_penalty_in_eq_8_the_operator_is_indefinite) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>(false));
  const auto penalised_operator = [&](double lambda_p) -> Eigen::MatrixXd {
    MixedFlow<2> problem(space, rheology_of(rheology::ChauchatMedale{}), test_load<2>(0),
                         {Penalty::plain, lambda_p});
    problem.set_tangent_factors({0, 0, 0});  // the viscosity of the state, as if Newtonian
    const Eigen::MatrixXd all = full_matrix(problem, state_of(space, flowing));
    const auto pressures = static_cast<Eigen::Index>(3 * space.element_count());
    const Eigen::Index velocities = all.rows() - pressures;
    return all.topLeftCorner(velocities, velocities) -
           all.topRightCorner(velocities, pressures) *
               all.bottomRightCorner(pressures, pressures)
                   .lu()
                   .solve(all.bottomLeftCorner(pressures, velocities));
  };
  for (const double lambda_p : {1e-1, 1e-3, 1e-6}) {
    const Eigen::MatrixXd right = penalised_operator(lambda_p);
    BOOST_TEST(is_positive_definite(right));
    BOOST_TEST(!is_positive_definite(penalised_operator(-lambda_p)));
    BOOST_TEST((right - right.transpose()).norm() < 1e-9 * right.norm());
  }
}

BOOST_AUTO_TEST_CASE(reactions_balance_the_body_force_in_a_box) {
  const auto mesh = fem::distorted(
      fem::tensor_mesh<2>({std::vector<double>{0, 0.3, 0.6, 1}, std::vector<double>{0, 0.5, 1}}),
      0.2, 3);
  const MixedSpace<2> space(
      mesh,
      {{"left", no_slip<2>()}, {"right", no_slip<2>()}, {"bottom", no_slip<2>()}, {"top", {}}});
  for (const auto& law : rheology::regularisations()) {
    MixedFlow<2> problem(space, rheology_of(law),
                         {[](const fem::Point<2>&) { return 2.0; },
                          [](const fem::Point<2>& x) { return fem::Point<2>(3 * x[1], -1); }, 0});
    auto state = space.start();
    BOOST_REQUIRE(is_success(solve_to_round_off(problem, state).end));
    fem::Point<2> sum = fem::Point<2>::Zero();
    for (Eigen::Index i = 0; i < space.velocity_count(); ++i)
      if (space.is_fixed(i)) sum[i % 2] += problem.reactions()[i];
    BOOST_TEST((sum + fem::Point<2>(1.5, -1)).norm() < 1e-12);
    BOOST_TEST(state.value().head(space.velocity_count()).norm() > 1e-4);  // it flows
  }
}

BOOST_AUTO_TEST_CASE(a_column_carries_its_weight_and_the_traction_on_top_as_pressure) {
  constexpr double top = 0.4, weight = 1.5, height = 2;
  const auto mesh = fem::distorted(
      fem::tensor_mesh<2>({std::vector<double>{0, 0.5, 1}, std::vector<double>{0, 1, height}}), 0.2,
      2);
  BoundaryCondition<2> lid =
      prescribed_traction<2>([](const fem::Point<2>&, const fem::Point<2>& normal) {
        return fem::Point<2>(-top * normal);
      });
  const MixedSpace<2> space(mesh, {{"left", symmetry<2>(0)},
                                   {"right", symmetry<2>(0)},
                                   {"bottom", no_slip<2>()},
                                   {"top", lid}});
  MixedFlow<2> problem(space, rheology_of(rheology::ChauchatMedale{}),
                       {[](const fem::Point<2>&) { return 0.0; },
                        [](const fem::Point<2>&) { return fem::Point<2>(0, -weight); }});
  auto state = space.start();
  BOOST_REQUIRE(is_success(solve_to_round_off(problem, state).end));
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : fem::gauss_rule<2>(2)) {
      const auto values = space.values_at(state, e, point.position);
      BOOST_TEST(std::abs(values.pressure - top - weight * (height - values.position[1])) < 1e-12);
      BOOST_TEST(values.velocity.norm() < 1e-12);
    }
  double bottom = 0, walls = 0;  // the force on the material there
  for (std::size_t n = 0; n < space.mesh().nodes.size(); ++n) {
    const auto node = static_cast<Eigen::Index>(n);
    if (space.mesh().nodes[n][1] == 0) bottom += problem.reactions()[2 * node + 1];
    if (space.mesh().nodes[n][0] == 0) walls += problem.reactions()[2 * node];
  }
  BOOST_TEST(std::abs(bottom - (top + weight * height)) < 1e-12);
  BOOST_TEST(std::abs(walls - height * (top + 0.5 * weight * height)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(derivatives_in_the_parameters_are_those_of_the_residual) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>());
  for (const auto& law : rheology::regularisations())
    for (const TestState& test : test_states(lambda_r)) {
      MixedFlow<2> problem(space, rheology_of(law), test_load<2>(test.inertia));
      const auto state = state_of(space, test);
      const auto residual = [&](double load, double log_lambda_r) {
        problem.set_load_factor(load);
        problem.set_lambda_r(lambda_r * std::exp(log_lambda_r));
        return problem.evaluate(state).value;
      };
      const Eigen::VectorXd by_load = residual(2, 0) - residual(1, 0);
      // Fourth order: the difference it is compared with has second.
      const auto change = [&](double step) -> Eigen::VectorXd {
        return (residual(1, step) - residual(1, -step)) / (2 * step);
      };
      const Eigen::VectorXd by_lambda = (4 * change(5e-3) - change(1e-2)) / 3;
      const double magnitude = [&] {
        residual(1, 0);
        return problem.evaluate(state).magnitude.lpNorm<Eigen::Infinity>();
      }();
      BOOST_TEST(distance(problem.load_derivative(), by_load) < 1e-12);
      BOOST_TEST((problem.log_lambda_r_derivative(state) - by_lambda).lpNorm<Eigen::Infinity>() <
                     1e-8 * magnitude,
                 rheology::name_of(law) << ", " << test.name);
      if (test.shear_rate > 0 && test.pressure > 0)  // it must not pass as zero
        BOOST_TEST(by_lambda.lpNorm<Eigen::Infinity>() > 1e-6 * magnitude);
    }
}

// A plug between thin layers: where the viscosity saturates.
BOOST_AUTO_TEST_CASE(a_carried_stress_leads_to_the_same_flow_in_fewer_steps) {
  const auto mesh = fem::distorted(
      fem::tensor_mesh<2>({std::vector<double>{0, 0.5, 1}, std::vector<double>{0, 0.2, 0.5, 1}}),
      0.1, 5);
  const MixedSpace<2> space(mesh, {{"left", symmetry<2>(0)},
                                   {"right", no_slip<2>()},
                                   {"bottom", fully_developed<2>(1)},
                                   {"top", fully_developed<2>(1)}});
  const MixedLoad<2> load{[](const fem::Point<2>&) { return 1.0; },
                          [](const fem::Point<2>&) { return fem::Point<2>(0, -0.5); }, 1};
  for (const auto& law : rheology::regularisations()) {
    MixedFlow<2> newton(space, {{}, law, 1e-2}, load), carrying(space, {{}, law, 1e-2}, load);
    carrying.set_primal_dual(true);
    auto expected = space.start(), state = space.start();
    const auto by_newton = solve_to_round_off(newton, expected);
    const auto by_carrying = solve_to_round_off(carrying, state);
    BOOST_REQUIRE(is_success(by_newton.end));
    BOOST_REQUIRE(is_success(by_carrying.end));
    BOOST_TEST(distance(state.value(), expected.value()) < 1e-9, rheology::name_of(law));
    BOOST_TEST(by_carrying.iterations() <= by_newton.iterations(), rheology::name_of(law));

    // Both tangents are the derivative at the solution, and only there.
    const auto direction = state_of(space, flowing);
    const auto apart = [&](const MixedFlow<2>::State& at) {
      newton.evaluate(at);
      carrying.evaluate(MixedFlow<2>::State(at, state.stress));
      return distance(carrying.tangent_product(direction), newton.tangent_product(direction));
    };
    BOOST_TEST(apart(expected) < 1e-6, rheology::name_of(law));
    BOOST_TEST(apart(expected.moved(0.1, direction)) > 1e-4, rheology::name_of(law));
    carrying.set_primal_dual(false);
    BOOST_TEST(apart(expected.moved(0.1, direction)) == 0, rheology::name_of(law));
  }
}

BOOST_AUTO_TEST_CASE(condensing_changes_nothing_with_a_carried_stress) {
  const MixedSpace<2> space(awkward_mesh2(3, 3), mixed_conditions<2>());
  const MixedSpace<3> space3(awkward_mesh3(), mixed_conditions<3>());
  const auto stress2 = [](const fem::Point<2>& x) {
    return Eigen::Matrix2d({{x[0], 0.3}, {0.3, -x[0]}});
  };
  const auto stress3 = [](const fem::Point<3>& x) {
    return Eigen::Matrix3d({{x[0], 0.3, x[1]}, {0.3, -x[0], 0.1}, {x[1], 0.1, 0}});
  };
  const auto error = [](auto problem, const auto& stress, auto state) {
    problem.set_primal_dual(true);
    state.stress = problem.stress_of(stress);
    return std::max(1e2 * product_error(problem, state), condensation_error(problem, state).value);
  };
  const rheology::Rheology rheology = rheology_of(rheology::ChauchatMedale{});
  BOOST_TEST(error(MixedFlow<2>(space, rheology, test_load<2>(1)), stress2,
                   state_of(space, flowing)) < 1e-9);
  BOOST_TEST(error(MixedFlow<3>(space3, rheology, test_load<3>(1)), stress3,
                   state_of(space3, flowing)) < 1e-9);
}
BOOST_AUTO_TEST_SUITE_END()
