// Is a case what decides it, whatever the words, and is what it is measured against what was asked?
#include <fstream>

#include <boost/test/unit_test.hpp>

#include "common/io/options.hpp"
#include "common/scene/case.hpp"
#include "common/scene/reference.hpp"
#include "common/testing/temporary_folder.hpp"

BOOST_AUTO_TEST_SUITE(scene_test)

using namespace talus;
using nlohmann::json;
using talus::testing::contents_of;
using talus::testing::TemporaryFolder;

namespace {

const scene::Description description{.name = "made-up",
                                     .title = "a made-up scene",
                                     .models = {"line"},
                                     .mesh_option = "--elements",
                                     .problem_options = {},
                                     .main_quantity = "flow",
                                     .quantities = {{"flow", "m", "how much"}}};

// What a run of a made-up program with these words leaves; solved so many times.
struct Run {
  int code = 0, solved = 0;
  json record;
};

Run run_with(std::vector<std::string> words, const json& results = {{"flow", 2.0}}) {
  io::CommandLine line{"", "made-up"};
  double lambda = 1e-6;
  int elements = 40;
  std::string output = "out";
  bool plot = false, checks = false;
  io::add_real(line, "--lambda-r", lambda, "", 1e-12, 1);
  io::add_integer(line, "--elements", elements, "", 1, 100);
  io::add_text(line, "--output", output, "");
  io::add_flag(line, "--plot", plot, "");
  io::add_flag(line, "--check-jacobian", checks, "");
  scene::Case a_case(line, description);
  words.insert(words.begin(), "made-up");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  Run run;
  run.code = a_case.run_program(static_cast<int>(words.size()), pointers.data(), [&] {
    if (a_case.is_dry_run()) return 0;
    const io::ResultFolder folder = a_case.folder(output);
    a_case.timed([&] { return ++run.solved; });
    run.record = {{"scene", "made-up"}, {"status", "converged"}, {"results", results}};
    a_case.complete(run.record);
    folder.write("summary.json", run.record.dump());
    a_case.write(run.record);
    return 0;
  });
  return run;
}

bool refuses(const std::string& text, const std::string& why) {
  try {
    scene::reference_values(text);
  } catch (const io::UserError& error) {
    return std::string(error.what()).find(why) != std::string::npos;
  }
  return false;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_case_is_named_by_what_decides_it_however_it_is_written) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "record.json", out = folder.path() / "out";
  const auto name = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--record", file});
    return run_with(words).record.at("case");
  };
  const json plain = name({});
  BOOST_TEST(name({"--lambda-r", "0.000001"}) == plain);
  BOOST_TEST(name({"--elements", "040", "--lambda-r", "1e-6"}) == plain);
  BOOST_TEST(name({"--output", out}) == plain);
  BOOST_TEST(name({"--repeat", "3"}) == plain);
  BOOST_TEST(name({"--elements", "41"}) != plain);
  BOOST_TEST(name({"--lambda-r", "1e-7"}) != plain);
}

BOOST_AUTO_TEST_CASE(a_record_is_one_line_and_comes_alone_unless_more_is_asked_for) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "new" / "record.json";
  const std::filesystem::path out = folder.path() / "out";
  const Run run = run_with({"--record", file.string(), "--elements", "7"});
  const std::string text = contents_of(file);
  BOOST_TEST(std::ranges::count(text, '\n') == 1);
  BOOST_TEST(json::parse(text) == run.record);
  BOOST_TEST(run.record.at("command") == "./run made-up --elements 7");
  BOOST_TEST(run.record.at("options").at("lambda-r") == "1e-06");
  BOOST_TEST(run.record.at("units").at("flow") == "m");
  BOOST_TEST(run.record.at("cpu_seconds").get<double>() >= 0);
  BOOST_TEST(run.record.at("peak_memory").get<double>() > 0);
  BOOST_TEST(!std::filesystem::exists("out"));
  run_with({"--record", file.string(), "--output", out.string()});
  BOOST_TEST(std::filesystem::exists(out / "summary.json"));
  BOOST_TEST(run_with({"--output", out.string(), "--repeat", "3"}).solved == 3);
  BOOST_TEST(run_with({"--record", file.string()}).solved > 1);  // of no time: it is repeated
}

BOOST_AUTO_TEST_CASE(a_record_that_cannot_be_written_is_refused_before_anything_is_solved) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "file";
  std::ofstream(file) << "kept";
  for (const std::string& place : {folder.path().string(), file + "/below.json"}) {
    const Run run = run_with({"--record", place});
    BOOST_TEST(run.code == 2, place);
    BOOST_TEST(run.solved == 0, place);
  }
  BOOST_TEST(contents_of(file) == "kept");
}

BOOST_AUTO_TEST_CASE(a_jacobian_check_has_no_record) {
  BOOST_TEST(run_with({"--check-jacobian", "--record", "nowhere.json"}).code == 2);
  BOOST_TEST(run_with({"--check-jacobian", "--repeat", "2"}).code == 2);
  BOOST_TEST(run_with({"--check-jacobian", "--dry-run"}).code == 0);
}

BOOST_AUTO_TEST_CASE(a_dry_run_solves_and_writes_nothing) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "record.json";
  const Run run = run_with({"--dry-run", "--record", file.string()});
  BOOST_TEST(run.code == 0);
  BOOST_TEST(run.solved == 0);
  BOOST_TEST(!std::filesystem::exists(file));
  BOOST_TEST(run_with({"--dry-run", "--elements", "0"}).code == 2);
}

BOOST_AUTO_TEST_CASE(a_result_that_the_scene_does_not_describe_is_no_result) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "record.json";
  BOOST_TEST(run_with({"--record", file}, {{"flow", 1}, {"secret", 1}}).code == 1);
  BOOST_TEST(run_with({"--record", file}, {{"flow", 1}}).code == 0);
}

BOOST_AUTO_TEST_CASE(errors_are_relative_to_the_reference_that_was_named) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "record.json", fine = folder.path() / "fine.json";
  const auto error = [&](const std::string& reference) {
    return run_with({"--record", file, "--reference", reference})
        .record.at("results")
        .at("error_flow")
        .get<double>();
  };
  std::ofstream(fine) << R"({"status": "converged", "results": {"flow": 1.6, "other": 1}})";
  BOOST_TEST(std::abs(error(fine) - 0.25) < 1e-15);
  BOOST_TEST(std::abs(error("flow=4") - 0.5) < 1e-15);
  BOOST_TEST(std::abs(error("other=1,flow=2.5") - 0.2) < 1e-15);
  BOOST_TEST(error("flow=0") == 2);  // nothing to be relative to
  BOOST_TEST(run_with({"--record", file, "--reference", "other=1"}).code == 2);
}

BOOST_AUTO_TEST_CASE(a_reference_that_is_none_is_refused_by_name) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "reference.json";
  const auto put = [&](const char* text) { std::ofstream(file) << text; };
  BOOST_TEST(refuses("nowhere.json", "NAME=VALUE"));
  BOOST_TEST(refuses("flow=", "--reference"));
  BOOST_TEST(refuses("flow=nan", "--reference"));
  BOOST_TEST(refuses("=1", "NAME=VALUE"));
  put("{");
  BOOST_TEST(refuses(file, "no record"));
  put("[1, 2]");
  BOOST_TEST(refuses(file, "no record"));
  put(R"({"status": "stagnated", "results": {}})");
  BOOST_TEST(refuses(file, "stagnated"));
  put(R"({"status": "converged", "results": {"flow": 1}})");
  BOOST_TEST(scene::reference_values(file).at("flow") == 1);
}

BOOST_AUTO_TEST_CASE(of_a_reference_numbers_are_compared_and_its_own_errors_are_not) {
  const json known = {{"flow", 2.0}, {"error_l2", 0.1}, {"mesh", 7}, {"other", 1}};
  const json errors =
      scene::errors_against(known, {{"flow", 2.5}, {"error_l2", 0.2}, {"mesh", "7x7"}});
  BOOST_TEST(errors.size() == 1);
  BOOST_TEST(errors.at("error_flow") == 0.25);
}

BOOST_AUTO_TEST_SUITE_END()
