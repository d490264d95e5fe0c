// Does a path go on from a checkpoint exactly where it stood?
#include "common/program/checkpoint.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <boost/test/unit_test.hpp>
#include <unistd.h>

BOOST_AUTO_TEST_SUITE(checkpoint_test)

using namespace talus;
using State = solve::CompensatedVector;

namespace {

// A folder that is gone at the end.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("checkpoint_test_" + std::to_string(getpid()));
  ~Folder() { std::filesystem::remove_all(path); }
};

std::string contents_of(const std::filesystem::path& file) {
  std::ostringstream contents;
  contents << std::ifstream(file, std::ios::binary).rdbuf();
  return contents.str();
}

// What is kept in the folder is refused, in one line that says what to do.
void check_refused(const io::ResultFolder& results, const std::string& contents) {
  results.write("broken", contents);
  const auto is_one_line = [](const io::UserError& error) {
    const std::string what = error.what();
    return what.starts_with("--resume: ") && what.find("remove it") != std::string::npos &&
           what.find('\n') == std::string::npos;
  };
  BOOST_CHECK_EXCEPTION(program::read_checkpoint(results.path() / "broken"), io::UserError,
                        is_one_line);
}

program::Checkpoint sample(Eigen::Index size) {
  const Eigen::VectorXd value = Eigen::VectorXd::LinSpaced(size, -1, 2) / 3,
                        correction = 1e-17 * value;
  return {{{"stage", "loading"}},
          {State(value, correction), 0.1 / 3, -1, 1e-3 / 7, -1, State(correction, value)},
          {0.1, -2.0 / 3, 1e-300}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_checkpoint_returns_bit_by_bit) {
  const Folder folder;
  const io::ResultFolder results(folder.path);
  program::Checkpoint written = sample(50);
  for (const bool has_all : {true, false}) {
    if (!has_all) written.start.secant.reset(), written.carried_stress.clear();
    program::write_checkpoint(results, "state", written);
    const auto read = program::read_checkpoint(folder.path / "state");
    BOOST_REQUIRE(read.has_value());
    BOOST_TEST((read->notes == written.notes));
    const auto &a = read->start, &b = written.start;
    BOOST_TEST(
        (a.state.value() == b.state.value() && a.state.correction() == b.state.correction()));
    BOOST_TEST((a.parameter == b.parameter && a.step == b.step));
    BOOST_TEST((a.direction == -1 && a.reference_sign == -1));
    BOOST_REQUIRE(a.secant.has_value() == has_all);
    if (has_all) BOOST_TEST((a.secant->value() == b.secant->value()));
    BOOST_TEST(read->carried_stress == written.carried_stress);
  }
  BOOST_TEST(!program::read_checkpoint(folder.path / "nothing").has_value());
}

BOOST_AUTO_TEST_CASE(a_checkpoint_with_a_bit_flipped_a_byte_lost_or_a_block_moved_is_refused) {
  const Folder folder;
  const io::ResultFolder results(folder.path);
  program::write_checkpoint(results, "state", sample(4));
  const std::string whole = contents_of(folder.path / "state");
  for (std::size_t byte = 0; byte < whole.size(); ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string flipped = whole;
      flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << bit));
      check_refused(results, flipped);
    }
    check_refused(results, whole.substr(0, byte));
    check_refused(results, whole.substr(0, byte) + "0" + whole.substr(byte));
  }
  const std::size_t numbers = whole.size() - 8 * (4 * 4 + 3);
  for (std::size_t block = numbers; block + 16 <= whole.size(); block += 8)
    check_refused(results, whole.substr(0, block) + whole.substr(block + 8, 8) +
                               whole.substr(block, 8) + whole.substr(block + 16));
  for (const char* text : {"", "x", "no JSON\n", "{\"size\": 50}\n"}) check_refused(results, text);
}

BOOST_AUTO_TEST_CASE(a_checkpoint_with_a_number_that_is_not_finite_is_refused) {
  const Folder folder;
  const io::ResultFolder results(folder.path);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (int place = 0; place < 4; ++place) {
      program::Checkpoint written = sample(4);
      Eigen::VectorXd spoilt = Eigen::VectorXd::Ones(4);
      spoilt[2] = bad;
      if (place == 0) written.start.state = State(spoilt, Eigen::VectorXd::Zero(4));
      if (place == 1) written.start.secant = State(Eigen::VectorXd::Zero(4), spoilt);
      if (place == 2) written.carried_stress.back() = bad;
      if (place == 3) written.start.step = bad;
      program::write_checkpoint(results, "state", written);
      check_refused(results, contents_of(folder.path / "state"));
    }
}

BOOST_AUTO_TEST_SUITE_END()
