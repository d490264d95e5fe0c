#include "common/io/svg.hpp"

#include <boost/test/unit_test.hpp>

#include "common/io/svg_geometry.hpp"

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
  BOOST_TEST(holds(without_padding(plain, ""), "<path d='M0 0l1 1'/>\n</svg>\n"));
}

BOOST_AUTO_TEST_CASE(paths_are_relative_and_no_error_adds_up) {
  const auto short_of = [](const std::string& data) {
    return talus::io::with_short_geometry("<path d='" + data + "'/>");
  };
  BOOST_TEST(short_of("M84.63,223.60 L370.62,223.60 ") == "<path d='M84.6 223.6h286'/>");
  BOOST_TEST(short_of("M1,1 L1,0.5 L0.94,0.46\n1.06,0.54 Z ") == "<path d='M1 1v-.5h-.1h.2z'/>");
  BOOST_TEST(short_of("M0,0 L10,-5 M20,20 L20,30 ") == "<path d='M0 0l10-5m10 25v10'/>");
  std::string far = "M0,0";
  for (int i = 1; i <= 1000; ++i) far += " L" + std::to_string(0.04 * i) + ",0";
  std::string steps = short_of(far);
  double x = 0;
  for (std::size_t at = steps.find('h', steps.find("'M")); at != std::string::npos;
       at = steps.find('h', at + 1))
    x += std::stod(steps.substr(at + 1));
  BOOST_TEST(std::abs(x - 40) < 0.05);
  for (const char* other : {"M0,0 C1,1 2,2 3,3", "M0,0 l1,1", "0,0 L1,1", "M0,0 L1", "M0,0 Z M1,1"})
    BOOST_TEST(short_of(other) == std::string("<path d='") + other + "'/>");
}

BOOST_AUTO_TEST_CASE(polygons_are_closed_paths_and_definitions_stay) {
  BOOST_TEST(
      talus::io::with_short_geometry("<defs>\n<path id='gpPt7' d='M0,-1.33 L2,0 z'/>\n</defs>\n"
                                     "<polygon fill='#abcdef' points='0,0 1,0 1,2 '/>\n") ==
      "<defs>\n<path id='gpPt7' d='M0,-1.33 L2,0 z'/>\n</defs>\n"
      "<path fill='#abcdef' d='M0 0h1v2z'/>\n");
}

BOOST_AUTO_TEST_CASE(marks_of_one_kind_are_placed_in_one_group) {
  const auto mark = [](const std::string& place, const std::string& rest) {
    return "<use xlink:href='#gpPt6' transform='translate(" + place + ") scale(" + rest + "'/>\n";
  };
  BOOST_TEST(talus::io::with_short_geometry(mark("5.00,10.00", "5.00)' color='#0072b2") +
                                            mark("-1.25,6.00", "5.00)' color='#0072b2") +
                                            mark("8.00,9.00", "4.00)' color='#0072b2") +
                                            "</g>\n") ==
             "<g transform='scale(5)' color='#0072b2'>\n<use xlink:href='#gpPt6' x='1' y='2'/>\n"
             "<use xlink:href='#gpPt6' x='-.25' y='1.2'/>\n</g>\n"
             "<g transform='scale(4)' color='#0072b2'>\n<use xlink:href='#gpPt6' x='2' y='2.25'/>\n"
             "</g>\n</g>\n");
}

BOOST_AUTO_TEST_CASE(a_text_is_placed_and_a_turned_one_is_left_in_its_group) {
  const auto text = [](const std::string& transform) {
    return "<g transform=\"" + transform + "\" fill=\"black\">\n<text>0.1</text>\n</g>\n";
  };
  BOOST_TEST(talus::io::with_short_geometry(text("translate(74.84,228.15)")) ==
             "<text x='74.8' y='228.2' fill=\"black\">0.1</text>\n");
  const std::string turned = text("translate(22.38,132.81) rotate(270)");
  BOOST_TEST(talus::io::with_short_geometry(turned) == turned);
}

BOOST_AUTO_TEST_SUITE_END()
