#include "common/solve/extremes.hpp"

#include <cmath>
#include <limits>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(extremes_test)

using namespace talus::solve;

BOOST_AUTO_TEST_CASE(extremes_of_numbers_are_the_usual_ones) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  BOOST_TEST(nan_max(1, 2) == 2);
  BOOST_TEST(nan_max(2, 1) == 2);
  BOOST_TEST(nan_min(1, 2) == 1);
  BOOST_TEST(nan_min(2, -infinity) == -infinity);
  BOOST_TEST(nan_max({-3, -1, -2}) == -1);
  BOOST_TEST(nan_max({-3, infinity, -2}) == infinity);
}

BOOST_AUTO_TEST_CASE(a_nan_is_kept_on_either_side_and_by_what_comes_after) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(std::isnan(nan_max(nan, 1)));
  BOOST_TEST(std::isnan(nan_max(1, nan)));
  BOOST_TEST(std::isnan(nan_min(nan, 1)));
  BOOST_TEST(std::isnan(nan_min(1, nan)));
  for (const auto& numbers : {std::initializer_list<double>{nan, 1, 2}, {1, nan, 2}, {1, 2, nan}})
    BOOST_TEST(std::isnan(nan_max(numbers)));
}

BOOST_AUTO_TEST_SUITE_END()
