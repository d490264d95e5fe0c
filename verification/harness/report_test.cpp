// The pages: what they show, that text is escaped, and what a front page makes of parts of a run.
#include <cmath>

#include <boost/test/unit_test.hpp>

#include "common/testing/temporary_folder.hpp"
#include "verification/harness/alt_text.hpp"
#include "verification/harness/chapter_file.hpp"
#include "verification/harness/front_page.hpp"
#include "verification/harness/html.hpp"

BOOST_AUTO_TEST_SUITE(report_test)

using namespace talus;
using namespace talus::verification;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Written written(const Chapter& chapter) {
  return write_chapter(chapter, "no such folder");
}

std::string front(const Chapter& chapter) {
  return front_page({written(chapter)}, "./run verify <all>", "no such folder");
}

}  // namespace

BOOST_AUTO_TEST_CASE(pages_show_failures_and_escape_text) {
  Chapter chapter{"name", "Is a < b?", {}, {}};
  chapter.text("x & y");
  chapter.answer("\"Yes\" > no.");
  chapter.check(Kind::self_consistency, "good", 1, 0, 2);
  BOOST_TEST(contains(front(chapter), "Every check holds."));
  BOOST_TEST(contains(front(chapter), "Is a &lt; b?"));
  BOOST_TEST(contains(front(chapter), "./run verify &lt;all&gt;"));
  std::string page = html_of(written(chapter));
  BOOST_TEST(contains(page, "x &amp; y"));
  BOOST_TEST(contains(page, "&quot;Yes&quot; &gt; no. All 1 checks hold: 1 against itself."));
  BOOST_TEST(!contains(page, "FAILS"));
  chapter.check(Kind::exact, "bad <", std::nan(""), 0, 2);
  BOOST_TEST(contains(front(chapter), "Some checks do not hold."));
  BOOST_TEST(contains(front(chapter), "1 of 2 hold."));
  page = html_of(written(chapter));
  BOOST_TEST(contains(page, "fails>FAILS"));
  BOOST_TEST(contains(page, "bad &lt;"));
  BOOST_TEST(contains(page, "<details open>"));
}

BOOST_AUTO_TEST_CASE(a_figure_without_its_picture_is_reported_as_skipped) {
  Chapter chapter{"name", "title", {}, {}};
  chapter.figure({"missing", "caption", {{"", "x", "y", false, false, {{"one", {1}, {1}}}}}, 1});
  BOOST_TEST(contains(written(chapter).body, "Skipped: gnuplot drew no figure."));
}

BOOST_AUTO_TEST_CASE(a_front_page_shows_the_questions_that_were_answered_and_no_other) {
  Chapter chapter{"cost", "What does it cost?", {}, {}};
  BOOST_TEST(!contains(front(chapter), "class=cards"));
  chapter.headline(Question::speed_against_accuracy, {"fast", "", {}, 1}, "Faster & better.");
  BOOST_TEST(contains(front(chapter), "Speed against accuracy"));
  BOOST_TEST(contains(front(chapter), "Faster &amp; better."));
  BOOST_TEST(contains(front(chapter), "href=\"cost.html\""));
  BOOST_TEST(!contains(front(chapter), "Where methods fail"));
  BOOST_TEST(!contains(front(chapter), "The flows"));
  chapter.headline(Question::flows, {"flow", "", {}, 1}, "It flows.");
  BOOST_TEST(contains(front(chapter), "The flows"));
}

BOOST_AUTO_TEST_CASE(ends_of_all_parts_are_counted_together) {
  BOOST_TEST(ends_sentence({}).empty());
  BOOST_TEST(ends_figure({}).panels.empty());
  Chapter one{"one", "", {}, {}}, other{"other", "", {}, {}};
  one.ends = {{"usual", true, {{arrival, 3}}}, {"less", false, {{arrival, 1}, {"not_finite", 2}}}};
  other.ends = {{"usual", true, {{arrival, 4}, {"stagnated", 1}}}};
  const std::vector<Written> both = {written(one), written(other)};
  BOOST_TEST(ends_sentence(both) ==
             "Of the solves by the ways we recommend 7 of 8 arrive (1 stagnated); with one thing "
             "taken away 1 of 3 arrive (2 not finite).");
  const io::Bars bars = *ends_figure(both).panels[0].bars;
  BOOST_TEST(
      bars.rows == (std::vector<std::string>{"recommended:", "usual", "one thing less:", "less"}),
      boost::test_tools::per_element());
  BOOST_TEST(bars.parts == (std::vector<std::string>{"arrives", "not finite", "stagnated"}),
             boost::test_tools::per_element());
  BOOST_TEST(bars.counts[1] == (std::vector<double>{0, 0, 0, 2}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_part_on_disk_keeps_its_answers_headlines_and_ends) {
  const testing::TemporaryFolder folder;
  Chapter chapter{"part", "Why?", {}, {}};
  chapter.headline(Question::which_model, {"models", "", {}, 1}, "Use the \"line\".");
  chapter.ends = {{"usual", false, {{arrival, 3}}}};
  write_chapter_files(io::ResultFolder(folder.path()), chapter, false, 1.5);
  const auto read = read_chapter(folder.path());
  BOOST_REQUIRE(read.has_value());
  BOOST_TEST(read->written.answers.at(0) == "Use the \"line\".");
  BOOST_REQUIRE(read->written.headlines.size() == 1U);
  BOOST_TEST((read->written.headlines[0].question == Question::which_model));
  BOOST_TEST(read->written.headlines[0].sentence == "Use the \"line\".");
  BOOST_REQUIRE(read->written.ends.size() == 1U);
  BOOST_TEST(read->written.ends[0].counts.at(arrival) == 3);
  BOOST_TEST(!read->written.ends[0].is_recommended);
  BOOST_TEST(read->written.seconds() == 1.5);
}

BOOST_AUTO_TEST_CASE(a_picture_is_told_in_words_that_follow_its_numbers) {
  io::Panel panel{"Chute", "h", "error", true, true, {{"newton", {0.1, 0.01}, {1e-2, 1e-6}}}};
  BOOST_TEST(alt_text(panel) ==
             "Chute. error over h, both logarithmic; newton falls from 0.01 at 0.1 to 1e-06 at "
             "0.01.");
  panel.curves[0].y = {1e-6, 1e-2};
  BOOST_TEST(contains(alt_text(panel), "newton rises from 1e-06"));
  panel.map = io::Map{{"5"}, {"a", "b"}, {{7}, {std::nan("")}}, {{"7"}, {"S"}}, "iterations"};
  BOOST_TEST(alt_text(panel) ==
             "Chute. map of 1 columns and 2 rows, iterations from 7 to 7, 1 grey cells, mark S 1.");
}

BOOST_AUTO_TEST_SUITE_END()
