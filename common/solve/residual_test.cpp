// How the size of a residual is judged.
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/solve/newton.hpp"

BOOST_AUTO_TEST_SUITE(residual_test)

using namespace talus::solve;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(blocks_of_a_residual_are_judged_by_their_own_magnitude) {
  Residual residual{Eigen::Vector4d(1e-3, 0, 1e-9, 0), Eigen::Vector4d(1e6, 1, 1e-6, 1e-7),
                    Eigen::Vector4d(1e-10, 0, 1e-15, 0)};
  BOOST_TEST(residual.relative_norm() == 1e-9, tolerance(1e-12));  // the small block drowns
  residual.block_ends = {2, 4};
  BOOST_TEST(residual.relative_norm() == 1e-3, tolerance(1e-12));
  BOOST_TEST(residual.relative_round_off() == 1e-9, tolerance(1e-12));
  residual.block_ends = {2};  // what lies beyond the last end is a block as well
  BOOST_TEST(residual.relative_norm() == 1e-3, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_nan_comes_through_in_whatever_block) {
  for (const Eigen::Index place : {0, 1, 2, 3})
    for (const std::vector<Eigen::Index>& ends :
         {std::vector<Eigen::Index>{}, std::vector<Eigen::Index>{2, 4}}) {
      Residual residual{Eigen::Vector4d::Constant(1e-20), Eigen::Vector4d::Ones(),
                        Eigen::Vector4d::Zero(), ends};
      residual.value[place] = std::nan("");
      BOOST_TEST(!(residual.relative_norm() <= 1), "at " << place);
      BOOST_TEST(!residual.is_finite());
      BOOST_TEST(!residual.is_round_off());
    }
}

BOOST_AUTO_TEST_SUITE_END()
