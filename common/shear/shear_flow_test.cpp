#include "common/shear/shear_flow.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

#include <boost/test/unit_test.hpp>

#include "common/fem/quadrature.hpp"
#include "common/shear/shear_jacobian.hpp"
#include "common/shear/shear_test_problems.hpp"
#include "common/testing/difference.hpp"

BOOST_AUTO_TEST_SUITE(shear_flow_test)
using namespace talus;
using namespace talus::shear;
using boost::test_tools::tolerance;
using State = ShearFlow<1>::State;
namespace {
using Space = CrossSection<1>;
using Tangents = std::vector<Space::Tangent>;

constexpr long double extended_epsilon = std::numeric_limits<long double>::epsilon();
const std::vector<double> uneven{0, 0.1, 0.7, 1.5, 1.6, 3};  // element boundaries

Space uneven_space(bool fixed_at_start, bool fixed_at_end) {
  return Space(fem::line_mesh(uneven, fixed_at_start, fixed_at_end));
}

double position(const Space& space, Eigen::Index node) {
  return space.mesh().nodes[static_cast<std::size_t>(node)][0];
}

Tangents constant_tangents(const Space& space, double value) {
  return Tangents(space.points().size(), Space::Tangent(value));
}

Eigen::VectorXd random_forces(const Space& space, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd forces =
      Eigen::VectorXd::NullaryExpr(space.node_count(), [&] { return uniform(random); });
  space.clear_fixed(forces);
  return forces;
}

// Largest |K x - b| after a solve and `refinements` more for what is left, relative to max|b|.
double residual_of_solve(Space& space, const Tangents& tangents, int refinements,
                         std::mt19937& random) {
  const Eigen::VectorXd b = random_forces(space, random);
  space.assemble(tangents);
  State x(space.node_count()), correction;
  Eigen::VectorXd rest = b;
  for (int i = 0; i <= refinements; ++i) {
    BOOST_REQUIRE(space.solve(rest, correction));
    x = x.moved(1, correction);
    rest = b - space.product(tangents, x);
  }
  return rest.lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

// ∫ D(|grad w|) - f w with D = ∫ η s ds by quadrature: the energy Newton minimises.
double energy(const Layer& layer, const rheology::Rheology& rheology, const Eigen::VectorXd& load,
              const State& w) {
  static const auto rule = fem::gauss_legendre(40);
  std::vector<Space::Vector> g;
  layer.space.gradients(w, g);
  double sum = -load.dot(w.value());
  for (std::size_t k = 0; k < g.size(); ++k) {
    const auto& point = layer.space.points()[k];
    const double rate = g[k].norm(), p = layer.pressure(point.position);
    for (const auto& [x, weight] : rule) {
      const double s = 0.5 * rate * (1 + x);
      sum += point.weight * 0.5 * rate * weight * rheology.evaluate(s, p).eta * s;
    }
  }
  return sum;
}

State solved(ShearFlow<1>& problem, const Space& space) {
  State w(space.node_count());
  BOOST_REQUIRE(solve::is_success(solve::newton(problem, w).end));
  return w;
}

}  // namespace

BOOST_AUTO_TEST_CASE(loads_sum_to_the_force_and_its_moment) {
  const Space space = uneven_space(false, false);
  const Eigen::VectorXd load = space.load([](const auto& x) { return 2 + x[0]; });
  double moment = 0;
  for (Eigen::Index i = 0; i < load.size(); ++i) moment += load[i] * position(space, i);
  BOOST_TEST(load.sum() == 2 * 3 + 9 / 2., tolerance(1e-14));
  BOOST_TEST(moment == 9 + 27 / 3., tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_fixed_node_carries_no_load) {
  constexpr double f = 2;
  const Eigen::VectorXd load = uneven_space(true, false).load([](const auto&) { return f; });
  BOOST_TEST(load[0] == 0);
  BOOST_TEST(load.sum() == f * (3 - 0.1 / 6), tolerance(1e-14));  // its share: h/6
}

BOOST_AUTO_TEST_CASE(parabolas_are_exact_on_an_uneven_mesh) {
  constexpr double k = 2, f = 3, L = 3;
  const auto start_fixed = [](double x) { return f / k * (L * x - x * x / 2); };
  const auto end_fixed = [](double x) { return f / k * (L * L - x * x) / 2; };
  const auto both_fixed = [](double x) { return f / k * (L * x - x * x) / 2; };
  const std::tuple<bool, bool, std::function<double(double)>> cases[] = {
      {true, false, start_fixed}, {false, true, end_fixed}, {true, true, both_fixed}};
  for (const auto& [at_start, at_end, exact] : cases) {
    Space space = uneven_space(at_start, at_end);
    space.assemble(constant_tangents(space, k));
    State w;
    BOOST_REQUIRE(space.solve(space.load([](const auto&) { return f; }), w));
    for (Eigen::Index i = 0; i < w.size(); ++i)
      BOOST_TEST(std::abs(w.value()[i] - exact(position(space, i))) < 1e-14 * f / k * L * L);
  }
}

BOOST_AUTO_TEST_CASE(a_traction_at_the_free_end_gives_a_straight_line) {
  constexpr double k = 2, traction = 5;
  Space space = uneven_space(true, false);
  space.assemble(constant_tangents(space, k));
  Eigen::VectorXd force = Eigen::VectorXd::Zero(space.node_count());
  force[force.size() - 1] = traction;
  State w;
  BOOST_REQUIRE(space.solve(force, w));
  std::vector<Space::Vector> g;
  space.gradients(w, g);
  for (const auto& gradient : g) BOOST_TEST(gradient[0] == traction / k, tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(a_body_that_is_nowhere_fixed_cannot_be_solved) {
  Space space = uneven_space(false, false);
  space.assemble(constant_tangents(space, 1));
  State w;
  BOOST_TEST(!space.solve(space.load([](const auto&) { return 1.; }), w));
}

BOOST_AUTO_TEST_CASE(the_condensed_solve_inverts_the_product) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(1, 2);
  for (const auto& [at_start, at_end] : {std::pair{true, false}, {false, true}, {true, true}}) {
    Space space = uneven_space(at_start, at_end);
    Tangents tangents(space.points().size());
    for (auto& tangent : tangents) tangent(0, 0) = uniform(random);
    BOOST_TEST(residual_of_solve(space, tangents, 0, random) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(tangents_that_jump_by_1e13_between_elements_cost_no_digits) {
  std::mt19937 random(2);
  for (const auto& [at_start, at_end] : {std::pair{true, false}, {false, true}})
    for (const std::size_t stiff : {0u, 2u, 4u}) {
      Space space = uneven_space(at_start, at_end);
      Tangents tangents = constant_tangents(space, 1);
      for (std::size_t q = 0; q < 3; ++q) tangents[3 * stiff + q](0, 0) = 1e13;
      BOOST_TEST(residual_of_solve(space, tangents, 0, random) < 1e-13);
    }
}

// The gradient at the stiff point is what two slopes leave: known to an extended rounding of them.
BOOST_AUTO_TEST_CASE(a_jump_inside_an_element_is_refined_to_the_extended_rounding) {
  std::mt19937 random(3);
  for (const double jump : {1e4, 1e8, 1e13})
    for (const auto& [at_start, at_end] : {std::pair{true, false}, {false, true}})
      for (std::size_t stiff = 0; stiff < 15; ++stiff) {
        Space space = uneven_space(at_start, at_end);
        Tangents tangents = constant_tangents(space, 1);
        tangents[stiff](0, 0) = jump;
        const double floor = 10 * jump * static_cast<double>(extended_epsilon);
        BOOST_TEST(residual_of_solve(space, tangents, 2, random) < std::max(floor, 1e-13),
                   "jump " << jump << " at point " << stiff);
      }
}

BOOST_AUTO_TEST_CASE(the_residual_is_the_gradient_of_the_energy) {
  for (const auto& regularisation : rheology::regularisations()) {
    Layer layer = plane_layer(0.406, 4);
    ShearFlow<1> problem = layer.regularised(regularisation, 0.1);
    std::mt19937 random(4);
    const State w(random_forces(layer.space, random));
    const State v(random_forces(layer.space, random));
    const double slope = problem.evaluate(w).value.dot(v.value());
    const double expected = testing::difference(
        [&](double t) { return energy(layer, problem.rheology(), problem.load(), w.moved(t, v)); },
        0, 0.1);
    BOOST_TEST(slope == expected, tolerance(1e-7));
  }
}

BOOST_AUTO_TEST_CASE(the_tangent_is_the_derivative_of_the_residual_for_every_law) {
  for (const auto& regularisation : rheology::regularisations())
    for (Layer& layer : std::vector{chute_layer(28, 5), plane_layer(0.406, 5)}) {
      ShearFlow<1> problem = layer.regularised(regularisation, 1e-3);
      const State rest(layer.space.node_count());
      const State flow = solved(problem, layer.space);
      const double scale = flow.value().lpNorm<Eigen::Infinity>();
      for (const State& state : {rest, rest.moved(0.5, flow), flow})
        BOOST_TEST(
            solve::check_jacobian(jacobian_problem(problem, layer.space, state), scale).passed(),
            rheology::name_of(regularisation));
    }
}

// Both solve the same equation; only the way there differs.
BOOST_AUTO_TEST_CASE(the_primal_dual_form_finds_the_flow_that_newton_s_own_tangent_finds) {
  for (const auto& regularisation : rheology::regularisations())
    for (Layer& layer : std::vector{chute_layer(28, 20), plane_layer(0.406, 20)}) {
      std::vector<State> flows;
      std::vector<int> iterations;
      for (const TangentTerm term : {TangentTerm::full, TangentTerm::primal_dual}) {
        ShearFlow<1> problem = layer.regularised(regularisation, 1e-6);
        problem.set_tangent_term(term);
        flows.emplace_back(layer.space.node_count());
        const solve::NewtonSummary summary = solve::newton(problem, flows.back());
        BOOST_TEST(solve::is_success(summary.end));
        iterations.push_back(summary.iterations());
      }
      BOOST_TEST((flows[0].value() - flows[1].value()).lpNorm<Eigen::Infinity>() <
                 1e-9 * flows[0].value().lpNorm<Eigen::Infinity>());
      BOOST_TEST(iterations[1] <= iterations[0] + 3, rheology::name_of(regularisation));
    }
}

BOOST_AUTO_TEST_CASE(a_tangent_without_the_derivative_of_the_viscosity_is_caught) {
  for (const auto& regularisation : rheology::regularisations())
    for (const TangentTerm term : {TangentTerm::frozen, TangentTerm::wrong_sign}) {
      Layer layer = chute_layer(28, 5);
      ShearFlow<1> problem = layer.regularised(regularisation, 1e-3);
      const State flow = solved(problem, layer.space);
      problem.set_tangent_term(term);
      const solve::JacobianCheck check =
          solve::check_jacobian(jacobian_problem(problem, layer.space, flow), 1);
      BOOST_TEST(!check.passed());
      BOOST_TEST(!check.entries.passed());
      BOOST_TEST(check.smallest_slope() > 0.9);
      BOOST_TEST(check.smallest_slope() < 1.1);
    }
}

BOOST_AUTO_TEST_CASE(the_round_off_of_a_plain_iterate_is_predicted_within_a_factor_100) {
  for (Layer& layer : std::vector{chute_layer(28, 40), plane_layer(0.406, 40)}) {
    ShearFlow<1> problem = layer.regularised(rheology::ChauchatMedale{}, 1e-10);
    State plain(layer.space.node_count(), solve::Precision::plain);
    const solve::NewtonSummary summary = solve::newton(problem, plain, {.tolerance = 0});
    BOOST_CHECK(summary.end == solve::End::at_round_off_floor);
    BOOST_TEST(summary.final_residual() < summary.round_off_floor());
    BOOST_TEST(summary.final_residual() > summary.round_off_floor() / 100);
  }
}

BOOST_AUTO_TEST_CASE(a_compensated_iterate_reaches_what_a_plain_one_cannot) {
  Layer layer = chute_layer(28, 40);
  ShearFlow<1> problem = layer.regularised(rheology::ChauchatMedale{}, 1e-10);
  State plain(layer.space.node_count(), solve::Precision::plain);
  BOOST_TEST(solve::newton(problem, plain).final_residual() > 1e-12);
  State kept(layer.space.node_count());
  const solve::NewtonSummary summary = solve::newton(problem, kept);
  BOOST_CHECK(summary.end == solve::End::converged);
  BOOST_TEST(summary.final_residual() <= 1e-12);
}

// Both families ask one law for η(|γ|, p_regu(p)): a floor of the pressure, or none at all,
// included.
BOOST_AUTO_TEST_CASE(the_stress_is_that_of_the_rheology_with_every_pressure_it_can_be_given) {
  std::mt19937 random(5);
  int below_the_floor = 0;
  for (const auto& regularisation : rheology::regularisations())
    for (const double floor : {0.0, 0.5, 5.0})
      for (const bool regularises : {true, false}) {
        Layer layer = plane_layer(0.406, 6);
        const auto pressure = [](const auto& z) { return 9 - z[0]; };  // negative at the surface
        rheology::Rheology rheology({}, regularisation, 1e-2);
        rheology.pressure_floor = floor;
        rheology.regularises_pressure = regularises;
        ShearFlow<1> problem(layer.space, rheology, pressure, layer.body_force);
        problem.set_lambda_r(rheology.lambda_r = 1e-3);
        problem.set_tangent_term(TangentTerm::primal_dual);
        State w(random_forces(layer.space, random));
        std::vector<Space::Vector> g;
        layer.space.gradients(w, g);
        w.stress = problem.stress_of(std::vector<Space::Vector>(g.size(), Space::Vector(0.3)));
        problem.evaluate(w);
        BOOST_TEST(problem.tangent_product(w).allFinite());
        for (std::size_t k = 0; k < g.size(); ++k) {
          const double p = pressure(layer.space.points()[k].position);
          const double eta = rheology.evaluate(g[k].norm(), p).eta;
          BOOST_TEST(problem.stress()[k][0] == eta * g[k][0], tolerance(1e-14));
          below_the_floor += regularises && p < floor;
        }
      }
  BOOST_TEST(below_the_floor > 0);
}
BOOST_AUTO_TEST_SUITE_END()
