#include "common/solve/stopwatch.hpp"

#include <algorithm>
#include <cmath>

#include <boost/test/unit_test.hpp>
#include <unistd.h>

BOOST_AUTO_TEST_SUITE(stopwatch_test)

// On a busy machine a wait may cost CPU time too, and more of it: the least of several counts.
BOOST_AUTO_TEST_CASE(the_stopwatch_counts_work_and_not_waiting) {
  double least_share = 1;
  for (int i = 0; i < 20 && least_share > 0.1; ++i) {
    const talus::solve::Stopwatch watch;
    usleep(50000);
    BOOST_TEST(watch.elapsed() > 0.049);
    least_share = std::min(least_share, watch.seconds() / watch.elapsed());
  }
  BOOST_TEST(least_share < 0.5);
  const talus::solve::Stopwatch watch;
  volatile double sum = 0;
  for (int i = 0; i < 1000000; ++i) sum = sum + std::sqrt(i);
  BOOST_TEST(watch.seconds() > 1e-4);
}

BOOST_AUTO_TEST_SUITE_END()
