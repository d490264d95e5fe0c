// The harness itself: does it fail where it should?
#include <cmath>
#include <csignal>
#include <limits>
#include <set>
#include <thread>

#include <boost/test/unit_test.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "verification/fit.hpp"
#include "verification/html_report.hpp"
#include "verification/methods.hpp"
#include "verification/runner.hpp"

using namespace talus;
using verification::Chapter;

namespace {

int failures(const Chapter& chapter) {
  int count = 0;
  for (const auto& check : chapter.checks) count += check.passed() ? 0 : 1;
  return count;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_check_keeps_both_bounds_and_nan_keeps_none) {
  Chapter chapter;
  chapter.check("inside", 2, 1, 3);
  BOOST_TEST(chapter.passed());
  for (const double outside : {0.9, 3.1, std::numeric_limits<double>::quiet_NaN()}) {
    Chapter other = chapter;
    other.check("outside", outside, 1, 3);
    BOOST_TEST(!other.passed());
  }
}

BOOST_AUTO_TEST_CASE(the_fitted_order_of_a_power_law_is_its_exponent) {
  std::vector<double> h, error;
  for (int k = 0; k < 5; ++k) {
    h.push_back(std::pow(0.5, k));
    error.push_back(7 * std::pow(h.back(), 2.5));
  }
  BOOST_TEST(verification::fitted_order(h, error) == 2.5, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::isnan(verification::fitted_order({1}, {1})));
}

BOOST_AUTO_TEST_CASE(studies_have_names_of_their_own_and_a_question) {
  std::set<std::string> names;
  for (const auto& study : verification::studies()) {
    names.insert(study.name);
    BOOST_TEST(study.question.back() == '?');
  }
  BOOST_TEST(names.size() == verification::studies().size());
}

BOOST_AUTO_TEST_CASE(the_jacobian_study_holds) {
  BOOST_TEST(failures(verification::jacobian_study({})) == 0);
}

BOOST_AUTO_TEST_CASE(the_orders_of_all_scenes_hold) {
  BOOST_TEST(failures(verification::orders_study({})) == 0);
}

BOOST_AUTO_TEST_CASE(the_rungs_of_the_ladder_agree) {
  BOOST_TEST(failures(verification::ladder_study({})) == 0);
}

// Negative controls of the orders study: each breaks one thing it rests on.
BOOST_AUTO_TEST_CASE(a_wrong_exact_solution_destroys_the_orders) {
  for (oned::ShearScene scene : oned::scenes()) {
    const auto right = scene.exact_velocity;
    scene.exact_velocity = [right](double x) { return (1 + 1e-4) * right(x); };
    BOOST_TEST(failures(verification::orders_of({scene}, {})) > 0, scene.name);
  }
}

BOOST_AUTO_TEST_CASE(a_wrong_pressure_destroys_the_orders) {
  for (oned::ShearScene scene : oned::scenes()) {
    const auto right = scene.pressure;
    scene.pressure = [right](double x) { return (1 + 1e-4) * right(x); };
    BOOST_TEST(failures(verification::orders_of({scene}, {})) > 0, scene.name);
  }
}

BOOST_AUTO_TEST_CASE(an_order_half_off_is_rejected) {
  for (oned::ShearScene scene : oned::scenes()) {
    for (auto& each : scene.order_cases)
      if (each.expected) each.expected->l2 += 0.5;
    BOOST_TEST(failures(verification::orders_of({scene}, {})) > 0, scene.name);
  }
}

BOOST_AUTO_TEST_CASE(the_report_shows_failures_and_escapes_text) {
  Chapter chapter{"name", "Is a < b?", {}, {}};
  chapter.text("x & y");
  chapter.check("good", 1, 0, 2);
  const auto html = [&] {
    return verification::html_report({verification::write_chapter(chapter, "no such folder")},
                                     "./run verify");
  };
  BOOST_TEST(html().find("Every check holds.") != std::string::npos);
  BOOST_TEST(html().find("Is a &lt; b?") != std::string::npos);
  BOOST_TEST(html().find("x &amp; y") != std::string::npos);
  chapter.check("bad", 3, 0, 2);
  BOOST_TEST(html().find("Some checks do not hold.") != std::string::npos);
  BOOST_TEST(html().find("fail>FAILS") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(studies_run_side_by_side_and_are_reported_in_their_order) {
  std::vector<verification::Study> studies;
  for (const std::string name : {"first", "second", "third"})
    studies.push_back({name, "Why " + name + "?", [name](const verification::Context& context) {
                         context.progress(0.5);
                         Chapter chapter{name, "Why " + name + "?", {}, {}};
                         chapter.check("not a number", std::nan(""), 0, 1);
                         chapter.check("good", 1, 0, 2);
                         return chapter;
                       }});
  studies.front().is_timing = true;
  const io::ResultFolder folder(std::filesystem::temp_directory_path() / "talus_studies");
  double last = 0;
  const auto written = verification::run_studies(
      studies, false, folder, [&](const std::string&, double fraction) { last = fraction; });
  BOOST_REQUIRE(written.size() == 3U);
  for (std::size_t i = 0; i < studies.size(); ++i) {
    BOOST_TEST(written[i].name == studies[i].name);
    BOOST_TEST(written[i].held == 1U);
    BOOST_TEST(written[i].checks == 2U);
    BOOST_TEST(written[i].failures.find("not a number") != std::string::npos);
  }
  BOOST_TEST(last > 0);
  std::filesystem::remove_all(folder.path());
}

BOOST_AUTO_TEST_CASE(a_study_that_dies_is_an_error) {
  const verification::Study dying{"dying", "", [](const verification::Context&) -> Chapter {
                                    raise(SIGKILL);
                                    return {};
                                  }};
  const verification::Study throwing{"throwing", "", [](const verification::Context&) -> Chapter {
                                       throw std::runtime_error("no");
                                     }};
  const io::ResultFolder folder(std::filesystem::temp_directory_path() / "talus_dying_studies");
  const verification::Study endless{"endless", "", [](const verification::Context&) -> Chapter {
                                      for (;;) pause();
                                    }};
  const verification::Study unwritable{
      "unwritable", "",
      [](const verification::Context&) -> Chapter { throw io::UserError("full disk"); }};
  const auto silent = [](const std::string&, double) {};
  for (const auto& study : {dying, throwing})
    BOOST_CHECK_THROW(verification::run_studies({study}, false, folder, silent),
                      std::runtime_error);
  BOOST_CHECK_THROW(verification::run_studies({unwritable}, false, folder, silent), io::UserError);
  if (std::thread::hardware_concurrency() > 1)
    BOOST_CHECK_THROW(verification::run_studies({endless, dying}, false, folder, silent),
                      std::runtime_error);
  BOOST_TEST(waitpid(-1, nullptr, WNOHANG) == -1);  // nobody is left
  std::filesystem::remove_all(folder.path());
}

BOOST_AUTO_TEST_CASE(a_figure_without_its_picture_is_reported_as_skipped) {
  Chapter chapter{"name", "title", {}, {}};
  chapter.figure({"missing", "caption", {}, 1});
  const std::string html = verification::write_chapter(chapter, "no such folder").html;
  BOOST_TEST(html.find("Skipped: gnuplot drew no figure.") != std::string::npos);
}
