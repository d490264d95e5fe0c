// The two searches for a step along a Newton direction, on slopes and norms given by hand.
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/solve/newton.hpp"

BOOST_AUTO_TEST_SUITE(line_search_test)

using namespace talus::solve;

BOOST_AUTO_TEST_CASE(the_search_lowers_smooth_energies) {
  for (const double minimum : {0.9, 0.3, 1e-3, 1e-8}) {
    int calls = 0;
    const auto slope = [&](double t) {
      ++calls;
      return std::pow(t / minimum, 3) - 1;  // of a convex energy with this minimum
    };
    const LineSearchResult found = search_energy_slope(-1, slope);
    BOOST_TEST(found.evaluations == calls);
    BOOST_TEST(found.step > 0);
    BOOST_TEST(slope(found.step) <= 0.1);
    BOOST_TEST(slope(found.step) >= -0.5);
  }
}

BOOST_AUTO_TEST_CASE(the_search_takes_the_full_step_where_it_may) {
  const LineSearchResult still_falling = search_energy_slope(-1, [](double) { return -0.9; });
  BOOST_TEST(still_falling.step == 1);
  BOOST_TEST(still_falling.evaluations == 1);
  BOOST_TEST(search_energy_slope(-1, [](double) { return 0.09; }).step == 1);
  BOOST_TEST(search_energy_slope(-1, [](double t) { return 1.11 * t - 1; }).step < 1);
}

BOOST_AUTO_TEST_CASE(the_search_gives_up_without_a_descent_or_a_minimum) {
  const auto rising = [](double) { return 1.; };
  BOOST_TEST(search_energy_slope(1, rising).step == 0);
  BOOST_TEST(search_energy_slope(0, rising).step == 0);
  BOOST_TEST(search_energy_slope(std::nan(""), rising).step == 0);
  BOOST_TEST(search_energy_slope(-1, rising).step == 0);  // no energy has this slope
}

BOOST_AUTO_TEST_CASE(the_search_on_the_norm_halves_and_asks_for_a_decrease) {
  const LineSearchResult found =
      search_residual_norm(1, [](double t) { return t > 0.3 ? 2. : 0.5; });
  BOOST_TEST(found.step == 0.25);
  BOOST_TEST(found.evaluations == 3);
  BOOST_TEST(search_residual_norm(1, [](double) { return 0.9; }).step == 1);
  BOOST_TEST(search_residual_norm(1, [](double) { return 1.; }).step == 0);
  BOOST_TEST(search_residual_norm(1, [](double) { return std::nan(""); }).step == 0);
  BOOST_TEST(search_residual_norm(
                 1, [](double t) { return t > 1e-3 ? 2. : 0.; }, 0.1)
                 .step == 0);
}

// False position by Illinois' rule (Dowell & Jarratt 1971): of an end that stays the slope is
// halved.
BOOST_AUTO_TEST_CASE(an_end_that_stays_counts_for_half) {
  std::vector<double> places;
  const auto slope = [&](double t) {
    places.push_back(t);
    return t < 1e-3 ? -1. : 1 + t;  // the kink is what is sought
  };
  search_energy_slope(-1, slope);
  BOOST_TEST_REQUIRE(places.size() >= 4);
  const auto crossing = [](double low, double at_low, double high, double at_high) {
    return low - at_low * (high - low) / (at_high - at_low);
  };
  BOOST_TEST(places[0] == 1);
  BOOST_TEST(places[1] == crossing(0, -1, 1, 2));
  BOOST_TEST(places[2] == crossing(0, -0.5, places[1], 1 + places[1]));
  BOOST_TEST(places[3] == crossing(0, -0.25, places[2], 1 + places[2]));
}

BOOST_AUTO_TEST_SUITE_END()
