// Is a solve that reports success as near its solution as it says?
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/fem/line_mesh.hpp"
#include "oned/scenes.hpp"
#include "oned/solver.hpp"

BOOST_AUTO_TEST_SUITE(trust_test)

using namespace talus;

namespace {

// How far three more iterations go, over the largest velocity.
double distance_left(const oned::ShearScene& scene, const std::vector<double>& line,
                     const oned::SolveOptions& options, const oned::Solution& solution) {
  auto space = oned::space_of(scene, line);
  auto problem = shear::regularised_problem(space, oned::load_of(scene), options);
  shear::ShearFlow<1>::State state(solution.velocity), step;
  for (int i = 0; i < 3; ++i) {
    const Eigen::VectorXd residual = problem.evaluate(state).value;
    BOOST_REQUIRE(problem.linear_solve(-residual, step));
    state = state.moved(1, step);
  }
  return (state.value() - solution.velocity.value()).lpNorm<Eigen::Infinity>() /
         state.value().lpNorm<Eigen::Infinity>();
}

double largest_distance_left(double tolerance, double distance, solve::Precision precision) {
  double largest = 0;
  for (const auto& scene : oned::scenes())
    for (const auto& law : rheology::regularisations())
      for (const double lambda_r : {1e-2, 1e-4, 1e-8, 1e-12})
        for (const oned::MeshOptions& mesh :
             {oned::MeshOptions{.elements = 5}, {.elements = 40, .grading = 2}})
          for (const auto term : {shear::TangentTerm::full, shear::TangentTerm::primal_dual}) {
            oned::SolveOptions options;
            options.regularisation = law;
            options.lambda_r = lambda_r;
            options.precision = precision;
            options.tangent_term = term;
            options.newton.tolerance = tolerance;
            options.newton.distance = distance;
            const auto line = oned::boundaries(scene, mesh);
            const auto solution = oned::solve(scene, line, options);
            BOOST_TEST(solve::is_success(solution.end));
            const double left = distance_left(scene, line, options, solution);
            if (!(left <= largest)) largest = left;
          }
  return largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_answer_is_within_its_tolerance_of_the_discrete_solution) {
  for (const double tolerance : {1e-3, 1e-4, 1e-8, 1e-12}) {
    const double left = largest_distance_left(tolerance, tolerance, solve::Precision::compensated);
    BOOST_TEST(left <= tolerance);
  }
}

BOOST_AUTO_TEST_CASE(an_iterate_in_double_goes_as_far_as_its_rounding_lets_it) {
  const solve::NewtonOptions newton;
  const double left =
      largest_distance_left(newton.tolerance, newton.distance, solve::Precision::plain);
  BOOST_TEST(left <= 1e-9);
}

BOOST_AUTO_TEST_CASE(a_duality_gap_stands_for_a_velocity_as_good_as_its_root) {
  for (const double tolerance : {1e-1, 1e-3, 1e-4, 1e-6, 1e-10})
    for (const auto& scene : oned::scenes())
      for (const int elements : {1, 2, 5, 40, 80}) {
        const auto line = oned::boundaries(scene, {.elements = elements});
        oned::SolveOptions options;
        options.method = shear::Method::interior_point;
        options.interior_point.tolerance = 2e-15;
        const auto exact = oned::solve(scene, line, options);
        options.interior_point.tolerance = tolerance;
        const auto found = oned::solve(scene, line, options);
        BOOST_TEST(solve::is_success(found.end));
        const double size = exact.velocity.value().lpNorm<Eigen::Infinity>();  // 0: at rest
        const Eigen::VectorXd error = found.velocity.value() - exact.velocity.value();
        BOOST_TEST(error.lpNorm<Eigen::Infinity>() <= std::sqrt(tolerance) * size);
      }
}

BOOST_AUTO_TEST_CASE(a_small_residual_alone_is_far_from_the_solution) {
  const double left = largest_distance_left(1e-4, std::numeric_limits<double>::infinity(),
                                            solve::Precision::compensated);
  BOOST_TEST(left > 1e-2);  // what the rule is there for
}

BOOST_AUTO_TEST_SUITE_END()
