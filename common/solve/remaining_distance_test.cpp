// How far the end is, told by steps: exactly where they shrink by a factor, which sums a geometric
// series.
#include "common/solve/remaining_distance.hpp"

#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/solve/newton.hpp"
#include "common/solve/test_problems.hpp"

BOOST_AUTO_TEST_SUITE(remaining_distance_test)

using namespace talus::solve;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(of_steps_that_shrink_by_a_factor_it_is_the_rest_of_the_series) {
  for (const double factor : {0.9, 0.5, 1e-3}) {
    RemainingDistance remaining;
    BOOST_TEST(std::isinf(remaining.bound()));
    BOOST_TEST(remaining.bound_before(1) == 2);  // of a first step
    double size = 1;
    for (int step = 0; step < 5; ++step, size *= factor) {
      const double rest = size / (1 - factor);  // this step and all after it
      if (step > 0) BOOST_TEST(remaining.bound_before(size) == rest, tolerance(1e-12));
      remaining.stepped(size, 1);
      if (step > 0) BOOST_TEST(remaining.bound() == factor * rest, tolerance(1e-12));
    }
    BOOST_TEST(!remaining.has_stopped_contracting(size));
    BOOST_TEST(remaining.has_stopped_contracting(2 * size / factor));
  }
}

BOOST_AUTO_TEST_CASE(short_steps_and_growing_ones_tell_nothing) {
  RemainingDistance remaining;
  remaining.stepped(1, 1);
  remaining.stepped(0.5, 0.25);
  BOOST_TEST(std::isinf(remaining.bound()));
  remaining.stepped(0.6, 1);
  BOOST_TEST(std::isinf(remaining.bound()));
  BOOST_TEST(std::isinf(remaining.bound_before(0.7)));
}

namespace {

// No step helps, and the problem may know why.
struct Overloaded : ConvexProblem {
  bool is_overloaded = true;
  bool exceeds_capacity(const State&) const { return is_overloaded; }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_failure_that_the_problem_can_explain_is_no_steady_state) {
  const auto end_of = [](bool is_overloaded, double load) {
    Overloaded problem{{.slope = [](double w) { return std::atan(w); },
                        .curvature = [](double w) { return 1 / (1 + w * w); },
                        .load = Eigen::VectorXd::Constant(1, load)},
                       is_overloaded};
    CompensatedVector state(Eigen::VectorXd::Zero(1));
    return newton(problem, state, {.max_iterations = 50}).end;
  };
  BOOST_CHECK(end_of(true, 2) == End::no_steady_state);  // atan stays below π/2
  BOOST_CHECK(!is_success(end_of(false, 2)));
  BOOST_CHECK(end_of(false, 2) != End::no_steady_state);
  BOOST_CHECK(is_success(end_of(true, 1)));  // a solution is one, whatever is said of the load
}

BOOST_AUTO_TEST_SUITE_END()
