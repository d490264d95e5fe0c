#include "common/solve/memory.hpp"

#include <fstream>
#include <functional>
#include <limits>

#include <boost/test/unit_test.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

BOOST_AUTO_TEST_SUITE(memory_test)

using namespace talus::solve;

namespace {

double total_memory() {
  std::ifstream in("/proc/meminfo");  // MemTotal comes first
  std::string word;
  double kibibytes = 0;
  in >> word >> kibibytes;
  return 1024 * kibibytes;
}

double address_space() {
  std::ifstream in("/proc/self/statm");
  double pages = 0;
  in >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Whether it holds in a process that may take so many bytes more than it has.
bool holds_with_left(double bytes, const std::function<bool()>& statement) {
  const pid_t child = fork();
  if (child == 0) {
    const auto size = static_cast<rlim_t>(address_space() + bytes);
    const rlimit limit{size, size};
    if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(2);
    _exit(statement() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

BOOST_AUTO_TEST_CASE(there_is_memory_but_no_more_than_the_machine_has) {
  BOOST_TEST(available_memory() > 1e6);
  BOOST_TEST(available_memory() <= total_memory());
}

BOOST_AUTO_TEST_CASE(a_limit_on_the_address_space_is_what_is_left_of_it) {
  const auto is_near = [](double left) {
    return [left] { return available_memory() <= left && available_memory() > 0.9 * left; };
  };
  BOOST_TEST(holds_with_left(2e8, is_near(2e8)));
  BOOST_TEST(!holds_with_left(1e8, is_near(2e8)));
}

BOOST_AUTO_TEST_CASE(what_does_not_fit_is_refused_with_what_it_needs_and_what_there_is) {
  const auto refuses = [](double bytes) {
    return [bytes] {
      try {
        require_memory("factors of 7 unknowns", bytes);
      } catch (const OutOfMemory& error) {
        const std::string what = error.what();
        return what.find("factors of 7 unknowns need about 0.50 GB") == 0 &&
               what.find("available") != std::string::npos;
      }
      return false;
    };
  };
  BOOST_TEST(holds_with_left(3e8, refuses(5e8)));
  BOOST_TEST(!holds_with_left(3e8, refuses(2e8)));  // it fits
  BOOST_CHECK_THROW(require_memory("this", std::numeric_limits<double>::infinity()),
                    std::bad_alloc);
}

BOOST_AUTO_TEST_CASE(gigabytes_have_two_digits) {
  BOOST_TEST(in_gigabytes(41.26e9) == "41 GB");
  BOOST_TEST(in_gigabytes(1.26e9) == "1.3 GB");
  BOOST_TEST(in_gigabytes(0.126e9) == "0.13 GB");
  BOOST_TEST(in_gigabytes(0) == "0.0000 GB");
}

BOOST_AUTO_TEST_SUITE_END()
