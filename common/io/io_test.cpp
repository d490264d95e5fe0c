#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <set>
#include <sstream>

#include <boost/test/unit_test.hpp>

#include "common/io/figure.hpp"
#include "common/io/options.hpp"
#include "common/io/table.hpp"
#include "common/testing/temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(io_test)

using namespace talus::io;
using talus::testing::contents_of;
using talus::testing::TemporaryFolder;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

Figure two_panels() {
  Panel curves{"speed", "h", "error", true, false, {}};
  curves.curves.push_back({"it's one", {1, 0.1}, {2, 0.25}});
  curves.curves.push_back({"empty", {}, {}});
  Panel map{"ends", "", "", false, false, {}};
  map.map = Map{{"a", "b"},
                {"first", "second"},
                {{3.5, std::nan("")}, {1, 2}},
                {{"", "F"}, {"", ""}},
                "iterations"};
  return {"figure", "a caption", {curves, map}, 2};
}

// The outcome of run_program with one integer option, what it wrote to stderr included.
struct Outcome {
  int code = 0, value = 7;
  std::string message;
};
Outcome outcome_of(std::vector<std::string> arguments, const std::function<int()>& body) {
  Outcome outcome;
  CommandLine line{"a program", "program"};
  add_integer(line, "--count", outcome.value, "Number of things", 1, 10);
  arguments.insert(arguments.begin(), "program");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  std::ostringstream captured;
  std::streambuf* const previous = std::cerr.rdbuf(captured.rdbuf());
  outcome.code = line.run(static_cast<int>(argv.size()), argv.data(), body);
  std::cerr.rdbuf(previous);
  outcome.message = captured.str();
  return outcome;
}

}  // namespace

BOOST_AUTO_TEST_CASE(exact_numbers_read_back_as_the_same_double) {
  for (const double value : {0., 1., -0.1, 1. / 3, 1e-300, 5e-324, 1.7976931348623157e308})
    BOOST_TEST(number_in(exact(value)) == value);
  BOOST_TEST(exact(0.1) == "0.1");
  BOOST_TEST(exact(std::numeric_limits<double>::infinity()) == "inf");
  BOOST_TEST(exact(std::nan("")) == "nan");
  for (const char* none : {"", "1,5", "one", "nan"}) BOOST_TEST(std::isnan(number_in(none)));
}

BOOST_AUTO_TEST_CASE(rounded_and_fixed_numbers_have_the_digits_asked_for) {
  BOOST_TEST(rounded(1. / 3, 3) == "0.333");
  BOOST_TEST(rounded(2, 5) == "2");
  BOOST_TEST(rounded(1e-9, 2) == "1e-09");
  BOOST_TEST(fixed(2. / 3, 2) == "0.67");
  BOOST_TEST(fixed(1e300, 0).size() == 301);
}

BOOST_AUTO_TEST_CASE(csv_quotes_what_would_break_a_row) {
  const Table table{"", {"plain", "a,b"}, {{"say \"hi\"", "two\nlines"}, {"", "x"}}};
  BOOST_TEST(to_csv(table) == "plain,\"a,b\"\n\"say \"\"hi\"\"\",\"two\nlines\"\n,x\n");
}

BOOST_AUTO_TEST_CASE(printed_columns_align_by_characters_not_bytes) {
  std::ostringstream out;
  print(out, {"title", {"λr", "end"}, {{"1e-6", "a"}}});
  BOOST_TEST(out.str() == "title\n  λr    end\n  1e-6  a  \n");
}

BOOST_AUTO_TEST_CASE(lack_of_memory_is_named_with_what_to_try_and_exits_with_1) {
  struct OfSolver : std::bad_alloc {
    const char* what() const noexcept override { return "factors need 7 GB"; }
  };
  const Outcome plain = outcome_of({}, []() -> int { throw std::bad_alloc(); });
  const Outcome of_solver = outcome_of({}, []() -> int { throw OfSolver(); });
  for (const Outcome& outcome : {plain, of_solver}) {
    BOOST_TEST(outcome.code == 1);
    BOOST_TEST(outcome.message.find("program: out_of_memory: ") == 0U);
    BOOST_TEST(outcome.message.find("fewer elements") != std::string::npos);
  }
  BOOST_TEST(plain.message.find("no more to be had beyond") != std::string::npos);
  BOOST_TEST(of_solver.message.find("factors need 7 GB") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_result_folder_is_created_and_holds_whole_files_only) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path() / "deep" / "er");
  const std::string contents("line\n\0binary", 12);
  folder.write("a.txt", "something longer that is to be replaced");
  folder.write("a.txt", contents);
  BOOST_TEST(contents_of(folder.path() / "a.txt") == contents);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename().string());
  BOOST_TEST(names == std::vector<std::string>{"a.txt"}, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_folder_that_cannot_be_written_to_is_the_user_s_error) {
  const TemporaryFolder temporary;
  std::ofstream(temporary.path() / "file") << "regular";
  const auto below = temporary.path() / "file" / "below";
  BOOST_CHECK_EXCEPTION(ResultFolder{below}, UserError, [&](const UserError& error) {
    return contains(error.what(), "--output") && contains(error.what(), below.string());
  });
  BOOST_CHECK_THROW(ResultFolder{temporary.path() / "file"}, UserError);
  BOOST_CHECK_NO_THROW(ResultFolder{temporary.path()});
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_be_written_is_the_user_s_error_and_leaves_nothing) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  BOOST_CHECK_THROW(folder.write("no/such/folder.txt", "text"), UserError);
  BOOST_TEST(std::filesystem::is_empty(temporary.path()));
}

BOOST_AUTO_TEST_CASE(figure_data_holds_a_block_for_every_curve_and_map) {
  const std::string data = figure_data(two_panels());
  BOOST_TEST(count(data, "\n\n\n") == 3);
  BOOST_TEST(contains(data, "1 2\n0.1 0.25\n"));
  BOOST_TEST(contains(data, "NaN NaN\n"));  // keeps the empty curve's place
  BOOST_TEST(contains(data, "0 0 3.5 \"\"\n1 0 NaN \"F\"\n0 1 1 \"\"\n1 1 2 \"\"\n"));
}

BOOST_AUTO_TEST_CASE(figure_scripts_draw_every_block_of_the_data) {
  for (const std::string format : {"svg", "png"}) {
    const std::string script = figure_script(two_panels(), format);
    BOOST_TEST(contains(script, "set output 'figure." + format + "'"));
    BOOST_TEST(contains(script, "set multiplot layout 1,2"));
    BOOST_TEST(contains(script, "'figure.dat' index 0"));
    BOOST_TEST(!contains(script, "index 1 "));  // the empty curve
    BOOST_TEST(contains(script, "'figure.dat' index 2 using 1:2:3 with image"));
    BOOST_TEST(contains(script, "title \"it's one\""));
    BOOST_TEST(count(script, "set logscale") == 1);
  }
}

BOOST_AUTO_TEST_CASE(a_panel_of_one_point_has_ranges_around_it) {
  Figure figure = two_panels();
  BOOST_TEST(!contains(figure_script(figure, "svg"), "set yrange [0"));
  figure.panels[0].curves[0] = {"one", {0.1}, {-2}};
  const std::string script = figure_script(figure, "svg");
  BOOST_TEST(contains(script, "set xrange [0.05:0.2]\n"));  // logarithmic
  BOOST_TEST(contains(script, "set yrange [-2.2:-1.8]\n"));
  figure.panels[0].curves[0].x = {0.1, 0.1};
  figure.panels[0].curves[0].y = {0, 0};
  BOOST_TEST(contains(figure_script(figure, "svg"), "set yrange [-1:1]\n"));
}

BOOST_AUTO_TEST_CASE(a_slope_is_a_triangle_of_its_order_below_a_stretch_of_the_way) {
  Figure figure{"figure", "", {{"", "h", "error", true, true, {}}}, 1};
  figure.panels[0].curves = {{"order 2", {1, 0.01}, {1, 1e-4}, Style::slope}};
  const std::string data = figure_data(figure);
  std::istringstream lines(data.substr(data.find("error\n") + 6));
  double x[4], y[4];
  for (int i = 0; i < 4; ++i) lines >> x[i] >> y[i];
  BOOST_TEST(std::log(y[2] / y[0]) / std::log(x[2] / x[0]) == 2,
             boost::test_tools::tolerance(1e-12));
  BOOST_TEST(x[1] == x[2]);  // upright on the side where the error is large
  BOOST_TEST(y[0] == y[1]);
  BOOST_TEST((x[3] == x[0] && y[3] == y[0]));
  BOOST_TEST(contains(figure_script(figure, "svg"), "('order 2') with labels"));
}

BOOST_AUTO_TEST_CASE(bars_are_shares_in_the_data_with_their_counts) {
  Figure figure{"figure", "", {{"", "%", "", false, false, {}}}, 1};
  figure.panels[0].bars = Bars{{"first", "second"}, {"good", "bad"}, {{3, 0}, {1, 0}}};
  const std::string data = figure_data(figure);
  BOOST_TEST(contains(data, "37.5 -0 0 75 3\n0 -1 0 0 0\n"));
  BOOST_TEST(contains(data, "87.5 -0 75 100 1\n"));
  BOOST_TEST(count(figure_script(figure, "svg"), "with boxxyerror") == 2);
}

BOOST_AUTO_TEST_CASE(curves_differ_in_colour_line_and_mark_and_the_first_are_the_thickest) {
  Figure figure{"figure", "", {{"", "x", "y", false, false, {}}}, 1};
  for (const char* label : {"a", "b", "c", "d", "e"})
    figure.panels[0].curves.push_back({label, {1, 2}, {1, 2}});
  const std::string script = figure_script(figure, "svg");
  std::set<std::string> colours, dashes, marks;
  double thinner = 10;
  for (std::size_t at = script.find(" lw "); at != std::string::npos;
       at = script.find(" lw ", at + 1)) {
    std::istringstream words(script.substr(at + 4));
    double width = 0;
    std::string word, dash, mark, colour;
    words >> width >> word >> dash >> word >> mark >> word >> word >> word >> word >> colour;
    BOOST_TEST(width < thinner);
    thinner = width;
    dashes.insert(dash);
    marks.insert(mark);
    colours.insert(colour);
  }
  for (const auto& each : {colours, dashes, marks}) BOOST_TEST(each.size() == 5U);
}

BOOST_AUTO_TEST_CASE(every_panel_is_a_picture_of_its_own_as_large_as_the_page_is_told) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  const Figure figure = two_panels();
  BOOST_TEST(panel_file(figure, 1) == "figure_2.svg");
  BOOST_TEST(panel_file({"one", "", {figure.panels[0]}, 1}, 0) == "one.svg");
  if (!write_panels(folder, figure).empty()) {
    BOOST_TEST(!gnuplot_is_available());
    BOOST_TEST_MESSAGE("skipped: gnuplot is missing, no panel was looked at");
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string svg = contents_of(folder.path() / panel_file(figure, i));
    const PanelSize size = size_of(figure.panels[i]);
    BOOST_TEST(contains(svg, "width=\"" + std::to_string(size.width) + "\""));
    BOOST_TEST(contains(svg, "height=\"" + std::to_string(size.height) + "\""));
    BOOST_TEST(count(svg, "<svg") == 1);
    BOOST_TEST(contains(svg, i == 0 ? "it's one" : "first"));
  }
  BOOST_TEST(contents_of(folder.path() / "figure.dat") == figure_data(figure));
}

BOOST_AUTO_TEST_CASE(figures_are_drawn_where_gnuplot_is_and_their_data_everywhere) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  const bool drawn = write_figure(folder, two_panels(), "svg").empty();
  BOOST_TEST(drawn == gnuplot_is_available());
  if (!drawn) BOOST_TEST_MESSAGE("skipped: gnuplot is missing, the image was not looked at");
  BOOST_TEST(contents_of(folder.path() / "figure.dat") == figure_data(two_panels()));
  BOOST_TEST(contents_of(folder.path() / "figure.gp") == figure_script(two_panels(), "svg"));
  if (drawn) BOOST_TEST(contains(contents_of(folder.path() / "figure.svg"), "<svg"));
}

BOOST_AUTO_TEST_CASE(a_number_out_of_range_is_named_with_its_option_and_its_range) {
  BOOST_TEST(real_in_range("--align", "0.25", 0, 0.99) == 0.25);
  BOOST_TEST(real_in_range("--align", "0", 0, 0.99) == 0);
  BOOST_TEST(real_in_range("--align", "0.99", 0, 0.99) == 0.99);
  for (const std::string text : {"1", "-1e-9", "nan", "inf", "0.5x", " 0.5", "", "1e999"})
    BOOST_CHECK_EXCEPTION(
        real_in_range("--align", text, 0, 0.99), UserError, [&](const UserError& error) {
          return contains(error.what(), "--align") && contains(error.what(), "'" + text + "'") &&
                 contains(error.what(), "0 ... 0.99");
        });
}

BOOST_AUTO_TEST_CASE(programs_exit_with_2_on_wrong_input_and_say_why_in_one_line) {
  const auto succeed = [] { return 0; };
  BOOST_TEST(outcome_of({"--count", "3"}, succeed).code == 0);
  BOOST_TEST(outcome_of({"--count", "3"}, succeed).value == 3);
  for (const std::string value : {"0", "11", "abc", "2.5", "99999999999"}) {
    const Outcome outcome = outcome_of({"--count", value}, succeed);
    BOOST_TEST(outcome.code == 2);
    BOOST_TEST(contains(outcome.message, "--count"));
    BOOST_TEST(contains(outcome.message, "'" + value + "'"));
    BOOST_TEST(contains(outcome.message, "1 ... 10"));
    BOOST_TEST(count(outcome.message, "\n") == 1);
  }
  const Outcome unknown = outcome_of({"--cuont", "3"}, succeed);
  BOOST_TEST(unknown.code == 2);
  BOOST_TEST(contains(unknown.message, "--cuont"));
}

BOOST_AUTO_TEST_CASE(programs_pass_on_the_body_s_code_and_report_what_it_throws) {
  BOOST_TEST(outcome_of({}, [] { return 1; }).code == 1);
  const Outcome user = outcome_of({}, []() -> int { throw UserError("--x: no"); });
  BOOST_TEST(user.code == 2);
  BOOST_TEST(user.message == "program: --x: no\n");
  const Outcome other = outcome_of({}, []() -> int { throw std::runtime_error("broken"); });
  BOOST_TEST(other.code == 1);
  BOOST_TEST(other.message == "program: broken\n");
}

BOOST_AUTO_TEST_SUITE_END()
