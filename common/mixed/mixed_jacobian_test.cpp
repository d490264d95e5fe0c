// Is the tangent of velocity-pressure flow its derivative, for every law, wherever it is awkward?
#include "common/mixed/mixed_jacobian.hpp"

#include <random>
#include <sstream>

#include <boost/test/unit_test.hpp>

#include "common/mixed/mixed_test_problems.hpp"
#include "common/solve/jacobian_entries.hpp"

BOOST_AUTO_TEST_SUITE(mixed_jacobian_test)

using namespace talus;
using namespace talus::mixed;

namespace {

constexpr double lambda_r = 1e-2;
constexpr double scale = 0.1;  // of the displacements
const TestState flowing{"flow with inertia", 1, 1, 0.5, 1};

rheology::Rheology rheology_of(const rheology::Regularisation& regularisation) {
  return {{}, regularisation, lambda_r};
}

template <int Dim>
solve::JacobianCheck check(const MixedSpace<Dim>& space, const rheology::Regularisation& law,
                           const TestState& test, const PenaltyOptions& penalty = {},
                           const TangentFactors& factors = {}) {
  MixedFlow<Dim> problem(space, rheology_of(law), test_load<Dim>(test.inertia), penalty);
  problem.set_tangent_factors(factors);
  return solve::check_jacobian(jacobian_problem(problem, state_of(space, test)), scale);
}

// ∫ (carrier·grad carried)·N, written plainly.
Eigen::VectorXd advection(const MixedSpace<2>& space, const solve::CompensatedVector& carrier,
                          const solve::CompensatedVector& carried) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(space.size());
  for (std::size_t e = 0; e < space.element_count(); ++e)
    for (const auto& point : fem::gauss_rule<2>(3)) {
      const fem::ElementPoint<2> at(space.mesh(), e, point.position);
      const fem::Point<2> force = point.weight * at.determinant *
                                  (space.values_at(carried, e, point.position).velocity_gradient *
                                   space.values_at(carrier, e, point.position).velocity);
      for (int a = 0; a < 9; ++a)
        for (int i = 0; i < 2; ++i)
          result[space.velocity_index(space.mesh().elements[e][static_cast<std::size_t>(a)], i)] +=
              at.values[a] * force[i];
    }
  space.clear_fixed(result);
  return result;
}

std::string printed(const solve::JacobianCheck& check) {
  std::ostringstream text;
  solve::print(text, check);
  return text.str();
}

// A percent off in some entries, drawn from all but those negligible in their rows.
template <int Dim>
void check_entries(const MixedSpace<Dim>& space, int draws) {
  std::mt19937 random(1);
  for (const double lambda : {1e-1, 1e-10})
    for (const TestState& at : {flowing, TestState{"yield", lambda, 0, 0.5, 0}}) {
      MixedFlow<Dim> problem(space, {{}, rheology::ChauchatMedale{}, lambda},
                             test_load<Dim>(at.inertia), {Penalty::plain, 1e-2});
      auto jacobian = jacobian_problem(problem, state_of(space, at));
      const auto right = jacobian.product;
      const Eigen::MatrixXd matrix = solve::claimed_matrix(jacobian);
      const Eigen::MatrixXd scaled = matrix.cwiseAbs() * jacobian.scale.asDiagonal();
      std::uniform_int_distribution<Eigen::Index> any(0, space.size() - 1);
      for (int left = draws; left > 0;) {
        const Eigen::Index row = any(random), column = any(random);
        if (matrix(row, column) == 0 || scaled(row, column) < 1e-4 * scaled.row(row).maxCoeff())
          continue;
        --left;
        jacobian.product = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
          Eigen::VectorXd product = right(v);
          product[row] += 0.01 * matrix(row, column) * v[column];
          return product;
        };
        const auto result = solve::check_jacobian(jacobian);
        BOOST_TEST(name_of(result.verdict()) == "WRONG",
                   Dim << "D, " << at.name << ", " << lambda << ": " << row << ", " << column);
        BOOST_TEST(result.entries.row == row);
        BOOST_TEST(result.entries.column == column);
      }
    }
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_tangent_is_the_derivative_for_every_law_and_state) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>());
  for (const auto& law : rheology::regularisations())
    for (const TestState& test : test_states(lambda_r)) {
      const solve::JacobianCheck result = check(space, law, test);
      BOOST_TEST(result.passed(), rheology::name_of(law)
                                      << ", " << test.name << ": slope " << result.smallest_slope()
                                      << ", entry " << result.entries.worst);
      BOOST_TEST(result.smallest_slope() < 3.5);
    }
}

BOOST_AUTO_TEST_CASE(the_tangent_of_a_plain_penalty_is_right_too) {
  const MixedSpace<2> space(awkward_mesh2(3, 2), mixed_conditions<2>(false));
  for (const auto& law : rheology::regularisations())
    BOOST_TEST(check(space, law, flowing, {Penalty::plain, 1e-2}).passed(), rheology::name_of(law));
}

BOOST_AUTO_TEST_CASE(the_tangent_is_right_in_three_dimensions) {
  const MixedSpace<3> space(awkward_mesh3(), mixed_conditions<3>());
  for (const auto& law : rheology::regularisations())
    BOOST_TEST(check(space, law, flowing).passed(), rheology::name_of(law));
}

BOOST_AUTO_TEST_CASE(a_part_of_the_tangent_left_out_or_with_its_sign_wrong_is_caught) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>());
  for (const auto& law : rheology::regularisations())
    for (const double wrong : {0.0, -1.0})
      for (const TangentFactors& factors :
           {TangentFactors{wrong, 1, 1}, {1, wrong, 1}, {1, 1, wrong}}) {
        const auto result = check(space, law, flowing, {}, factors);
        BOOST_TEST(!result.passed(), rheology::name_of(law)
                                         << " with " << factors.shear_rate << ", "
                                         << factors.pressure << ", " << factors.inertia);
        BOOST_TEST(result.smallest_slope() < 1.2);
      }
}

// What --check-jacobian tries.
BOOST_AUTO_TEST_CASE(a_scene_passes_at_every_state_and_fails_with_any_part_of_its_tangent_broken) {
  const auto without_traction = [](auto conditions) {
    conditions["top"] = {};  // its rounding would hide stresses of 1e-11
    return conditions;
  };
  const MixedSpace<2> space(awkward_mesh2(2, 1), without_traction(mixed_conditions<2>()));
  const std::vector<double> once{0, 1};
  const MixedSpace<3> space3(curved(fem::box_mesh(once, once, once)),
                             without_traction(mixed_conditions<3>()));
  const auto worst = [](const auto& scene, double pressure) {
    auto verdict = solve::Verdict::right;
    for (const auto& [state, check] : check_jacobian(scene, pressure))
      verdict = std::max(verdict, check.verdict());
    return name_of(verdict);
  };
  const std::vector<double> pressures{0.3, 1, 20};
  const std::vector<double> factors{2, 0.5, 0, -1, 1.01, std::numeric_limits<double>::quiet_NaN()};
  std::size_t count = 0;
  for (const auto& law : rheology::regularisations())
    for (const double each : {1e-1, 1e-4, 1e-10}) {
      MixedFlow<2> scene(space, {{}, law, each}, test_load<2>(1));
      const double pressure = pressures[count % 3];
      BOOST_TEST(worst(scene, pressure) == "ok", rheology::name_of(law) << ", " << each);
      const double f = factors[count++ % 6];
      for (const TangentFactors& broken : {TangentFactors{f, 1, 1}, {1, f, 1}, {1, 1, f}}) {
        scene.set_tangent_factors(broken);
        BOOST_TEST(worst(scene, pressure) == "WRONG", rheology::name_of(law)
                                                          << ", " << each << ", factor " << f);
      }
    }
  MixedFlow<3> scene(space3, rheology_of(rheology::ChauchatMedale{}), test_load<3>(1));
  BOOST_TEST(worst(scene, 1) == "ok");
  scene.set_tangent_factors({1, 2, 1});
  BOOST_TEST(worst(scene, 1) == "WRONG");
}

// The block of a plain penalty is linear, and tiny beside the divergence where the pressure is.
BOOST_AUTO_TEST_CASE(a_plain_penalty_is_right_at_every_state_and_wrong_with_its_block_changed) {
  auto conditions = mixed_conditions<2>(false);
  conditions["top"] = {};  // the rounding of a traction would hide the viscosity that is left
  const MixedSpace<2> space(awkward_mesh2(2, 1), conditions);
  std::size_t count = 0;
  for (const auto& law : rheology::regularisations())
    for (const double each : {1e-1, 1e-4, 1e-7, 1e-10}) {
      const double lambda_p = count % 2 == 0 ? 1e-8 : 1e-4, inertia = count % 3 == 0 ? 0 : 1;
      const MixedFlow<2> scene(space, {{}, law, each}, test_load<2>(inertia),
                               {Penalty::plain, lambda_p});
      ++count;
      for (const auto& [state, check] : check_jacobian(scene, 1)) {
        BOOST_TEST(name_of(check.verdict()) == "ok", rheology::name_of(law)
                                                         << ", " << each << ", " << lambda_p << ", "
                                                         << state << '\n'
                                                         << printed(check));
      }
    }
  for (const double lambda_p : {1e-2, 1e-5, 1e-8, 1e-10}) {
    MixedFlow<2> problem(space, rheology_of(rheology::ChauchatMedale{}), test_load<2>(1),
                         {Penalty::plain, lambda_p});
    auto jacobian = jacobian_problem(problem, state_of(space, flowing));
    BOOST_TEST(name_of(solve::check_jacobian(jacobian).verdict()) == "ok", lambda_p);
    const auto right = jacobian.product;
    const Eigen::Index pressures = space.size() - space.velocity_count();
    for (const double factor : {2.0, 0.5, 0.0, -1.0, 1.01, 0.99}) {
      jacobian.product = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
        Eigen::VectorXd pressure = v, product = right(v);
        pressure.head(space.velocity_count()).setZero();
        product.tail(pressures) += (factor - 1) * right(pressure).tail(pressures);
        return product;
      };
      BOOST_TEST(name_of(solve::check_jacobian(jacobian).verdict()) == "WRONG",
                 lambda_p << ", factor " << factor);
    }
  }
}

BOOST_AUTO_TEST_CASE(one_entry_a_percent_off_is_wrong_and_located_on_the_smallest_meshes) {
  const std::vector<double> once{0, 1}, twice{0, 0.4, 1};
  const auto mesh = [](const auto& x, const auto& y, const auto& z) {
    return curved(fem::box_mesh(x, y, z));
  };
  check_entries(MixedSpace<2>(awkward_mesh2(1, 1), mixed_conditions<2>()), 12);
  check_entries(MixedSpace<3>(mesh(once, once, once), mixed_conditions<3>()), 12);
  check_entries(MixedSpace<3>(mesh(twice, once, twice), mixed_conditions<3>()), 2);
}

BOOST_AUTO_TEST_CASE(a_percent_missing_at_the_open_boundary_is_caught) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>());
  const MixedSpace<2> closed(awkward_mesh2(2, 2), mixed_conditions<2>(false));
  const auto law = rheology_of(rheology::ChauchatMedale{});
  MixedFlow<2> problem(space, law, test_load<2>(1)), without(closed, law, test_load<2>(1));
  const auto state = state_of(space, flowing);
  auto jacobian = jacobian_problem(problem, state);
  const auto right = jacobian.product, no_side = jacobian_problem(without, state).product;
  jacobian.product = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return right(v) - 0.01 * (right(v) - no_side(v));
  };
  BOOST_TEST(!solve::check_jacobian(jacobian, scale).passed());
}

// Eq. (13): the first variation of the advective term is u'·grad u + u·grad u'.
BOOST_AUTO_TEST_CASE(half_of_the_variation_of_the_advective_term_in_eq_13_is_not_enough) {
  const MixedSpace<2> space(awkward_mesh2(2, 2), mixed_conditions<2>());
  const auto law = rheology_of(rheology::ChauchatMedale{});
  MixedFlow<2> problem(space, law, test_load<2>(1)), inertialess(space, law, test_load<2>(0));
  const auto u = state_of(space, flowing);
  auto jacobian = jacobian_problem(problem, u);
  const auto right = jacobian.product, rest = jacobian_problem(inertialess, u).product;

  Eigen::VectorXd direction = Eigen::VectorXd::LinSpaced(space.size(), -1, 2);
  space.clear_fixed(direction);
  const solve::CompensatedVector v(direction);
  const Eigen::VectorXd both = right(direction) - rest(direction);
  BOOST_TEST((both - advection(space, v, u) - advection(space, u, v)).norm() <
             1e-13 * right(direction).norm());

  for (const bool drop_first : {true, false}) {
    jacobian.product = [&](const Eigen::VectorXd& w) -> Eigen::VectorXd {
      Eigen::VectorXd free = w;
      space.clear_fixed(free);
      const solve::CompensatedVector change(free);
      return right(w) - (drop_first ? advection(space, change, u) : advection(space, u, change));
    };
    BOOST_TEST(!solve::check_jacobian(jacobian, scale).passed());
  }
}

BOOST_AUTO_TEST_SUITE_END()
