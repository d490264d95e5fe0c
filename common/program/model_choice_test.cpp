#include "common/program/model_choice.hpp"

#include <limits>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(model_choice_test)

using namespace talus::program;

BOOST_AUTO_TEST_CASE(digits_are_those_in_which_two_answers_agree) {
  BOOST_TEST(digits(0) == 16);
  BOOST_TEST(digits(3e-11) == 10);
  BOOST_TEST(digits(0.5) == 0);
  BOOST_TEST(digits(7) == 0);
  BOOST_TEST(digits(std::numeric_limits<double>::quiet_NaN()) == 0);
}

BOOST_AUTO_TEST_CASE(a_poorer_model_that_agrees_is_recommended_with_what_the_richer_ones_cost) {
  const std::string sentence =
      recommendation("chute", "1D", {{"2D", 3e-13, 61.2, 40}, {"3D", 2e-12, 1234, 500}});
  BOOST_TEST(sentence ==
             "For the chute use 1D, because 2D gives the same flow to 12 digits for 61 times the "
             "CPU time and 40 times the memory, and 3D gives the same flow to 11 digits for "
             "1200 times the CPU time and 500 times the memory.");
}

BOOST_AUTO_TEST_CASE(a_poorer_model_that_does_not_agree_is_not_recommended) {
  const std::vector<RicherModel> richer = {{"2D", 1e-12, 60, 40}, {"3D", 2e-3, 1000, 500}};
  BOOST_TEST(recommendation("fall", "1D", richer).starts_with("For the fall use 3D, because 1D"));
  BOOST_TEST(recommendation("fall", "1D", richer, 2).starts_with("For the fall use 1D"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(recommendation("fall", "1D", {{"2D", nan}}).starts_with("For the fall use 2D"));
}

BOOST_AUTO_TEST_CASE(a_hint_is_one_line_that_says_what_to_ask_for) {
  const std::string hint =
      hint_of_poorer_model("heap", "3D", "its cross-section", "--model section");
  BOOST_TEST(hint.starts_with("hint: for the heap its cross-section"));
  BOOST_TEST(hint.find("--model section") != std::string::npos);
  BOOST_TEST(hint.find('\n') == std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
