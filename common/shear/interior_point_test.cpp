#include "common/shear/interior_point.hpp"

#include <cmath>
#include <sstream>

#include <boost/test/unit_test.hpp>

#include "common/shear/shear_jacobian.hpp"
#include "common/shear/shear_test_problems.hpp"

BOOST_AUTO_TEST_SUITE(interior_point_test)

using namespace talus;
using namespace talus::shear;

namespace {

constexpr double chute_pressure = 28, plane_angle = 0.406;

// Chute and plane on uniform and graded meshes of these numbers of elements.
template <class Check>
void for_every_layer(std::initializer_list<int> meshes, const Check& check) {
  for (const int elements : meshes)
    for (const double grading : {1., 2., 3.})
      for (Layer& layer : std::vector{chute_layer(chute_pressure, elements, grading),
                                      plane_layer(plane_angle, elements, grading)}) {
        BOOST_TEST_CONTEXT((layer.space.mesh().fixed.front() ? "plane, " : "chute, ")
                           << elements << " elements, grading " << grading) {
          check(layer);
        }
      }
}

// The state after so many steps along the central path.
ConeState<1> state_after(InteriorPoint<1>& problem, int steps) {
  ConeState<1> state = problem.start();
  problem.solve(state, {.max_factorisations = steps});
  return state;
}

// The duality gap of a state over the power of its load.
double gap_of(const InteriorPoint<1>& problem, const Layer& layer, const ConeState<1>& state) {
  const std::vector<double> products = problem.residual(state).product;
  double gap = 0;
  for (std::size_t k = 0; k < products.size(); ++k)
    gap += layer.space.points()[k].weight * products[k];
  return gap / layer.space.load(layer.body_force).dot(state.velocity.value());
}

double pressure_at(const Layer& layer, std::size_t point) {
  return layer.pressure(layer.space.points()[point].position);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_linearisation_is_the_derivative_of_the_optimality_system) {
  for_every_layer({4}, [](Layer& layer) {
    InteriorPoint<1> problem = layer.unregularised();
    for (const int steps : {0, 3, 6}) {
      const ConeState<1> state = state_after(problem, steps);
      const auto check = solve::check_jacobian(jacobian_problem(problem, layer.space, state));
      std::ostringstream text;
      solve::print(text, check);
      BOOST_TEST(check.passed(), "after " << steps << " steps:\n" << text.str());
    }
  });
}

BOOST_AUTO_TEST_CASE(a_wrong_sign_in_the_linearisation_is_caught) {
  Layer layer = chute_layer(chute_pressure, 4);
  InteriorPoint<1> problem = layer.unregularised();
  solve::JacobianProblem broken = jacobian_problem(problem, layer.space, state_after(problem, 3));
  const auto right = broken.product;
  const solve::Block stress = broken.columns.back();
  broken.product = [=](Eigen::VectorXd direction) {
    for (const Eigen::Index i : stress.indices) direction[i] = -direction[i];
    return right(direction);
  };
  const solve::JacobianCheck check = solve::check_jacobian(broken);
  BOOST_TEST(!check.passed());
  BOOST_TEST(!check.entries.passed());
  for (const solve::TaylorTest& test : check.blocks)
    BOOST_TEST(test.passed() ==
                   (test.columns != "all" && (test.columns != "stress" || test.rows == "law")),
               test.rows << " / " << test.columns);
}

BOOST_AUTO_TEST_CASE(the_eliminated_step_solves_the_whole_linear_system) {
  for_every_layer({5, 80}, [](Layer& layer) {
    InteriorPoint<1> problem = layer.unregularised();
    for (const int steps : {0, 3, 6}) {
      const ConeState<1> state = state_after(problem, steps);
      BOOST_TEST(elimination_error(problem, state) < 1e-9);
    }
  });
}

BOOST_AUTO_TEST_CASE(the_gap_falls_to_the_tolerance_within_15_factorisations) {
  for_every_layer({5, 10, 20, 40, 80, 160, 320}, [](Layer& layer) {
    InteriorPoint<1> problem = layer.unregularised();
    ConeState<1> state = problem.start();
    const InteriorPointSummary summary = problem.solve(state);
    BOOST_CHECK(summary.end == solve::End::converged);
    BOOST_TEST(!summary.at_rest);
    BOOST_TEST(summary.relative_gap() >= 0);
    BOOST_TEST(summary.relative_gap() <= 1e-10);
    BOOST_TEST(summary.factorisations() <= 15);
    // Relative to the power of the load, which starts at nothing: falling from the second on.
    for (std::size_t i = 2; i < summary.history.size(); ++i)
      BOOST_TEST(summary.history[i].relative_gap < summary.history[i - 1].relative_gap);
  });
}

BOOST_AUTO_TEST_CASE(the_stress_is_in_equilibrium_and_obeys_the_law) {
  for_every_layer({40}, [](Layer& layer) {
    InteriorPoint<1> problem = layer.unregularised();
    ConeState<1> state = problem.start();
    BOOST_REQUIRE(solve::is_success(problem.solve(state).end));
    const rheology::FrictionLaw law;
    const ConeResidual<1> residual = problem.residual(state);
    BOOST_TEST(residual.equilibrium.lpNorm<Eigen::Infinity>() < 1e-9);
    std::vector<CrossSection<1>::Vector> g;
    layer.space.gradients(state.velocity, g);
    for (std::size_t k = 0; k < g.size(); ++k) {
      const double p = pressure_at(layer, k), tau = state.stress[k].norm(), rate = g[k].norm();
      BOOST_TEST(tau < law.mu_2() * p);
      BOOST_TEST(rate < state.bound[k]);
      BOOST_TEST(tau < state.dual_bound[k]);
      if (rate > 1e-2) BOOST_TEST(std::abs(tau - law.stress(rate, p)) < 1e-6 * p);
    }
  });
}

BOOST_AUTO_TEST_CASE(newton_approaches_the_interior_point_linearly_in_lambda_r) {
  Layer layer = chute_layer(chute_pressure, 40);
  InteriorPoint<1> problem = layer.unregularised();
  ConeState<1> state = problem.start();
  BOOST_REQUIRE(solve::is_success(problem.solve(state, {.tolerance = 1e-12}).end));
  std::vector<double> distances;
  for (const double lambda_r : {1e-4, 1e-5, 1e-6}) {
    ShearFlow<1> regularised = layer.regularised(rheology::ChauchatMedale{}, lambda_r);
    ShearFlow<1>::State w(layer.space.node_count());
    BOOST_REQUIRE(solve::is_success(solve::newton(regularised, w).end));
    distances.push_back((w.value() - state.velocity.value()).lpNorm<Eigen::Infinity>());
  }
  for (std::size_t i = 1; i < distances.size(); ++i) {
    const double order = std::log10(distances[i - 1] / distances[i]);
    BOOST_TEST(order > 0.9);
    BOOST_TEST(order < 1.1);
  }
}

BOOST_AUTO_TEST_CASE(rest_is_certified_and_exact) {
  for (const int elements : {5, 40, 320})
    for (Layer& layer : std::vector{chute_layer(40, elements), plane_layer(0.3, elements, 2)}) {
      InteriorPoint<1> problem = layer.unregularised();
      ConeState<1> state = problem.start();
      const InteriorPointSummary summary = problem.solve(state);
      BOOST_CHECK(summary.end == solve::End::converged);
      BOOST_TEST(summary.at_rest);
      BOOST_TEST(state.velocity.value().norm() == 0);
      for (std::size_t k = 0; k < state.stress.size(); ++k)
        BOOST_TEST(state.stress[k].norm() <= rheology::FrictionLaw{}.mu_s * pressure_at(layer, k));
    }
}

BOOST_AUTO_TEST_CASE(a_load_beyond_the_limit_has_no_steady_state) {
  for (const int elements : {5, 40, 320})
    for (Layer& layer : std::vector{chute_layer(20, elements), plane_layer(0.6, elements, 2)}) {
      InteriorPoint<1> problem = layer.unregularised();
      ConeState<1> state = problem.start();
      BOOST_CHECK(problem.solve(state).end == solve::End::no_steady_state);
    }
}

// The gap may grow meanwhile: the certificate asks for a velocity alone.
BOOST_AUTO_TEST_CASE(a_load_a_little_beyond_the_limit_has_none_either) {
  const double limit = 21.7334;  // of the mesh, found by bisection
  for (int i = 0; i <= 40; ++i) {
    const double pressure = limit * (1 - 5e-4 - 0.04 * i / 40);
    Layer layer = chute_layer(pressure, 160, 1);
    InteriorPoint<1> problem = layer.unregularised();
    ConeState<1> state = problem.start();
    BOOST_TEST_CONTEXT("p " << pressure) {
      BOOST_CHECK(problem.solve(state).end == solve::End::no_steady_state);
    }
  }
}

// Beyond what doubles can resolve the path must end by itself, at a state it can answer for.
BOOST_AUTO_TEST_CASE(an_impossible_tolerance_ends_at_the_round_off_floor) {
  for_every_layer({40}, [](Layer& layer) {
    InteriorPoint<1> problem = layer.unregularised();
    ConeState<1> state = problem.start();
    const InteriorPointSummary summary = problem.solve(state, {.tolerance = 0});
    BOOST_CHECK(summary.end == solve::End::at_round_off_floor);
    BOOST_TEST(summary.relative_gap() < 1e-12);
    BOOST_TEST(gap_of(problem, layer, state) == summary.relative_gap(),
               boost::test_tools::tolerance(1e-12));
  });
}

BOOST_AUTO_TEST_CASE(the_factorisation_limit_ends_in_stagnation_inside_the_cones) {
  Layer layer = chute_layer(chute_pressure, 40);
  InteriorPoint<1> problem = layer.unregularised();
  ConeState<1> state = problem.start();
  const InteriorPointSummary summary = problem.solve(state, {.max_factorisations = 3});
  BOOST_CHECK(summary.end == solve::End::stagnated);
  BOOST_TEST(summary.factorisations() == 3);
  std::vector<CrossSection<1>::Vector> g;
  layer.space.gradients(state.velocity, g);
  for (std::size_t k = 0; k < g.size(); ++k) {
    BOOST_TEST(g[k].norm() < state.bound[k]);
    BOOST_TEST(state.stress[k].norm() < state.dual_bound[k]);
  }
}

BOOST_AUTO_TEST_SUITE_END()
