// Curves that a user gives: read whole or refused with the line, and drawn where they belong.
#include "verification/harness/given_curves.hpp"

#include <cmath>
#include <fstream>

#include <boost/test/unit_test.hpp>

#include "common/testing/temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(given_curves_test)

using namespace talus;
using namespace talus::verification;

namespace {

const std::vector<OpenFigure> open_figures = {{"10", 2}, {"12", 4}};

// What is read from such a file, or why it is not.
std::vector<GivenCurve> curves_from(const std::string& text) {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.path() / "given.csv") << text;
  return read_given_curves(folder.path() / "given.csv", open_figures);
}
std::string refusal_of(const std::string& text) {
  try {
    curves_from(text);
  } catch (const io::UserError& error) {
    return error.what();
  }
  return "";
}

const std::string first_line = "figure,panel,curve,x,y\n";

}  // namespace

BOOST_AUTO_TEST_CASE(points_of_one_name_are_one_curve_in_their_order) {
  const auto curves = curves_from("\xEF\xBB\xBF# digitised by hand\r\n\r\n" +
                                  std::string("figure,panel,curve,x,y\r\n") +
                                  "12,c,experiments,0.1,300\r\n10,a,Q* = 39.71,0,3.2\r\n"
                                  "12,c,experiments,2e-1,7.5e1\r\n");
  BOOST_REQUIRE(curves.size() == 2U);
  BOOST_TEST(curves[0].figure == "12");
  BOOST_TEST(curves[0].panel == "c");
  BOOST_TEST(curves[0].curve.label == "experiments");
  BOOST_TEST(curves[0].curve.x == std::vector({0.1, 0.2}), boost::test_tools::per_element());
  BOOST_TEST(curves[0].curve.y == std::vector({300., 75.}), boost::test_tools::per_element());
  BOOST_TEST(curves[1].curve.label == "Q* = 39.71");
}

BOOST_AUTO_TEST_CASE(a_wrong_file_is_refused_with_its_line) {
  const std::string good = "12,a,x,1,2\n";
  const auto refused = [](const std::string& text, const std::string& line,
                          const std::string& why) {
    const std::string said = refusal_of(text);
    BOOST_TEST(said.find("--data: '") == 0U, said);
    BOOST_TEST(said.find(line) != std::string::npos, said);
    BOOST_TEST(said.find(why) != std::string::npos, said);
    BOOST_TEST(said.find('\n') == std::string::npos, said);
  };
  BOOST_TEST(refusal_of(first_line + good).empty());
  refused("", "", "holds no point");
  refused(first_line, "", "holds no point");
  refused("x,y\n", "line 1:", "the first line must be figure,panel,curve,x,y");
  refused(first_line + good + "12,a,x,1\n", "line 3:", "4 fields, not the 5");
  refused(first_line + good + "12,a,x,1,2,3\n", "line 3:", "6 fields, not the 5");
  refused(first_line + "\n13,a,x,1,2\n", "line 3:", "'13' is none of: 10, 12");
  refused(first_line + "12,e,x,1,2\n", "line 2:", "'e' of figure 12 is not in a ... d");
  refused(first_line + "10,,x,1,2\n", "line 2:", "'' of figure 10 is not in a ... b");
  refused(first_line + "12,a,,1,2\n", "line 2:", "curve");
  refused(first_line + "12,a,x,one,2\n", "line 2:", "x: 'one' is not a finite number");
  refused(first_line + "12,a,x,1,nan\n", "line 2:", "y: 'nan' is not a finite number");
  refused(first_line + "12,a,x,1,\n", "line 2:", "y: '' is not a finite number");
  BOOST_CHECK_THROW(read_given_curves("nowhere.csv", open_figures), io::UserError);
  BOOST_CHECK_THROW(read_given_curves("/", open_figures), io::UserError);
}

BOOST_AUTO_TEST_CASE(what_is_given_is_drawn_in_its_panel_and_what_is_not_has_its_place_in_the_key) {
  const io::Panel linear{"", "x", "y", false, false, {}};
  io::Panel logarithmic = linear;
  logarithmic.log_y = true;
  const io::Figure figure{"figure", "What is seen.", {linear, logarithmic}, 2};
  const std::vector<Awaited> awaited = {{"b", "experiments (not distributed)"}};
  const auto without = with_given_curves(figure, "10", {}, awaited);
  BOOST_TEST(without.panels[0].curves.empty());
  BOOST_REQUIRE(without.panels[1].curves.size() == 1U);
  BOOST_TEST(without.panels[1].curves[0].label == "experiments (not distributed)");
  BOOST_TEST(std::isnan(without.panels[1].curves[0].y[0]));
  BOOST_TEST(without.caption == figure.caption);

  const auto given = curves_from(first_line + "10,b,mine,1,2\n10,b,mine,2,-1\n12,b,other,1,1\n");
  const auto with = with_given_curves(figure, "10", given, awaited);
  BOOST_TEST(with.panels[0].curves.empty());
  BOOST_REQUIRE(with.panels[1].curves.size() == 1U);
  BOOST_TEST(with.panels[1].curves[0].label == "mine");
  BOOST_TEST(
      with.caption ==
      "What is seen. Points given with --data: 2. Without a place on a logarithmic axis: 1.");
}

BOOST_AUTO_TEST_SUITE_END()
