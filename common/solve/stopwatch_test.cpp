#include "common/solve/stopwatch.hpp"

#include <cmath>

#include <boost/test/unit_test.hpp>
#include <unistd.h>

BOOST_AUTO_TEST_CASE(the_stopwatch_counts_work_and_not_waiting) {
  const talus::solve::Stopwatch watch;
  usleep(50000);
  BOOST_TEST(watch.seconds() < 0.025);
  BOOST_TEST(watch.elapsed() > 0.049);
  volatile double sum = 0;
  for (int i = 0; i < 1000000; ++i) sum = sum + std::sqrt(i);
  BOOST_TEST(watch.seconds() > 1e-4);
}
