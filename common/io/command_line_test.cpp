// Is a value what was written, and is what nobody meant refused?
#include "common/io/command_line.hpp"

#include <numbers>
#include <sstream>

#include <boost/test/unit_test.hpp>

#include "common/io/options.hpp"

BOOST_AUTO_TEST_SUITE(command_line_test)

using namespace talus::io;

namespace {

using Words = std::vector<std::string>;

// A program with an option of every kind.
struct Sample {
  CommandLine line{"a program", "program"};
  int count = 7;
  double ratio = 0.5, angle = 0.4;
  std::vector<double> loads = {1, 2};
  std::string method = "newton", folder = "results";
  bool plot = false;

  // The exit code for these words, what it says on stderr in `message`.
  int run(Words words) {
    add_integer(line, "--count", count, "Things", 1, 1000);
    add_real(line, "--ratio", ratio, "Ratio", 0, 1000);
    add_angle(line, "--angle", angle, "Slope", 0.001, 1.57);
    add_reals(line, "--loads", loads, "Loads", 0, 10);
    add_choice(line, "--method", method, "Method", {"newton", "interior-point"});
    add_text(line, "--folder", folder, "Folder");
    add_value(line, "--align", "TEXT", "Align", [&](const std::string& fraction) {
      align = fraction.empty() ? "none" : fraction;
    }).takes(0, 1);
    add_flag(line, "--plot", plot, "Plot");
    words.insert(words.begin(), "program");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    std::ostringstream captured;
    std::streambuf* const previous = std::cerr.rdbuf(captured.rdbuf());
    const int code = line.run(static_cast<int>(argv.size()), argv.data(), [] { return 0; });
    std::cerr.rdbuf(previous);
    message = captured.str();
    return code;
  }
  std::string align, message;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Refused in one line that has `part` in it.
boost::test_tools::predicate_result is_refused(const Words& words, const std::string& part) {
  Sample sample;
  const int code = sample.run(words);
  const auto lines = std::count(sample.message.begin(), sample.message.end(), '\n');
  if (code == 2 && lines == 1 && contains(sample.message, part)) return true;
  boost::test_tools::predicate_result wrong(false);
  wrong.message() << "code " << code << ", " << lines << " lines: " << sample.message;
  return wrong;
}

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_are_decimal_whatever_zeros_lead_them) {
  for (const auto& [text, value] : std::vector<std::pair<std::string, int>>{
           {"0100", 100}, {"08", 8}, {"0010", 10}, {"1", 1}, {"1000", 1000}}) {
    Sample sample;
    BOOST_TEST(sample.run({"--count", text}) == 0);
    BOOST_TEST(sample.count == value);
  }
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
           {"010", 10}, {"1e2", 100}, {".5", 0.5}, {"08.5", 8.5}, {"5.", 5}, {"0", 0}}) {
    Sample sample;
    BOOST_TEST(sample.run({"--ratio", text}) == 0);
    BOOST_TEST(sample.ratio == value);
  }
}

BOOST_AUTO_TEST_CASE(what_is_no_number_is_refused_with_its_text_and_range) {
  for (const std::string text :
       {"", " 1", "1 ", "+1", "0x10", "0b1", "1_000", "1'000", "1,000", "10.0", "1e2", "nan", "inf",
        "ten", "-1", "99999999999", "[10]", "{}", "1\n2"})
    BOOST_TEST(is_refused({"--count", text}, "1 ... 1000"));
  for (const std::string text : {"", " 1", "1 ", "+1", "0x10", "0x1p3", "1_000", "1'000", "1,000",
                                 "nan", "inf", "infinity", "1e400", "1e-400", "-1", "1d2", "[10]"})
    BOOST_TEST(is_refused({"--ratio", text}, "0 ... 1000"));
}

BOOST_AUTO_TEST_CASE(several_values_are_separated_by_commas_or_spaces_and_none_is_empty) {
  for (const Words& words : {Words{"--loads", "1,02", "3"}, Words{"--loads=1,02,3"},
                             Words{"--loads", "1", "02", "3", "--plot"}}) {
    Sample sample;
    BOOST_TEST(sample.run(words) == 0);
    BOOST_TEST(sample.loads == (std::vector<double>{1, 2, 3}), boost::test_tools::per_element());
  }
  for (const std::string text : {"", "1,,2", "1,", ",1", ",", "1;2", "[1,2]", "1,x"})
    BOOST_TEST(is_refused({"--loads", text}, "0 ... 10"));
  BOOST_TEST(is_refused({"--loads"}, "value is missing"));
}

BOOST_AUTO_TEST_CASE(an_angle_is_in_radians_or_in_degrees_that_say_so) {
  for (const auto& [text, radians] :
       std::vector<std::pair<std::string, double>>{{"0.41", 0.41},
                                                   {"23deg", 23 * std::numbers::pi / 180},
                                                   {"0.5deg", std::numbers::pi / 360}}) {
    Sample sample;
    BOOST_TEST(sample.run({"--angle", text}) == 0);
    BOOST_TEST(sample.angle == radians, boost::test_tools::tolerance(1e-15));
  }
  for (const std::string text :
       {"90deg", "23", "23 deg", "deg", "23degrees", "nandeg", "0deg", "0x17deg"})
    BOOST_TEST(is_refused({"--angle", text}, "'" + text +
                                                 "' is not a number in the allowed range "
                                                 "0.001 ... 1.57 radians (or 23deg)"));
}

BOOST_AUTO_TEST_CASE(an_option_is_given_once_with_its_value_or_not_at_all) {
  BOOST_TEST(is_refused({"--count", "1", "--count", "2"}, "--count: it is given twice"));
  BOOST_TEST(is_refused({"--count", "1", "--count=1"}, "--count: it is given twice"));
  BOOST_TEST(is_refused({"--plot", "--plot"}, "--plot: it is given twice"));
  BOOST_TEST(is_refused({"--loads", "1", "--loads", "2"}, "--loads: it is given twice"));
  BOOST_TEST(is_refused({"--count"}, "--count: its value is missing"));
  BOOST_TEST(is_refused({"--folder", "--plot"}, "--folder: its value is missing before '--plot'"));
  BOOST_TEST(is_refused({"--folder", ""}, "--folder: '' is no value"));
  BOOST_TEST(is_refused({"--folder="}, "--folder: '' is no value"));
  BOOST_TEST(is_refused({"--align", ""}, "--align: '' is no value"));
  BOOST_TEST(is_refused({"--plot=yes"}, "--plot: it takes no value"));
  BOOST_TEST(is_refused({"--plot", "yes"}, "'yes' belongs to no option"));
  BOOST_TEST(is_refused({"--count", "10", "20", "40"}, "'20' '40' belong to no option"));
  BOOST_TEST(is_refused({"--", "20"}, "'20' belongs to no option"));
  BOOST_TEST(is_refused({"--count", "-3"}, "'-3'"));
  Sample sample;
  BOOST_TEST(sample.run({"--count=10", "--folder=--plot", "--align", "--"}) == 0);
  BOOST_TEST(sample.count == 10);
  BOOST_TEST(sample.folder == "--plot");
  BOOST_TEST(sample.align == "none");
  BOOST_TEST(!sample.plot);
  Sample other;
  BOOST_TEST(other.run({"--align", "0.5", "--plot"}) == 0);
  BOOST_TEST(other.align == "0.5");
  BOOST_TEST(other.plot);
}

BOOST_AUTO_TEST_CASE(a_name_nearly_right_is_asked_about_and_one_far_off_is_not) {
  for (const auto& [word, name] :
       std::vector<std::pair<std::string, std::string>>{{"--cuont", "--count"},
                                                        {"--cou", "--count"},
                                                        {"-count", "--count"},
                                                        {"--Ratio", "--ratio"},
                                                        {"--methods", "--method"}})
    BOOST_TEST(is_refused({word, "3"}, word + ": there is no such option; did you mean " + name));
  BOOST_TEST(!is_refused({"--frobnicate"}, "did you mean"));
  BOOST_TEST(is_refused({"--frobnicate"}, "--frobnicate: there is no such option"));
  BOOST_TEST(is_refused({"--method", "newtn"},
                        "'newtn' is none of: newton, interior-point; did "
                        "you mean newton?"));
  BOOST_TEST(!is_refused({"--method", "picard"}, "did you mean"));
  const std::string both = did_you_mean("--lambda_r", {"--lambda-p", "--lambda-r"});
  BOOST_TEST(both == "; did you mean --lambda-r?");
  BOOST_TEST(did_you_mean("--regularization", {"--grading", "--regularisation"}) ==
             "; did you mean --regularisation?");
  BOOST_TEST(did_you_mean("ab", {"xy"}).empty());
}

BOOST_AUTO_TEST_CASE(an_option_that_a_run_does_not_use_is_refused_only_if_it_was_given) {
  const auto table = [](bool is_used) {
    return std::vector<Use>{{{"--count", "--plot"}, is_used, "--method newton; add --method x"}};
  };
  Sample sample;
  BOOST_TEST(sample.run({"--plot"}) == 0);
  BOOST_CHECK_EXCEPTION(
      refuse_unused(sample.line, table(false)), UserError, [](const UserError& error) {
        return std::string(error.what()) == "--plot: not used by --method newton; add --method x";
      });
  BOOST_CHECK_NO_THROW(refuse_unused(sample.line, table(true)));
  Sample other;
  BOOST_TEST(other.run({"--ratio", "1"}) == 0);
  BOOST_CHECK_NO_THROW(refuse_unused(other.line, table(false)));
}

BOOST_AUTO_TEST_CASE(help_says_what_every_option_takes_and_comes_before_what_follows_it) {
  std::ostringstream captured;
  std::streambuf* const previous = std::cout.rdbuf(captured.rdbuf());
  const int code = Sample().run({"--count", "5", "--help", "--nonsense"});
  std::cout.rdbuf(previous);
  BOOST_TEST(code == 0);
  for (const std::string text : {"--count INT=7", "[1 ... 1000]", "--angle ANGLE=0.4", "23deg",
                                 "--loads FLOAT=1,2", "--method NAME=newton"})
    BOOST_TEST(contains(captured.str(), text), text);
}

BOOST_AUTO_TEST_CASE(a_choice_is_taken_by_its_name_and_by_an_older_one) {
  Sample sample;
  BOOST_TEST(sample.run({"--method", "interior-point"}) == 0);
  BOOST_TEST(sample.method == "interior-point");
  CommandLine line{"a program", "program"};
  std::string model = "section";
  add_choice(line, "--model", model, "Model", {"section", "space"}, {{"3d", "space"}});
  std::string words[] = {"program", "--model", "3d"};
  char* argv[] = {words[0].data(), words[1].data(), words[2].data()};
  BOOST_TEST(line.run(3, argv, [] { return 0; }) == 0);
  BOOST_TEST(model == "space");
}

BOOST_AUTO_TEST_SUITE_END()
