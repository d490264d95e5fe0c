#include "common/solve/gmres.hpp"

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include "common/solve/factor_lag.hpp"

BOOST_AUTO_TEST_SUITE(gmres_test)

using namespace talus::solve;

namespace {

constexpr Eigen::Index size = 30;

// The identity and a part of that size, unsymmetric.
Eigen::MatrixXd near_identity(double distance) {
  srand(1);
  return Eigen::MatrixXd::Identity(size, size) +
         distance / std::sqrt(static_cast<double>(size)) * Eigen::MatrixXd::Random(size, size);
}

const Eigen::VectorXd right_hand_side = Eigen::VectorXd::LinSpaced(size, -1, 2);

GmresSummary solve(const Eigen::MatrixXd& matrix, Eigen::VectorXd& x, const GmresOptions& options) {
  return gmres([&](const Eigen::VectorXd& v) { return (matrix * v).eval(); }, right_hand_side, x,
               options);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_reduction_told_is_that_of_the_residual) {
  for (const double distance : {0.1, 0.3, 0.5})
    for (const double tolerance : {1e-2, 1e-6, 1e-12}) {
      const Eigen::MatrixXd matrix = near_identity(distance);
      Eigen::VectorXd x;
      const GmresSummary summary = solve(matrix, x, {tolerance, 30});
      BOOST_TEST(summary.converged);
      const double reduction = (right_hand_side - matrix * x).norm() / right_hand_side.norm();
      BOOST_TEST(reduction <= 1.01 * tolerance + 1e-14);
      BOOST_TEST(std::abs(reduction - summary.reduction) < 1e-14);
    }
}

BOOST_AUTO_TEST_CASE(the_nearer_the_identity_the_fewer_iterations) {
  int last = 0;
  for (const double distance : {0.0, 0.01, 0.1, 1.0}) {
    Eigen::VectorXd x;
    const GmresSummary summary = solve(near_identity(distance), x, {1e-8, 30});
    BOOST_TEST(summary.converged);
    BOOST_TEST(summary.iterations > last);
    last = summary.iterations;
  }
}

BOOST_AUTO_TEST_CASE(it_gives_up_early_where_the_tolerance_is_out_of_reach) {
  const Eigen::MatrixXd far = near_identity(20);
  Eigen::VectorXd x;
  const GmresSummary summary = solve(far, x, {1e-8, 20});
  BOOST_TEST(!summary.converged);
  BOOST_TEST(summary.iterations < 6);
  BOOST_TEST(summary.reduction > 1e-2);
  BOOST_TEST(solve(far, x, {1e-8, size}).iterations <= size);
}

BOOST_AUTO_TEST_CASE(singular_operators_and_numbers_that_are_none_are_refused) {
  Eigen::VectorXd x;
  BOOST_TEST(!solve(Eigen::MatrixXd::Zero(size, size), x, {}).converged);
  BOOST_TEST(!solve(std::nan("") * near_identity(0), x, {}).converged);
}

BOOST_AUTO_TEST_CASE(nothing_on_the_right_has_nothing_as_its_solution) {
  Eigen::VectorXd x;
  const auto summary =
      gmres([](const Eigen::VectorXd& v) { return v; }, Eigen::VectorXd::Zero(size), x, {});
  BOOST_TEST(summary.converged);
  BOOST_TEST(x.norm() == 0);
}

BOOST_AUTO_TEST_CASE(factors_are_due_when_a_solve_costs_more_than_the_average) {
  FactorLag lag;
  BOOST_TEST(lag.budget() == 0);  // no factors yet
  lag.factored(20);
  BOOST_TEST(lag.budget() == 20);
  lag.iterated(6);
  BOOST_TEST(lag.budget() == 13);
  lag.iterated(10);
  BOOST_TEST(lag.budget() == 12);
  lag.factored(30);
  BOOST_TEST(lag.budget() == 30);
}

BOOST_AUTO_TEST_SUITE_END()
