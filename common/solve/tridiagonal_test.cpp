#include "common/solve/tridiagonal.hpp"

#include <random>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(tridiagonal_test)

using namespace talus::solve;

namespace {

Eigen::MatrixXd dense(const TridiagonalMatrix& matrix) {
  Eigen::MatrixXd result = matrix.diagonal.asDiagonal();
  if (matrix.off_diagonal.size() > 0) {
    result.diagonal(1) = matrix.off_diagonal;
    result.diagonal(-1) = matrix.off_diagonal;
  }
  return result;
}

// Entries in [-1, 1], `shift` added to the diagonal: definite from 2 on, indefinite at 0.
TridiagonalMatrix random_matrix(Eigen::Index n, double shift, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto draw = [&] { return uniform(random); };
  TridiagonalMatrix matrix{Eigen::VectorXd::NullaryExpr(n, draw),
                           Eigen::VectorXd::NullaryExpr(n - 1, draw)};
  matrix.diagonal.array() += shift;
  return matrix;
}

double distance_from_dense(const TridiagonalMatrix& matrix) {
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(matrix.diagonal.size(), 1, 2);
  Eigen::VectorXd x;
  BOOST_REQUIRE(solve_tridiagonal(matrix, b, x));
  const Eigen::VectorXd reference = dense(matrix).fullPivLu().solve(b);
  return (x - reference).norm() / reference.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(definite_systems_agree_with_a_dense_solve) {
  for (const Eigen::Index n : {1, 2, 3, 50})
    BOOST_TEST(distance_from_dense(random_matrix(n, 3, 1)) < 1e-13);
}

BOOST_AUTO_TEST_CASE(indefinite_systems_agree_with_a_dense_solve) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const TridiagonalMatrix matrix = random_matrix(20, 0, seed);
    BOOST_TEST(matrix.diagonal.minCoeff() < 0);
    BOOST_TEST(matrix.diagonal.maxCoeff() > 0);
    BOOST_TEST(distance_from_dense(matrix) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(fluxes_and_velocities_of_a_line_keep_their_digits_over_many_decades) {
  // The skeleton's system: compliances on the flux rows, forces on the velocity rows.
  const Eigen::Vector3d compliance(1e-13, 1, 1e-6), force(1, 2, 3);
  TridiagonalMatrix matrix{Eigen::VectorXd::Zero(6), Eigen::VectorXd(5)};
  matrix.diagonal << -compliance[0], 0, -compliance[1], 0, -compliance[2], 0;
  matrix.off_diagonal << 1, -1, 1, -1, 1;
  Eigen::VectorXd b(6), x;
  b << 0, force[0], 0, force[1], 0, force[2];
  BOOST_REQUIRE(solve_tridiagonal(matrix, b, x));
  double velocity = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double flux = force.tail(3 - i).sum();
    velocity += compliance[i] * flux;
    BOOST_TEST(x[2 * i] == flux, boost::test_tools::tolerance(1e-14));
    BOOST_TEST(x[2 * i + 1] == velocity, boost::test_tools::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(a_zero_pivot_is_reported) {
  Eigen::VectorXd x;
  const Eigen::Vector2d b(1, 1);
  const TridiagonalMatrix zero_first{Eigen::Vector2d(0, 1), Eigen::VectorXd::Constant(1, 1)};
  BOOST_TEST(!solve_tridiagonal(zero_first, b, x));
  const TridiagonalMatrix singular{Eigen::Vector2d(1, 1), Eigen::VectorXd::Constant(1, 1)};
  BOOST_TEST(!solve_tridiagonal(singular, b, x));
  const TridiagonalMatrix one{Eigen::VectorXd::Zero(1), Eigen::VectorXd(0)};
  BOOST_TEST(!solve_tridiagonal(one, Eigen::VectorXd::Ones(1), x));
}

BOOST_AUTO_TEST_SUITE_END()
