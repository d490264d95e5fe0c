// The processes of the parts: side by side, reported in order, none left behind, none believed
// that did not end.
#include "verification/harness/runner.hpp"

#include <cmath>
#include <csignal>
#include <fstream>
#include <thread>

#include <boost/test/unit_test.hpp>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "verification/harness/chapter_file.hpp"

BOOST_AUTO_TEST_SUITE(runner_test)

using namespace talus;
using verification::Chapter;
using verification::Context;
using verification::Kind;
using verification::Part;
using verification::Study;

struct Folder {
  io::ResultFolder folder{std::filesystem::temp_directory_path() /
                          ("talus_runner_" + std::to_string(getpid()))};
  ~Folder() { std::filesystem::remove_all(folder.path()); }
};

namespace {

const auto silent = [](const std::string&, double) {};

// A study that is one part.
Study study_of(const std::string& name, const std::function<void(Chapter&, const Context&)>& run) {
  return {name, "Why " + name + "?", {{"", run}}};
}

void add_good(Chapter& chapter, const Context& context) {
  context.progress(0.5);
  chapter.check(Kind::self_consistency, "not a number", std::nan(""), 0, 1);
  chapter.check(Kind::self_consistency, "good", 1, 0, 2);
}

Study good(const std::string& name) {
  return study_of(name, add_good);
}

bool is_alive(pid_t process) {
  return kill(process, 0) == 0;
}

// Whether it holds within some seconds.
template <class Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 500; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(studies_run_side_by_side_and_are_reported_in_their_order, Folder) {
  std::vector<Study> studies = {good("first"), good("second"), good("third")};
  studies.front().parts.front().is_timing = true;
  double last = 0;
  const auto written = verification::run_studies(
      studies, {}, folder, [&](const std::string&, double fraction) { last = fraction; });
  BOOST_REQUIRE(written.size() == 3U);
  for (std::size_t i = 0; i < studies.size(); ++i) {
    BOOST_TEST(written[i].name == studies[i].name);
    BOOST_TEST(written[i].held() == 1U);
    BOOST_TEST(written[i].checks.size() == 2U);
    BOOST_TEST(written[i].failures().find("not a number") != std::string::npos);
  }
  BOOST_TEST(last > 0);
}

BOOST_FIXTURE_TEST_CASE(parts_are_reported_in_their_order_whatever_order_they_run_in, Folder) {
  const auto part = [](const std::string& name, double minutes, bool is_timing) {
    return Part{name,
                [name](Chapter& chapter, const Context&) {
                  chapter.text("This is " + name + ".");
                  chapter.check(Kind::self_consistency, name, 1, 0, 2);
                },
                {minutes, minutes},
                is_timing};
  };
  const Study study{
      "study", "Why?", {part("timing", 1, true), part("short", 1, false), part("long", 2, false)}};
  const auto written = verification::run_studies({study}, {.jobs = 1}, folder, silent);
  BOOST_REQUIRE(written.size() == 1U);
  BOOST_REQUIRE(written[0].checks.size() == 3U);
  std::size_t at = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string& name = study.parts[i].name;
    BOOST_TEST(written[0].checks[i].what == name);
    const std::size_t next = written[0].body.find("This is " + name);
    BOOST_TEST(next != std::string::npos);
    BOOST_TEST(next >= at);
    at = next;
    BOOST_TEST(std::filesystem::exists(folder.path() / "study" / name / "checks.csv"));
  }
}

BOOST_FIXTURE_TEST_CASE(a_part_that_does_not_end_is_a_failed_check_and_the_others_are_written,
                        Folder) {
  const auto killed_by = [](int signal) {
    return [signal](Chapter&, const Context&) { raise(signal); };
  };
  const std::vector<Study> studies = {
      study_of("killed", killed_by(SIGKILL)),
      study_of("crashing", killed_by(SIGSEGV)),
      study_of("throwing", [](Chapter&, const Context&) { throw std::runtime_error("no mesh"); }),
      study_of("unwritable", [](Chapter&, const Context&) { throw io::UserError("full disk"); }),
      study_of("leaving", [](Chapter&, const Context&) { _exit(7); }),
      study_of("silent", [](Chapter&, const Context&) { _exit(0); }),
      good("good")};
  const auto written = verification::run_studies(studies, {}, folder, silent);
  const std::vector<std::string> reasons = {
      "killed by signal 9", "killed by signal 11", "no mesh",
      "full disk",          "exit status 7",       "it left no chapter"};
  BOOST_REQUIRE(written.size() == studies.size());
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    BOOST_TEST(!written[i].passed(), studies[i].name);
    BOOST_TEST(written[i].failures().find(studies[i].name + " did not end: " + reasons[i]) !=
                   std::string::npos,
               written[i].failures());
    BOOST_TEST(verification::html_of(written[i]).find(reasons[i]) != std::string::npos);
    BOOST_TEST(std::filesystem::exists(folder.path() / studies[i].name / "checks.csv"));
  }
  BOOST_TEST(written.back().held() == 1U);
  BOOST_TEST(waitpid(-1, nullptr, WNOHANG) == -1);  // nobody is left
}

BOOST_FIXTURE_TEST_CASE(an_older_chapter_is_not_read_as_this_runs, Folder) {
  verification::run_studies({good("study")}, {}, folder, silent);
  std::ofstream(folder.path() / "study" / "notes.txt") << "of the user";
  const Study dead = study_of("study", [](Chapter&, const Context&) { _exit(0); });
  const auto written = verification::run_studies({dead}, {}, folder, silent);
  BOOST_TEST(written[0].held() == 0U);
  BOOST_TEST(std::filesystem::exists(folder.path() / "study" / "notes.txt"));
}

BOOST_FIXTURE_TEST_CASE(no_part_outlives_a_run_that_is_killed, Folder) {
  // The part tells its number; its grandparent, this test, adopts it if it is left behind.
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
    const auto number = folder.path() / "number";
    std::filesystem::remove(number);
    const pid_t run = fork();
    if (run == 0) {
      std::signal(signal, SIG_DFL);  // a background shell ignores SIGINT
      const Study endless = study_of("endless", [&](Chapter&, const Context&) {
        folder.write("number", std::to_string(getpid()));
        for (;;) pause();
      });
      try {
        verification::run_studies({endless}, {}, folder, silent);
      } catch (...) {
      }
      _exit(0);
    }
    BOOST_REQUIRE(comes_true([&] { return std::filesystem::exists(number); }));
    pid_t study = 0;
    std::ifstream(number) >> study;
    BOOST_REQUIRE(study > 0);
    BOOST_TEST(is_alive(study));
    kill(run, signal);
    waitpid(run, nullptr, 0);
    BOOST_TEST(comes_true([&] {
      waitpid(study, nullptr, WNOHANG);
      return !is_alive(study);
    }));
    if (is_alive(study)) kill(study, SIGKILL);
  }
  prctl(PR_SET_CHILD_SUBREAPER, 0);
}

BOOST_AUTO_TEST_CASE(the_expected_time_is_that_of_the_schedule) {
  const auto lasting = [](double minutes, bool is_timing) {
    return Study{"study", "Why?", {{"", add_good, {minutes, 10 * minutes}, is_timing}}};
  };
  const std::vector<Study> studies = {lasting(1, false), lasting(2, true), lasting(1, false),
                                      lasting(3, false)};
  using boost::test_tools::tolerance;
  BOOST_TEST(verification::expected_minutes(studies, {.jobs = 1}) == 7, tolerance(1e-12));
  // Three beside one and one, then the one that measures time.
  BOOST_TEST(verification::expected_minutes(studies, {.jobs = 2}) == 5, tolerance(1e-12));
  BOOST_TEST(verification::expected_minutes(studies, {.full = true, .jobs = 2}) == 50,
             tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
