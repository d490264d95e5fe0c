// The main() of every program of tests (Boost.Test).
#define BOOST_TEST_MODULE talus
#include <boost/test/unit_test.hpp>
