// Does a folder hold one run, all of it and nothing older, whatever becomes of gnuplot?
#include "common/io/result_folder.hpp"

#include <fstream>
#include <set>

#include <boost/test/unit_test.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "common/io/figure.hpp"
#include "common/testing/temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(result_folder_test)

using namespace talus::io;
using talus::testing::contents_of;
using talus::testing::TemporaryFolder;

namespace {

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

void put(const std::filesystem::path& file, const std::string& contents = "old") {
  std::ofstream(file) << contents;
}

bool says(const std::exception& error, const std::string& text) {
  return std::string(error.what()).find(text) != std::string::npos;
}

const Figure one_panel{
    "figure", "", {{"speed", "h", "error", false, false, {{"one", {1, 2}, {3, 4}}}}}, 1};

// Runs what a shell script called gnuplot does instead of gnuplot.
class WithGnuplot {
 public:
  explicit WithGnuplot(const std::string& commands) : path_(std::getenv("PATH")) {
    put(folder_.path() / "gnuplot", "#!/bin/sh\n" + commands + "\n");
    std::filesystem::permissions(folder_.path() / "gnuplot", std::filesystem::perms::owner_all);
    setenv("PATH", (folder_.path().string() + ":/usr/bin:/bin").c_str(), 1);
  }
  ~WithGnuplot() { setenv("PATH", path_.c_str(), 1); }
  WithGnuplot(const WithGnuplot&) = delete;
  WithGnuplot& operator=(const WithGnuplot&) = delete;

 private:
  TemporaryFolder folder_;
  std::string path_;
};

// Of one figure in a folder that has an older picture; what is left there in `left`.
std::string failure_with(const std::string& commands, std::set<std::string>* left = nullptr) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  put(folder.path() / "figure.svg");
  const WithGnuplot gnuplot(commands);
  const std::string failure =
      write_figure(folder, one_panel, "svg", std::chrono::milliseconds(300));
  if (left) *left = names_in(folder.path());
  return failure;
}

const std::set<std::string> no_picture = {"figure.dat", "figure.gp"};

}  // namespace

BOOST_AUTO_TEST_CASE(a_folder_in_use_is_refused_and_free_once_its_run_has_ended) {
  const TemporaryFolder temporary;
  const auto is_held = [](const UserError& error) {
    return says(error, "--output") && says(error, "another run");
  };
  {
    const ResultFolder first(temporary.path());
    BOOST_CHECK_EXCEPTION(ResultFolder{temporary.path()}, UserError, is_held);
    BOOST_CHECK_NO_THROW(ResultFolder{temporary.path() / "below"});
  }
  BOOST_CHECK_NO_THROW(ResultFolder{temporary.path()});

  int ready[2];
  BOOST_REQUIRE(pipe(ready) == 0);
  const pid_t other = fork();
  if (other == 0) {
    const ResultFolder held(temporary.path());
    [[maybe_unused]] const ssize_t sent = write(ready[1], "x", 1);
    pause();
    _exit(0);
  }
  char byte = 0;
  BOOST_REQUIRE(read(ready[0], &byte, 1) == 1);
  BOOST_CHECK_EXCEPTION(ResultFolder{temporary.path()}, UserError, is_held);
  kill(other, SIGKILL);
  waitpid(other, nullptr, 0);
  BOOST_CHECK_NO_THROW(ResultFolder{temporary.path()});
}

BOOST_AUTO_TEST_CASE(what_an_earlier_run_left_goes_and_what_is_foreign_stays) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  for (const char* name :
       {"summary.json", ".summary.json.part", "flow_0001.vtu", ".flow_0002.vtu.part", "flow_x.vtu",
        "notes.txt", ".notes.txt.part", "summary.json.bak", ".summary.json", "my summary.json"})
    put(folder.path() / name);
  std::filesystem::create_directory(folder.path() / "path.csv");
  folder.remove_older({"summary.json", "flow_[0-9][0-9][0-9][0-9].vtu", "path.csv", "absent"});
  const std::set<std::string> foreign = {"flow_x.vtu",       "notes.txt",     ".notes.txt.part",
                                         "summary.json.bak", ".summary.json", "my summary.json",
                                         "path.csv"};
  BOOST_TEST(names_in(folder.path()) == foreign, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_file_whose_name_a_folder_has_is_the_user_s_error_and_leaves_no_part) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  std::filesystem::create_directory(folder.path() / "a.txt");
  BOOST_CHECK_EXCEPTION(folder.write("a.txt", "text"), UserError,
                        [](const UserError& error) { return says(error, "a.txt"); });
  BOOST_TEST(names_in(folder.path()) == std::set<std::string>{"a.txt"},
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_full_disk_leaves_no_torn_file) {
  const TemporaryFolder temporary;
  const ResultFolder folder(temporary.path());
  std::filesystem::create_symlink("/dev/full", folder.path() / ".a.txt.part");
  BOOST_CHECK_THROW(folder.write("a.txt", std::string(100000, 'x')), UserError);
  BOOST_TEST(names_in(folder.path()).empty());
}

BOOST_AUTO_TEST_CASE(gnuplot_that_fails_says_why_and_leaves_no_older_picture) {
  std::set<std::string> left;
  const auto leaves = [&](const std::string& commands) { return failure_with(commands, &left); };
  BOOST_TEST(leaves("echo >&2; echo 'no terminal' >&2; exit 3") == "gnuplot failed: no terminal");
  BOOST_TEST(left == no_picture, boost::test_tools::per_element());
  BOOST_TEST(leaves("printf '\\nplot x\\n  ^\\n  line 3: bad\\n' >&2; exit 1") ==
             "gnuplot failed: line 3: bad");
  BOOST_TEST(leaves("exit 1") == "gnuplot failed");
  BOOST_TEST(leaves("kill -9 $$") == "gnuplot failed");
  for (const std::string commands : {"cat >/dev/null", "echo hello", "echo '<svg>'; echo '<g>'"})
    BOOST_TEST(leaves(commands) == "gnuplot drew no whole picture");
  BOOST_TEST(left == no_picture, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(gnuplot_that_hangs_is_killed_with_what_it_started) {
  std::set<std::string> left;
  BOOST_TEST(failure_with("echo '<svg>'; sleep 600 & sleep 600", &left) ==
             "gnuplot took longer than 0.3 s");
  BOOST_TEST(left == no_picture, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_missing_gnuplot_is_told_from_one_that_fails) {
  const TemporaryFolder temporary, empty;
  const ResultFolder folder(temporary.path());
  const std::string path = std::getenv("PATH");
  setenv("PATH", empty.path().c_str(), 1);
  const std::string said = draw(folder, {one_panel});
  setenv("PATH", path.c_str(), 1);
  BOOST_TEST(said == " (no figure.png: gnuplot is missing)");
}

BOOST_AUTO_TEST_CASE(a_picture_gets_its_name_when_it_is_whole) {
  std::set<std::string> left;
  const std::string draws =
      "ls -A | grep svg >seen; grep '^set output' >asked; echo '<svg>'; echo '</svg>'; "
      "echo 'only a warning' >&2";
  BOOST_TEST(failure_with(draws, &left).empty());
  const std::set<std::string> all = {"asked", "figure.dat", "figure.gp", "figure.svg", "seen"};
  BOOST_TEST(left == all, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
