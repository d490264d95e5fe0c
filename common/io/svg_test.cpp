#include "common/io/svg.hpp"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(svg_test)

using talus::io::without_padding;

// As gnuplot writes them: gpPt6 is made of gpPt5.
const std::string svg =
    "<svg\n>\n<title>t</title>\n<g id=\"gnuplot_canvas\">\n<defs>\n"
    "<circle id='gpPt5' r='1'/>\n<use xlink:href='#gpPt5' id='gpPt6' fill='currentColor'/>\n"
    "<path id='gpPt7' d='M0,0'/>\n</defs>\n<g stroke=\"none\">\n</g>\n"
    "<use xlink:href='#gpPt6' color='rgb(  0, 114, 178)'/>\n</g>\n</svg>\n";

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

BOOST_AUTO_TEST_CASE(marks_that_are_drawn_stay_with_what_they_are_made_of) {
  const std::string small = without_padding(svg, "font-size=\"14\"");
  BOOST_TEST(holds(small, "id='gpPt6'"));
  BOOST_TEST(holds(small, "id='gpPt5'"));
  BOOST_TEST(!holds(small, "gpPt7"));
  BOOST_TEST(holds(small, "<use xlink:href='#gpPt6'"));
}

BOOST_AUTO_TEST_CASE(the_font_is_told_and_what_says_nothing_is_gone) {
  const std::string small = without_padding(svg, "font-size=\"14\"");
  BOOST_TEST(small.starts_with("<svg font-size=\"14\""));
  BOOST_TEST(!holds(small, "<title>"));
  BOOST_TEST(!holds(small, "<g stroke=\"none\">"));
  BOOST_TEST(holds(small, "#0072b2"));
}

BOOST_AUTO_TEST_CASE(a_picture_without_marks_keeps_all_that_is_drawn) {
  const std::string plain = "<svg\n>\n<path d='M0,0 L1,1'/>\n</svg>\n";
  BOOST_TEST(holds(without_padding(plain, ""), "<path d='M0,0 L1,1'/>\n</svg>\n"));
}

BOOST_AUTO_TEST_SUITE_END()
