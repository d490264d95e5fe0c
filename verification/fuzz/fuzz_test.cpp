// What the fuzz stands on: options read from --help, draws, shell lines.
#include <set>

#include <boost/test/unit_test.hpp>

#include "verification/fuzz/campaign.hpp"
#include "verification/fuzz/folder.hpp"

using namespace talus;
namespace fs = std::filesystem;

namespace {

fs::path programs() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace

BOOST_AUTO_TEST_CASE(options_are_read_from_the_help_of_a_program) {
  const auto options = fuzz::options_in(
      "Flow\nUsage: flow [OPTIONS]\n\nOptions:\n"
      "  -h,--help                   Print this help message and exit\n"
      "  --elements INT=40           Quadratic elements [1 ... 100000]\n"
      "  --angle ANGLE=0.41 Excludes: --flow-rate\n"
      "                              Inclination [0.001 ... 1.57]\n"
      "  --method TEXT=newton        Newton or not [newton, interior-point]\n"
      "  --loading FLOAT=[0.054] ... Excludes: --sweep\n"
      "                              Loadings, one or several [each 1e-06 ... 0.07]\n"
      "  --no-inertia{false}         Leave it out\n");
  BOOST_REQUIRE(options.size() == 5);
  BOOST_TEST(options[0].name == "--elements");
  BOOST_TEST((options[0].form == fuzz::Form::whole && options[0].upper == 100000));
  BOOST_TEST((options[1].form == fuzz::Form::real && options[1].lower == 0.001));
  BOOST_TEST(options[1].standard == "0.41");
  BOOST_TEST((options[2].form == fuzz::Form::choice && options[2].choices.size() == 2));
  BOOST_TEST((options[3].form == fuzz::Form::reals && options[3].standard == "0.054"));
  BOOST_TEST((options[4].name == "--no-inertia" && options[4].form == fuzz::Form::flag));
}

BOOST_AUTO_TEST_CASE(a_line_is_drawn_from_its_seed_kind_and_number_alone) {
  const fuzz::Program heap = fuzz::read_program(programs() / "heap");
  const auto line = [&](std::uint64_t seed, const char* kind, int number) {
    fuzz::Random random(seed, kind, number);
    return fuzz::draw_line(heap, random).arguments;
  };
  for (int i = 0; i < 20; ++i) BOOST_TEST(line(1, "commands", i) == line(1, "commands", i));
  std::set<std::vector<std::string>> lines;
  for (int i = 0; i < 50; ++i)
    lines.insert({line(1, "commands", i), line(2, "commands", i), line(1, "cross", i)});
  BOOST_TEST(lines.size() > 120);
}

BOOST_AUTO_TEST_CASE(a_script_can_be_pasted_into_a_shell) {
  const std::vector<std::string> words = {"plain", "", "it's", "a b", "$HOME", "new\nline\\'", "µ"};
  std::string command = "printf '<%s>'", expected;
  for (const std::string& word : words) {
    command += " " + fuzz::shell_word(word);
    expected += "<" + word + ">";
  }
  BOOST_TEST(fuzz::run({"/bin/bash", {"-c", command}, "/"}).out == expected);
}

BOOST_AUTO_TEST_CASE(a_word_is_told_from_a_number_that_is_none) {
  for (const char* text :
       {"velocity nan", "1,2,NaN\n", "-inf", "gap inf.\n", "<x>nan</x>", "(nan)"})
    BOOST_TEST(fuzz::has_no_number(text));
  for (const char* text : {"nanometres", "information", "at infinite", "finance", "1e300", ""})
    BOOST_TEST(!fuzz::has_no_number(text));
}
