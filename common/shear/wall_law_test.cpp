// The wall that may be slipped along: Coulomb friction with μ2, whatever the law inside.
#include "common/shear/wall_law.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(wall_law_test)

using namespace talus;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(every_law_has_a_wall_that_holds_up_to_its_friction) {
  constexpr double pressure = 3, lambda_r = 1e-6;
  for (const auto& regularisation : rheology::regularisations()) {
    const rheology::Rheology inside({}, regularisation, lambda_r);
    const rheology::Rheology wall = shear::wall_rheology(inside);
    const double friction = inside.law.mu_2() * pressure;
    BOOST_TEST_CONTEXT(rheology::name_of(regularisation)) {
      BOOST_TEST(wall.evaluate(1, pressure).eta == friction, tolerance(1e-4));
      BOOST_TEST(100 * wall.evaluate(100, pressure).eta == friction, tolerance(1e-4));
      // Where it does not slip but for creep it holds all the same.
      BOOST_TEST(1e-3 * wall.evaluate(1e-3, pressure).eta == friction, tolerance(1e-2));
      if (rheology::has_yield_stress(regularisation))
        BOOST_TEST(rheology::name_of(wall.regularisation) == rheology::name_of(regularisation));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
