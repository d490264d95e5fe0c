#include <vector>

#include "common/solve/newton.hpp"
#include "verification/course/step.hpp"

BOOST_AUTO_TEST_SUITE(step_11)
using namespace course;
using namespace talus::solve;

BOOST_AUTO_TEST_CASE(a_step_that_is_too_long_is_shortened_to_the_minimum) {
  for (const double minimum : {0.3, 1e-3, 1e-8}) {
    const auto slope = [&](double t) { return std::pow(t / minimum, 3) - 1; };
    const LineSearchResult found = search_energy_slope(-1, slope);
    seen(found.evaluations);
    BOOST_TEST(slope(seen(found.step)) <= 0.1);
    BOOST_TEST(slope(found.step) >= -0.5);
    BOOST_TEST(found.step > 0);
  }
}

// False position by Illinois' rule: the slope at an end that stays is halved.
BOOST_AUTO_TEST_CASE(it_goes_by_false_position) {
  std::vector<double> places;
  search_energy_slope(-1, [&](double t) {
    places.push_back(seen(t));
    return t < 1e-3 ? -1. : 1 + t;
  });
  BOOST_TEST_REQUIRE(places.size() >= 3);
  BOOST_TEST(places[1] == 1. / 3, tolerance(1e-12));
  BOOST_TEST(places[2] == 0.5 / (0.5 + 4. / 3) / 3, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_step_out_of_the_numbers_is_halved) {
  const LineSearchResult found =
      search_energy_slope(-1, [](double t) { return t > 0.3 ? infinity : 4 * t - 1; });
  BOOST_TEST(seen(found.step) == 0.25, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
