// Can every end be told by its name, and every failure be answered?
#include "common/solve/end.hpp"

#include <set>
#include <string>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(end_test)

using namespace talus::solve;

BOOST_AUTO_TEST_CASE(ends_have_names_and_failures_have_advice) {
  std::set<std::string> names;
  for (const End end : all_ends) {
    names.insert(name_of(end));
    BOOST_TEST(advice_for(end).empty() == is_success(end), name_of(end));
  }
  BOOST_TEST(names.size() == std::size(all_ends));
}

BOOST_AUTO_TEST_SUITE_END()
