#include "common/solve/sparse_cholesky.hpp"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <boost/test/unit_test.hpp>

#include "common/solve/memory.hpp"
#include "common/testing/allocation_limit.hpp"

BOOST_AUTO_TEST_SUITE(sparse_cholesky_test)

using namespace talus::solve;

namespace {

static_assert(sizeof(SparseCholesky::Matrix::StorageIndex) == 8);

// Lower triangle of the five-point Laplacian on a grid, plus `shift` on the diagonal.
SparseCholesky::Matrix laplacian(int side, double shift = 0.1) {
  std::vector<Eigen::Triplet<double, std::int64_t>> entries;
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int n = i + side * j;
      entries.emplace_back(n, n, 4 + shift + 0.01 * n);
      if (i + 1 < side) entries.emplace_back(n + 1, n, -1.0);
      if (j + 1 < side) entries.emplace_back(n + side, n, -1.0);
    }
  SparseCholesky::Matrix matrix(side * side, side * side);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double distance_to_dense_solution(const SparseCholesky& cholesky,
                                  const SparseCholesky::Matrix& lower) {
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(lower.rows(), -1, 2);
  const Eigen::MatrixXd half = lower;
  const Eigen::MatrixXd all = half.selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd dense = all.llt().solve(b);
  Eigen::VectorXd x;
  if (!cholesky.solve(b, x)) return std::numeric_limits<double>::infinity();
  return (x - dense).norm() / dense.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(it_solves_what_dense_elimination_solves_for_every_matrix_of_its_pattern) {
  const SparseCholesky::Matrix first = laplacian(12), second = laplacian(12, 3);
  SparseCholesky cholesky(first);
  BOOST_TEST(cholesky.factor_entries() >= static_cast<double>(first.nonZeros()));
  for (const auto* each : {&first, &second, &first}) {
    BOOST_REQUIRE(cholesky.factor(*each));
    BOOST_TEST(distance_to_dense_solution(cholesky, *each) < 1e-12);
  }
  BOOST_TEST(distance_to_dense_solution(cholesky, second) > 1e-2);  // negative control
}

BOOST_AUTO_TEST_CASE(an_indefinite_matrix_is_refused_and_a_definite_one_taken_again) {
  const SparseCholesky::Matrix right = laplacian(6), wrong = laplacian(6, -6);
  SparseCholesky cholesky(right);
  BOOST_TEST(!cholesky.factor(wrong));
  BOOST_TEST(std::isinf(distance_to_dense_solution(cholesky, wrong)));
  BOOST_TEST(cholesky.factor(right));
  BOOST_TEST(distance_to_dense_solution(cholesky, right) < 1e-12);
}

BOOST_AUTO_TEST_CASE(nothing_is_solved_without_factors_or_to_what_is_not_finite) {
  const SparseCholesky::Matrix matrix = laplacian(4);
  SparseCholesky cholesky(matrix);
  BOOST_TEST(std::isinf(distance_to_dense_solution(cholesky, matrix)));
  BOOST_REQUIRE(cholesky.factor(matrix));
  Eigen::VectorXd b = Eigen::VectorXd::Ones(matrix.rows()), x;
  b[3] = std::nan("");
  BOOST_TEST(!cholesky.solve(b, x));
}

BOOST_AUTO_TEST_CASE(lack_of_memory_is_not_taken_for_an_indefinite_matrix) {
  const SparseCholesky::Matrix matrix = laplacian(60);
  SparseCholesky cholesky(matrix);
  {
    const talus::testing::AllocationLimit limit(100000);
    BOOST_CHECK_THROW(cholesky.factor(matrix), OutOfMemory);
  }
  BOOST_TEST(cholesky.factor(matrix));  // once there is memory again
  BOOST_TEST(distance_to_dense_solution(cholesky, matrix) < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
