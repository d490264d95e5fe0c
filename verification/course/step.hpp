// What the tests of a step of the course include.
#pragma once

#include <cmath>
#include <cstdio>
#include <limits>

#define BOOST_TEST_DYN_LINK
#define BOOST_TEST_MODULE course
#include <boost/test/unit_test.hpp>

namespace course {

using boost::test_tools::tolerance;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Prints a value and gives it back: by the values that it gives a usual mistake is recognised.
inline double seen(double value) {
  std::printf("seen %.17g\n", value);
  std::fflush(stdout);
  return value;
}

}  // namespace course
