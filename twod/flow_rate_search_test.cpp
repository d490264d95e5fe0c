// The angle at which the heap carries a flow rate: found wherever there is one, else a named end.
#include "twod/flow_rate_search.hpp"

#include <cmath>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(flow_rate_search_test)

using namespace talus;
using namespace talus::twod;

BOOST_AUTO_TEST_CASE(the_angle_found_for_a_flow_rate_carries_it) {
  // In a bracket on the coarse mesh, by secants from a coarser one on the other.
  for (const auto& [mesh, options] : {std::pair{SectionMesh{14, 20}, newton_options(1e-5)},
                                      {{14, 20}, default_options()},
                                      {{32, 32}, newton_options(1e-5)},
                                      {{32, 32}, default_options()}}) {
    Section section;
    auto space = space_of(section, mesh);
    const auto solution = solve_for_flow_rate(39.71, section, mesh, space, options);
    BOOST_TEST(flow_rate(solution, space) == 39.71, boost::test_tools::tolerance(1e-8));
    section.angle = solution.section.angle;
    const auto again = twod::solve(section, space, options);
    BOOST_TEST(flow_rate(again, space) == 39.71, boost::test_tools::tolerance(1e-8));
  }
}

BOOST_AUTO_TEST_CASE(every_flow_rate_between_creep_and_the_fastest_has_its_angle) {
  const SectionMesh mesh{4, 6};
  for (const auto& options : {default_options(), newton_options(1e-5)})
    for (const double delta_mu : {0.26, 0.015}) {
      Section section;
      section.law.delta_mu = delta_mu;
      auto space = space_of(section, mesh);
      const auto rate_at = [&](double share) {  // of the way from arctan μs to arctan μ2
        const double yield = std::atan(section.law.mu_s);
        section.angle = yield + share * (std::atan(section.law.mu_2()) - yield);
        return flow_rate(twod::solve(section, space, options), space);
      };
      const double fastest = rate_at(0.9999);
      for (const double rate : {1e-3, 1.0, 0.3 * fastest, 0.999 * fastest}) {
        const auto solution = solve_for_flow_rate(rate, section, mesh, space, options);
        BOOST_TEST(flow_rate(solution, space) == rate, boost::test_tools::tolerance(1e-8));
      }
      if (options.method == shear::Method::newton) {  // slower than what creeps at rest
        const double creep = 0.5 * rate_at(0);
        const auto solution = solve_for_flow_rate(creep, section, mesh, space, options);
        BOOST_TEST(flow_rate(solution, space) == creep, boost::test_tools::tolerance(1e-8));
        BOOST_TEST(solution.section.angle < std::atan(section.law.mu_s));
      }
    }
}

BOOST_AUTO_TEST_CASE(a_flow_rate_out_of_reach_is_an_error_with_a_named_end) {
  Section section;
  auto space = space_of(section, {4, 6});
  const auto is_too_much = [](const FlowRateError& error) {
    return error.end == solve::End::no_steady_state;
  };
  BOOST_CHECK_EXCEPTION(solve_for_flow_rate(1e9, section, {4, 6}, space, default_options()),
                        FlowRateError, is_too_much);
  auto hasty = default_options();
  hasty.interior_point.max_factorisations = 2;
  const auto is_stagnation = [](const FlowRateError& error) {
    return error.end == solve::End::stagnated;
  };
  BOOST_CHECK_EXCEPTION(solve_for_flow_rate(10, section, {4, 6}, space, hasty), FlowRateError,
                        is_stagnation);
}

BOOST_AUTO_TEST_SUITE_END()
