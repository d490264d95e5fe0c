// The processes of the studies: side by side, reported in order, none left behind, none believed
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

using namespace talus;
using verification::Chapter;
using verification::Context;
using verification::Study;

struct Folder {
  io::ResultFolder folder{std::filesystem::temp_directory_path() /
                          ("talus_runner_" + std::to_string(getpid()))};
  ~Folder() { std::filesystem::remove_all(folder.path()); }
};

namespace {

const auto silent = [](const std::string&, double) {};

Study good(const std::string& name) {
  return {name, "Why " + name + "?", [name](const Context& context) {
            context.progress(0.5);
            Chapter chapter{name, "Why " + name + "?", {}, {}};
            chapter.check("not a number", std::nan(""), 0, 1);
            chapter.check("good", 1, 0, 2);
            return chapter;
          }};
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
  studies.front().is_timing = true;
  double last = 0;
  const auto written = verification::run_studies(
      studies, {}, folder, [&](const std::string&, double fraction) { last = fraction; });
  BOOST_REQUIRE(written.size() == 3U);
  for (std::size_t i = 0; i < studies.size(); ++i) {
    BOOST_TEST(written[i].name == studies[i].name);
    BOOST_TEST(written[i].held == 1U);
    BOOST_TEST(written[i].checks == 2U);
    BOOST_TEST(written[i].failures.find("not a number") != std::string::npos);
  }
  BOOST_TEST(last > 0);
}

BOOST_FIXTURE_TEST_CASE(a_study_that_does_not_end_is_a_failed_check_and_the_others_are_written,
                        Folder) {
  const auto killed_by = [](int signal) {
    return [signal](const Context&) -> Chapter {
      raise(signal);
      return {};
    };
  };
  const std::vector<Study> studies = {
      {"killed", "Is it?", killed_by(SIGKILL)},
      {"crashing", "Does it?", killed_by(SIGSEGV)},
      {"throwing", "Does it?",
       [](const Context&) -> Chapter { throw std::runtime_error("no mesh"); }},
      {"unwritable", "Is it?", [](const Context&) -> Chapter { throw io::UserError("full disk"); }},
      {"leaving", "Does it?", [](const Context&) -> Chapter { _exit(7); }},
      {"silent", "Is it?", [](const Context&) -> Chapter { _exit(0); }},
      good("good")};
  const auto written = verification::run_studies(studies, {}, folder, silent);
  const std::vector<std::string> reasons = {
      "killed by signal 9", "killed by signal 11", "no mesh",
      "full disk",          "exit status 7",       "it left no chapter"};
  BOOST_REQUIRE(written.size() == studies.size());
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    BOOST_TEST(!written[i].passed(), studies[i].name);
    BOOST_TEST(written[i].failures.find("study did not end: " + reasons[i]) != std::string::npos,
               written[i].failures);
    BOOST_TEST(written[i].html.find(reasons[i]) != std::string::npos);
    BOOST_TEST(std::filesystem::exists(folder.path() / studies[i].name / "checks.csv"));
  }
  BOOST_TEST(written.back().held == 1U);
  BOOST_TEST(waitpid(-1, nullptr, WNOHANG) == -1);  // nobody is left
}

BOOST_FIXTURE_TEST_CASE(an_older_chapter_is_not_read_as_this_runs, Folder) {
  verification::run_studies({good("study")}, {}, folder, silent);
  std::ofstream(folder.path() / "study" / "notes.txt") << "of the user";
  Study dead = good("study");
  dead.run = [](const Context&) -> Chapter { _exit(0); };
  const auto written = verification::run_studies({dead}, {}, folder, silent);
  BOOST_TEST(written[0].held == 0U);
  BOOST_TEST(std::filesystem::exists(folder.path() / "study" / "notes.txt"));
}

BOOST_FIXTURE_TEST_CASE(no_study_outlives_a_run_that_is_killed, Folder) {
  // The study tells its number; its grandparent, this test, adopts it if it is left behind.
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  for (const int signal : {SIGTERM, SIGINT, SIGKILL}) {
    const auto number = folder.path() / "number";
    std::filesystem::remove(number);
    const pid_t run = fork();
    if (run == 0) {
      std::signal(signal, SIG_DFL);  // a background shell ignores SIGINT
      const Study endless{"endless", "Is it?", [&](const Context&) -> Chapter {
                            folder.write("number", std::to_string(getpid()));
                            for (;;) pause();
                          }};
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
    Study study = good("study");
    study.minutes = {minutes, 10 * minutes};
    study.is_timing = is_timing;
    return study;
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
