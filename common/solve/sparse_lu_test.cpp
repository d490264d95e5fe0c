#include "common/solve/sparse_lu.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <Eigen/LU>
#include <boost/test/unit_test.hpp>

#include "common/solve/memory.hpp"
#include "common/testing/allocation_limit.hpp"

BOOST_AUTO_TEST_SUITE(sparse_lu_test)

using namespace talus::solve;
using boost::test_tools::tolerance;

namespace {

// Unsymmetric values on the symmetric pattern of a grid, `per_node` unknowns a node.
struct GridMatrix {
  SparseLu::Matrix matrix;
  std::vector<int> node_of_row;
};

GridMatrix grid_matrix(int side, int per_node, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  GridMatrix grid;
  std::vector<Eigen::Triplet<double, int>> entries;
  const int nodes = side * side;
  for (int n = 0; n < nodes; ++n)
    for (int m = 0; m < nodes; ++m) {
      const bool near = std::abs(n % side - m % side) <= 1 && std::abs(n / side - m / side) <= 1;
      for (int i = 0; near && i < per_node; ++i)
        for (int j = 0; j < per_node; ++j)
          entries.emplace_back(per_node * n + i, per_node * m + j, uniform(random));
    }
  for (int row = 0; row < nodes * per_node; ++row) grid.node_of_row.push_back(row / per_node);
  grid.matrix.resize(nodes * per_node, nodes * per_node);
  grid.matrix.setFromTriplets(entries.begin(), entries.end());
  return grid;
}

int sign(double value) {
  return (value > 0) - (value < 0);
}

Eigen::VectorXd right_hand_side(Eigen::Index size) {
  return Eigen::VectorXd::LinSpaced(size, -1, 2);
}

double distance_to_dense_solution(const SparseLu& lu, const SparseLu::Matrix& matrix) {
  const Eigen::VectorXd b = right_hand_side(matrix.rows());
  const Eigen::VectorXd dense = Eigen::MatrixXd(matrix).fullPivLu().solve(b);
  Eigen::VectorXd x;
  if (!lu.solve(b, x)) return std::numeric_limits<double>::infinity();
  return (x - dense).norm() / dense.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(it_solves_what_dense_elimination_solves) {
  for (const int per_node : {1, 2, 3}) {
    const GridMatrix grid = grid_matrix(6, per_node, 1);
    SparseLu lu(grid.matrix, grid.node_of_row);
    BOOST_TEST(lu.factor_entries() == 0);
    BOOST_REQUIRE(lu.factor(grid.matrix));
    BOOST_TEST(distance_to_dense_solution(lu, grid.matrix) < 1e-10);
    BOOST_TEST(lu.factor_entries() >= static_cast<double>(grid.matrix.nonZeros()));
  }
}

BOOST_AUTO_TEST_CASE(a_factorisation_costs_more_solves_the_more_the_factors_fill) {
  double last = 0;
  for (const int side : {4, 12, 36}) {
    const GridMatrix grid = grid_matrix(side, 2, 1);
    SparseLu lu(grid.matrix, grid.node_of_row);
    BOOST_REQUIRE(lu.factor(grid.matrix));
    BOOST_TEST(lu.solves_per_factorisation() > std::max(last, 1.0));
    last = lu.solves_per_factorisation();
  }
}

BOOST_AUTO_TEST_CASE(a_small_diagonal_does_not_fill_the_factors) {
  // Two unknowns a node: rotated against each other in the second matrix, nearly by a right angle.
  const auto entries = [](double diagonal, double coupling) {
    GridMatrix grid = grid_matrix(12, 2, 1);
    for (int column = 0; column < grid.matrix.outerSize(); ++column)
      for (SparseLu::Matrix::InnerIterator entry(grid.matrix, column); entry; ++entry)
        if (entry.row() == column)
          entry.valueRef() = diagonal;
        else if (entry.row() / 2 == column / 2)
          entry.valueRef() = entry.row() < column ? coupling : -coupling;
        else
          entry.valueRef() *= 1e-5;
    SparseLu lu(grid.matrix, grid.node_of_row);
    BOOST_REQUIRE(lu.factor(grid.matrix));
    BOOST_TEST(distance_to_dense_solution(lu, grid.matrix) < 1e-9);
    return lu.factor_entries();
  };
  BOOST_TEST(entries(1e-4, 1) == entries(1, 1e-4));
}

BOOST_AUTO_TEST_CASE(one_analysis_serves_every_matrix_of_its_pattern) {
  const GridMatrix first = grid_matrix(5, 2, 1), second = grid_matrix(5, 2, 2);
  SparseLu lu(first.matrix, first.node_of_row);
  for (const GridMatrix* each : {&first, &second, &first}) {
    BOOST_REQUIRE(lu.factor(each->matrix));
    BOOST_TEST(distance_to_dense_solution(lu, each->matrix) < 1e-10);
  }
  // Negative control: the factors of the one do not solve the other.
  BOOST_TEST(distance_to_dense_solution(lu, second.matrix) > 1e-2);
}

BOOST_AUTO_TEST_CASE(the_determinant_has_its_sign_also_where_it_is_negative) {
  std::vector<int> seen;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const GridMatrix grid = grid_matrix(3, 2, seed);
    SparseLu lu(grid.matrix, grid.node_of_row);
    BOOST_REQUIRE(lu.factor(grid.matrix));
    const int expected = sign(Eigen::MatrixXd(grid.matrix).determinant());
    BOOST_TEST(lu.determinant_sign() == expected);
    seen.push_back(expected);
  }
  BOOST_TEST(std::abs(std::accumulate(seen.begin(), seen.end(), 0)) < 12);  // both occurred
}

BOOST_AUTO_TEST_CASE(the_sign_outlives_the_range_of_numbers) {
  GridMatrix grid = grid_matrix(10, 2, 3);
  const int expected = sign(Eigen::MatrixXd(grid.matrix).determinant());
  grid.matrix *= 1e-30;  // 200 unknowns: the determinant itself is 0 in double
  SparseLu lu(grid.matrix, grid.node_of_row);
  BOOST_REQUIRE(lu.factor(grid.matrix));
  BOOST_TEST(lu.determinant_sign() == expected);
  BOOST_TEST(expected != 0);
}

BOOST_AUTO_TEST_CASE(a_singular_matrix_is_refused_and_a_regular_one_taken_again) {
  const GridMatrix grid = grid_matrix(4, 2, 4);
  SparseLu::Matrix singular = grid.matrix;
  for (int column = 0; column < singular.outerSize(); ++column)
    for (SparseLu::Matrix::InnerIterator entry(singular, column); entry; ++entry)
      if (entry.row() == 5) entry.valueRef() = 0;
  SparseLu lu(grid.matrix, grid.node_of_row);
  BOOST_TEST(!lu.factor(singular));
  BOOST_TEST(lu.determinant_sign() == 0);
  BOOST_TEST(lu.factor(grid.matrix));
  BOOST_TEST(distance_to_dense_solution(lu, grid.matrix) < 1e-10);
}

BOOST_AUTO_TEST_CASE(lack_of_memory_is_not_taken_for_a_singular_matrix) {
  const GridMatrix grid = grid_matrix(25, 3, 4);
  SparseLu lu(grid.matrix, grid.node_of_row);
  {
    const talus::testing::AllocationLimit limit(50000);
    BOOST_CHECK_THROW(lu.factor(grid.matrix), OutOfMemory);
  }
  BOOST_REQUIRE(lu.factor(grid.matrix));  // once there is memory again
  {
    const talus::testing::AllocationLimit limit(100);
    Eigen::VectorXd x;
    BOOST_CHECK_THROW(lu.solve(right_hand_side(grid.matrix.rows()), x), OutOfMemory);
  }
  BOOST_TEST(distance_to_dense_solution(lu, grid.matrix) < 1e-10);
}

BOOST_AUTO_TEST_CASE(indices_have_64_bits) {
  BOOST_TEST(sizeof(SparseLu::Matrix::StorageIndex) == 8U);
}

BOOST_AUTO_TEST_CASE(without_factors_nothing_is_solved) {
  const GridMatrix grid = grid_matrix(3, 1, 1);
  const SparseLu lu(grid.matrix, grid.node_of_row);
  Eigen::VectorXd x;
  BOOST_TEST(!lu.solve(right_hand_side(grid.matrix.rows()), x));
  BOOST_TEST(lu.determinant_sign() == 0);
}

BOOST_AUTO_TEST_CASE(a_right_hand_side_out_of_range_is_not_solved) {
  const GridMatrix grid = grid_matrix(3, 1, 1);
  SparseLu lu(grid.matrix, grid.node_of_row);
  BOOST_REQUIRE(lu.factor(grid.matrix));
  Eigen::VectorXd b = right_hand_side(grid.matrix.rows()), x;
  b[2] = std::nan("");
  BOOST_TEST(!lu.solve(b, x));
}

BOOST_AUTO_TEST_SUITE_END()
