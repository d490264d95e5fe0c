#include "common/solve/parallel.hpp"

#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(parallel_test)

using namespace talus::solve;

namespace {

struct Threads {  // as many in one test, one again after it
  explicit Threads(int count) { set_threads(count); }
  ~Threads() { set_threads(1); }
};

std::size_t threads_seen(std::size_t count, std::size_t least) {
  std::mutex mutex;
  std::set<std::thread::id> seen;
  parallel_for(0, count, least, [&](std::size_t) {
    const std::lock_guard lock(mutex);
    seen.insert(std::this_thread::get_id());
  });
  return seen.size();
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_index_is_met_once) {
  for (const int count : {1, 2, 3, 7}) {
    const Threads threads(count);
    for (const std::size_t last : {5, 6, 7, 12, 100}) {
      std::vector<int> times(100, 0);
      parallel_for(5, last, 1, [&](std::size_t i) { ++times[i]; });
      for (std::size_t i = 0; i < times.size(); ++i)
        BOOST_TEST(times[i] == (i >= 5 && i < last ? 1 : 0), count << ", " << last << ", " << i);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_more_threads_than_allowed_and_none_for_little_work) {
  BOOST_TEST(threads_seen(100, 1) == 1U);
  const Threads threads(3);
  BOOST_TEST(threads_seen(100, 1) == 3U);
  BOOST_TEST(threads_seen(100, 50) == 2U);
  BOOST_TEST(threads_seen(100, 51) == 1U);
}

BOOST_AUTO_TEST_CASE(what_a_thread_throws_arrives) {
  const Threads threads(4);
  for (const std::size_t bad : {0, 30, 99})
    BOOST_CHECK_THROW(parallel_for(0, 100, 1,
                                   [&](std::size_t i) {
                                     if (i == bad) throw std::runtime_error("bad");
                                   }),
                      std::runtime_error);
}

BOOST_AUTO_TEST_CASE(there_is_always_one_thread) {
  const Threads threads(0);
  BOOST_TEST(talus::solve::threads() == 1);
}

BOOST_AUTO_TEST_SUITE_END()
