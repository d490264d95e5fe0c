#include "common/io/field_panel.hpp"

#include <cmath>
#include <regex>

#include <boost/test/unit_test.hpp>

#include "common/io/figure.hpp"
#include "common/testing/temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(field_panel_test)

using namespace talus::io;
using talus::testing::contents_of;
using talus::testing::TemporaryFolder;

namespace {

// A row of unit squares with a value each.
FieldMap squares(const std::vector<double>& values, bool log_scale = false) {
  FieldMap map{.value_label = "|u| / sqrt(gd)", .log_scale = log_scale};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i);
    map.patches.push_back(
        {2, {{x, 0}, {x + 1, 0}, {x, 1}, {x + 1, 1}}, std::vector<double>(4, values[i])});
  }
  return map;
}

std::vector<std::string> blocks(const FieldMap& map) {
  std::vector<std::string> all;
  const std::string data = field_data(map, "title");
  for (std::size_t at = 0, end = 0; (end = data.find("\n\n\n", at)) != std::string::npos;
       at = end + 3)
    all.push_back(data.substr(at, end - at));
  return all;
}

// The block of that meaning has the left end of that square.
bool has_square(const std::string& block, int square) {
  return std::regex_search(block, std::regex("\n" + std::to_string(square) + " [01](\n|$)")) &&
         std::regex_search(block, std::regex("\n" + std::to_string(square + 1) + " [01](\n|$)"));
}

std::string block_of(const FieldMap& map, const std::string& meaning) {
  for (const std::string& block : blocks(map))
    if (block.find(": " + meaning + "\n") != std::string::npos) return block;
  return "none";
}

Figure figure_of(const FieldMap& map) {
  Panel panel{"Speed", "x / d", "z / d", false, false, {}};
  panel.field = map;
  return {"fields", "a caption", {panel, panel}, 2, "it's a title"};
}

}  // namespace

BOOST_AUTO_TEST_CASE(levels_are_round_and_hold_all_values_between_them) {
  const std::vector<std::array<double, 2>> ranges = {{0, 1},     {-0.37, 2.41}, {1e-7, 3e-7},
                                                     {-5, -4.9}, {0, 1234567},  {0.9999, 1.0001}};
  for (const auto& [low, high] : ranges) {
    const std::vector<double> levels = levels_of(squares({low, high}));
    BOOST_TEST(levels.size() >= 5U);
    BOOST_TEST(levels.size() <= 17U);
    const double step = levels[1] - levels[0];
    BOOST_TEST(levels.front() <= low + 0.02 * step);
    BOOST_TEST(levels.back() >= high - 0.02 * step);
    const double digits = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    BOOST_TEST((std::abs(digits - 1) < 1e-6 || std::abs(digits - 2) < 1e-6 ||
                std::abs(digits - 5) < 1e-6));
    for (const double level : levels)
      BOOST_TEST(std::abs(level / step - std::round(level / step)) < 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(a_value_that_is_everywhere_the_same_has_levels_around_it) {
  for (const double value : {0., 3., -2e-9}) {
    const std::vector<double> levels = levels_of(squares({value, value * (1 + 1e-15)}));
    BOOST_TEST(levels.front() <= value);
    BOOST_TEST(levels.back() > value);
    for (std::size_t k = 1; k < levels.size(); ++k) BOOST_TEST(levels[k] > levels[k - 1]);
  }
}

BOOST_AUTO_TEST_CASE(logarithmic_levels_are_halves_of_powers_of_ten_over_four_decades_at_most) {
  const std::vector<double> few = levels_of(squares({0.02, 3}, true));
  BOOST_TEST(few.front() == 0.01, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(few.back() == 10, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(few[1] == 0.01 * std::sqrt(10), boost::test_tools::tolerance(1e-9));
  const std::vector<double> narrow = levels_of(squares({0.3, 0.8}, true));
  BOOST_TEST(narrow.front() == 0.3, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(narrow.size() >= 6U);
  FieldMap many = squares({1e-14, 1, 0, -3, std::nan("")}, true);
  BOOST_TEST(levels_of(many).front() == 1e-4, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(levels_of(many).back() == 1, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(levels_of(many).size() == 9U);
  many.kept = LogEnd::low;
  BOOST_TEST(levels_of(many).front() == 1e-14, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(levels_of(many).back() == 1e-10, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(on_a_logarithmic_scale_zero_is_the_lowest_colour_and_a_negative_value_none) {
  const FieldMap map = squares({0, -1, 50, std::nan(""), 0.5}, true);
  const std::string lowest = blocks(map).front(), none = block_of(map, "not a number");
  BOOST_TEST(has_square(lowest, 0));
  BOOST_TEST(!has_square(lowest, 2));
  BOOST_TEST(has_square(none, 1));
  BOOST_TEST(has_square(none, 3));
  BOOST_TEST(!has_square(none, 0));
}

BOOST_AUTO_TEST_CASE(values_beyond_given_levels_have_the_colours_of_the_ends) {
  FieldMap map = squares({-7, 1.5, 0.5, 99});
  map.levels = {0, 1, 2};
  BOOST_TEST(levels_of(map) == map.levels, boost::test_tools::per_element());
  BOOST_TEST(has_square(block_of(map, "from 0 to 1"), 0));
  BOOST_TEST(has_square(block_of(map, "from 1 to 2"), 3));
}

BOOST_AUTO_TEST_CASE(one_singular_value_in_hundreds_does_not_take_up_the_scale) {
  std::vector<double> values(400);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 400;
  BOOST_TEST(levels_of(squares(values)).back() == 1);
  values[7] = 1e6;
  BOOST_TEST(levels_of(squares(values)).back() == 1);
  std::fill(values.begin(), values.begin() + 100, 1e6);
  BOOST_TEST(levels_of(squares(values)).back() >= 0.98e6);
}

BOOST_AUTO_TEST_CASE(nothing_but_nan_is_grey_all_over) {
  const FieldMap map = squares({std::nan("")});
  BOOST_TEST(has_square(block_of(map, "not a number"), 0));
}

BOOST_AUTO_TEST_CASE(only_what_the_window_shows_decides_on_the_colours) {
  FieldMap map = squares({1, 2, 1000});
  map.window = Window{{0, 0}, {1.9, 1}};
  BOOST_TEST(levels_of(map).back() < 3);
}

BOOST_AUTO_TEST_CASE(the_script_draws_every_block_of_the_data) {
  FieldMap map = squares({1, 2, 3});
  map.streamlines = {{{0, 0.5}, {3, 0.5}}};
  map.regions = {{"yielded", "#a6cee3", squares({1, -1}).patches}};
  const std::size_t count = blocks(map).size();
  std::size_t block = 4;
  const std::string script = field_script(map, "'fields.dat'", block);
  BOOST_TEST(block == 4 + count);
  for (std::size_t k = 4; k < block; ++k)
    BOOST_TEST(script.find("index " + std::to_string(k) + " ") != std::string::npos);
  for (const char* part : {"title 'yielded'", "title 'streamlines'", "|u| / sqrt(gd)"})
    BOOST_TEST(script.find(part) != std::string::npos, part);
  BOOST_TEST(figure_of(map).has_fields());
  BOOST_TEST(!Figure{}.has_fields());
}

BOOST_AUTO_TEST_CASE(fields_are_drawn_where_gnuplot_is) {
  FieldMap map = squares({1, 2, 3, std::nan("")});
  map.regions = {{"yielded", "#a6cee3", squares({1, -1}).patches}};
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  for (const std::string format : {"png", "svg"}) {
    const std::string failure = write_figure(folder, figure_of(map), format);
    BOOST_TEST(failure.empty() == gnuplot_is_available(), failure);
    if (!failure.empty()) return;
    const std::string image = contents_of(folder.path() / ("fields." + format));
    BOOST_TEST(image.size() < 150000U);
    if (format == "svg") BOOST_TEST(image.find("it's a title") != std::string::npos);
  }
}

BOOST_AUTO_TEST_SUITE_END()
