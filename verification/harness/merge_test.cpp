// Parts that were run elsewhere: the same report, and nothing is believed that is not whole.
#include "verification/harness/merge.hpp"

#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <sstream>

#include <boost/test/unit_test.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "verification/harness/runner.hpp"

BOOST_AUTO_TEST_SUITE(merge_test)

using namespace talus;
using verification::Chapter;
using verification::Context;
using verification::Kind;
using verification::Part;
using verification::Study;
using verification::Written;
namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("talus_merge_" + std::to_string(getpid()));
  Folder() { fs::create_directory(path); }
  ~Folder() { fs::remove_all(path); }
};

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Part part(const std::string& name) {
  return {name, [name](Chapter& chapter, const Context&) {
            chapter.text("This is " + name + ".");
            chapter.table({"a table", {"a"}, {{name}}});
            chapter.check(Kind::self_consistency, name + " holds", 0.1, 0.1, infinity);
            chapter.check(Kind::self_consistency, name + " fails", std::nan(""), -infinity, 1);
          }};
}

std::vector<Study> studies() {
  return {{"several", "Why?", {part("first"), part("second")}}, {"one", "What?", {part("")}}};
}

// Only the study and part of these numbers.
std::vector<Study> alone(std::size_t study, std::size_t number) {
  Study chosen = studies()[study];
  chosen.parts = {chosen.parts[number]};
  return {chosen};
}

std::vector<Written> run(const std::vector<Study>& chosen, const fs::path& into,
                         bool is_full = false) {
  return verification::run_studies(chosen, {.full = is_full, .jobs = 1}, io::ResultFolder(into),
                                   [](const std::string&, double) {});
}

// All parts, each into a folder of its own within `folder`.
void run_apart(const fs::path& folder) {
  run(alone(0, 0), folder / "a");
  run(alone(0, 1), folder / "b");
  run(alone(1, 0), folder / "c");
}

std::vector<Written> merged(const std::vector<fs::path>& from, const fs::path& into) {
  return verification::merge_studies(studies(), verification::find_parts(studies(), from),
                                     io::ResultFolder(into));
}

// Whether it is refused, with such a reason.
bool is_refused(const std::vector<fs::path>& from, const std::string& reason) {
  try {
    verification::find_parts(studies(), from);
  } catch (const io::UserError& error) {
    return std::string(error.what()).find(reason) != std::string::npos;
  }
  return false;
}

std::string contents_of(const fs::path& file) {
  std::ostringstream contents;
  contents << std::ifstream(file).rdbuf();
  return contents.str();
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(merged_parts_make_the_chapters_and_the_files_of_a_direct_run, Folder) {
  const auto direct = run(studies(), path / "direct");
  run_apart(path / "parts");
  for (const auto& from : {std::vector{path / "parts"},
                           {path / "parts/c", path / "parts/a", path / "parts/b"},
                           {path / "direct"}}) {
    const auto chapters = merged(from, path / "merged");
    BOOST_REQUIRE(chapters.size() == direct.size());
    for (std::size_t i = 0; i < direct.size(); ++i) {
      BOOST_TEST(chapters[i].name == direct[i].name);
      BOOST_TEST(html_of(chapters[i]) == html_of(direct[i]));
      BOOST_TEST(chapters[i].failures() == direct[i].failures());
      BOOST_TEST(chapters[i].held() == direct[i].held());
    }
    for (const std::string file :
         {"several/first/checks.csv", "several/second/table1.csv", "one/chapter.json"})
      BOOST_TEST(fs::exists(path / "merged" / file), file);
    BOOST_TEST(chapters[0].held() == 2U);  // bounds and NaN have come over
    BOOST_TEST(chapters[0].checks.size() == 4U);
  }
}

BOOST_FIXTURE_TEST_CASE(a_part_that_is_missing_is_a_failed_check_and_nothing_older_stands_for_it,
                        Folder) {
  run(studies(), path / "merged");
  run(alone(0, 1), path / "part");
  const auto chapters = merged({path / "part"}, path / "merged");
  BOOST_TEST(chapters[0].failures().find("several/first was not run") != std::string::npos);
  BOOST_TEST(chapters[0].held() == 1U);
  BOOST_TEST(chapters[1].failures().find("one was not run") != std::string::npos);
  BOOST_TEST(!fs::exists(path / "merged/several/first/chapter.json"));
}

BOOST_FIXTURE_TEST_CASE(a_part_that_is_torn_anywhere_is_a_failed_check, Folder) {
  run_apart(path / "parts");
  const fs::path file = path / "parts/b/several/second/chapter.json";
  const std::string whole = contents_of(file);
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    std::ofstream(file) << whole.substr(0, length);
    const auto chapters = merged({path / "parts"}, path / "merged");
    BOOST_TEST(chapters[0].checks.size() == 3U, length);
    BOOST_TEST(chapters[0].failures().find("several/second did not end") != std::string::npos);
    BOOST_TEST(chapters[1].held() == 1U);
  }
}

BOOST_FIXTURE_TEST_CASE(parts_of_a_run_that_was_killed_are_failed_checks, Folder) {
  run(alone(1, 0), path / "parts/c");
  auto killing = studies();
  killing.pop_back();
  killing[0].parts[0].run = [](Chapter&, const Context&) {
    kill(getppid(), SIGKILL);
    pause();
  };
  if (fork() == 0) {
    run(killing, path / "parts/killed");
    _exit(0);
  }
  wait(nullptr);
  const auto chapters = merged({path / "parts"}, path / "merged");
  BOOST_TEST(chapters[0].failures().find("several/first did not end") != std::string::npos);
  BOOST_TEST(chapters[0].failures().find("several/second did not end") != std::string::npos);
  BOOST_TEST(chapters[0].held() == 0U);
  BOOST_TEST(chapters[1].held() == 1U);
}

BOOST_FIXTURE_TEST_CASE(what_would_be_mistaken_for_one_run_is_refused, Folder) {
  run_apart(path / "parts");
  BOOST_TEST(is_refused({path / "nowhere"}, "is no folder"));
  fs::create_directories(path / "empty/several/first");
  BOOST_TEST(is_refused({path / "parts", path / "empty"}, "holds no part"));
  BOOST_TEST(is_refused({path / "parts", path / "parts/a"}, "several/first is there twice"));
  run(alone(1, 0), path / "again");
  BOOST_TEST(is_refused({path / "parts", path / "again"}, "one is there twice"));
  run(alone(1, 0), path / "parts/c", true);
  BOOST_TEST(is_refused({path / "parts"}, "one was run with --full, several/second without"));
  BOOST_TEST(verification::find_parts(studies(), {path / "parts/c"}).is_full);
  BOOST_TEST(!verification::find_parts(studies(), {path / "parts/a"}).is_full);
}

BOOST_AUTO_TEST_SUITE_END()
