#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/fem/lagrange.hpp"
#include "common/fem/line_mesh.hpp"
#include "common/fem/quadrature.hpp"
#include "common/testing/difference.hpp"

BOOST_AUTO_TEST_SUITE(fem_test)

using namespace talus;
using namespace talus::fem;
using boost::test_tools::tolerance;

namespace {

// Error of the n-point rule on x^degree over [-1, 1].
double quadrature_error(int n, int degree) {
  double sum = 0;
  for (const auto& [x, weight] : gauss_legendre(n)) sum += weight * std::pow(x, degree);
  return std::abs(sum - (degree % 2 == 0 ? 2. / (degree + 1) : 0));
}

template <int Dim>
using Point = Eigen::Matrix<double, Dim, 1>;

template <int Dim>
Point<Dim> reference_node(int node) {
  Point<Dim> x;
  for (int d = 0; d < Dim; ++d, node /= 3) x[d] = node % 3 - 1;
  return x;
}

template <int Dim>
void check_basis() {
  constexpr int nodes = QuadraticBasis<Dim>::nodes;
  for (int i = 0; i < nodes; ++i) {
    const QuadraticBasis<Dim> basis(reference_node<Dim>(i));
    for (int j = 0; j < nodes; ++j) BOOST_TEST(basis.values[j] == (i == j ? 1 : 0));
  }
  const Point<Dim> x = Point<Dim>::LinSpaced(-0.7, 0.4);
  const QuadraticBasis<Dim> basis(x);
  BOOST_TEST(basis.values.sum() == 1, tolerance(1e-15));
  BOOST_TEST(basis.gradients.rowwise().sum().norm() < 1e-14);
  for (int node = 0; node < nodes; ++node)
    for (int d = 0; d < Dim; ++d) {
      const auto along = [&](double coordinate) {
        Point<Dim> moved = x;
        moved[d] = coordinate;
        return QuadraticBasis<Dim>(moved).values[node];
      };
      BOOST_TEST(std::abs(basis.gradients(d, node) - testing::difference(along, x[d], 1)) < 1e-11);
    }
}

void check_boundaries(const std::vector<double>& boundaries, double end, int elements) {
  BOOST_REQUIRE(boundaries.size() == static_cast<std::size_t>(elements) + 1);
  BOOST_TEST(boundaries.front() == 0);
  BOOST_TEST(boundaries.back() == end);
  for (std::size_t i = 1; i < boundaries.size(); ++i) BOOST_TEST(boundaries[i] > boundaries[i - 1]);
}

}  // namespace

BOOST_AUTO_TEST_CASE(gauss_rules_are_exact_up_to_degree_2n_minus_1_and_not_beyond) {
  for (const int n : {1, 2, 3, 4, 10, 40}) {
    for (int degree = 0; degree < 2 * n; ++degree)
      BOOST_TEST(quadrature_error(n, degree) < 1e-14, n << " points, degree " << degree);
    if (n <= 10) BOOST_TEST(quadrature_error(n, 2 * n) > 1e-6);  // beyond that too small to see
  }
}

BOOST_AUTO_TEST_CASE(gauss_positions_ascend_inside_the_interval) {
  for (const int n : {1, 2, 3, 4, 10}) {
    double previous = -1;
    for (const auto& [x, weight] : gauss_legendre(n)) {
      BOOST_TEST(x > previous);
      BOOST_TEST(weight > 0);
      previous = x;
    }
    BOOST_TEST(previous < 1);
  }
}

BOOST_AUTO_TEST_CASE(quadratic_bases_are_nodal_sum_to_one_and_have_the_gradients_they_say) {
  check_basis<1>();
  check_basis<2>();
  check_basis<3>();
}

BOOST_AUTO_TEST_CASE(elements_have_3_to_the_dimension_nodes) {
  BOOST_TEST(quadratic_nodes(0) == 1);
  BOOST_TEST(quadratic_nodes(1) == 3);
  BOOST_TEST(quadratic_nodes(2) == 9);
  BOOST_TEST(quadratic_nodes(3) == 27);
}

BOOST_AUTO_TEST_CASE(graded_lines_follow_their_formula_and_end_where_they_should) {
  for (const int elements : {1, 2, 7, 320})
    for (const double exponent : {1., 2., 4.}) {
      const auto line = graded_line(0, 14, elements, exponent);
      check_boundaries(line, 14, elements);
      for (int i = 0; i <= elements; ++i) {
        const double rest = std::pow(1 - static_cast<double>(i) / elements, exponent);
        BOOST_TEST(std::abs(line[static_cast<std::size_t>(i)] - 14 * (1 - rest)) < 1e-13);
      }
    }
  BOOST_TEST(graded_line(-3, 5, 4, 1) == (std::vector<double>{-3, -1, 1, 3, 5}),
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(geometric_lines_start_with_the_given_width_and_keep_one_ratio) {
  for (const double first : {0.001, 0.02, 0.35, 1.}) {  // the last narrows
    const auto line = geometric_line(0, 7, 20, first);
    check_boundaries(line, 7, 20);
    BOOST_TEST(line[1] == first, tolerance(1e-12));
    const double ratio = (line[2] - line[1]) / first;
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      BOOST_TEST(line[i + 1] - line[i] == ratio * (line[i] - line[i - 1]), tolerance(1e-9));
  }
  BOOST_TEST(geometric_line(2, 9, 3, 1)[2] == 5, tolerance(1e-12));  // 1 + 2 + 4
}

BOOST_AUTO_TEST_CASE(aligned_lines_put_the_point_at_its_fraction_of_an_element) {
  constexpr double length = 14, point = 10.724;
  for (const int elements : {5, 17, 20, 40, 333})
    for (const double fraction : {0., 0.25, 0.5, 0.9})
      for (const double grading : {1., 2.}) {
        BOOST_REQUIRE(can_align(length, elements, point, fraction));
        const auto line = aligned_line(length, elements, point, fraction, grading);
        check_boundaries(line, length, elements);
        std::size_t e = 0;
        while (line[e + 1] <= point) ++e;
        const double found = (point - line[e]) / (line[e + 1] - line[e]);
        if (fraction == 0)
          BOOST_TEST(found == 0);
        else
          BOOST_TEST(found == fraction, tolerance(1e-10));
      }
}

BOOST_AUTO_TEST_CASE(the_largest_grading_leaves_the_narrowest_element_two_digits) {
  for (const int elements : {2, 10, 100, 2560}) {
    const double grading = largest_grading(elements);
    const auto width = [&](double exponent) {
      const auto boundaries = graded_line(0, 1, elements, exponent);
      return boundaries.back() - boundaries[boundaries.size() - 2];
    };
    BOOST_TEST(width(grading) == 1e-14, tolerance(0.02));
    BOOST_TEST(width(1.2 * grading) < 1e-16);  // nothing
  }
  BOOST_TEST(std::isinf(largest_grading(1)));
}

BOOST_AUTO_TEST_CASE(aligned_lines_are_uniform_up_to_the_element_of_the_point) {
  const auto line = aligned_line(14, 20, 10.724, 0.5, 3);
  std::size_t e = 0;
  while (line[e + 1] <= 10.724) ++e;
  for (std::size_t i = 0; i <= e; ++i)
    BOOST_TEST(line[i + 1] - line[i] == line[1], tolerance(1e-13));
  BOOST_TEST(line[e + 2] - line[e + 1] > line.back() - line[line.size() - 2]);
}

BOOST_AUTO_TEST_CASE(a_line_that_cannot_be_aligned_is_refused) {
  BOOST_TEST(!can_align(14, 1, 10, 0));  // nothing left beyond the point
  BOOST_TEST(!can_align(14, 40, 0, 0));  // no point inside
  BOOST_TEST(!can_align(14, 40, 14, 0));
  BOOST_TEST(!can_align(14, 40, 20, 0.5));
  BOOST_TEST(!can_align(14, 2, 13, 0.5));  // its element would end beyond the line
  BOOST_TEST(can_align(14, 2, 13, 0));
  BOOST_TEST(can_align(14, 40, 13, 0.5));
}

BOOST_AUTO_TEST_CASE(an_aligned_line_has_elements_as_near_the_uniform_size_as_whole_numbers_allow) {
  for (const double fraction : {0., 0.3, 0.5, 0.9})
    for (const int elements : {10, 20, 41}) {
      const double point = 10.724, length = 14, uniform = length / elements;
      const auto line = aligned_line(length, elements, point, fraction, 1);
      // One element more or less before the point would be further off.
      const double count = point / line[1];
      for (const double other : {count - 1, count + 1})
        BOOST_TEST(std::abs(elements * point / length - count) <=
                   std::abs(elements * point / length - other) + 1e-9);
      BOOST_TEST(line[1] == uniform, tolerance(0.6 / count));
    }
}

BOOST_AUTO_TEST_SUITE_END()
