// Does a path go on from a checkpoint exactly where it stood?
#include "common/program/checkpoint.hpp"

#include <fstream>
#include <sstream>

#include <boost/test/unit_test.hpp>
#include <unistd.h>

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

}  // namespace

BOOST_AUTO_TEST_CASE(a_checkpoint_returns_bit_by_bit_and_a_broken_one_is_refused) {
  const Folder folder;
  const io::ResultFolder results(folder.path);
  Eigen::VectorXd value = Eigen::VectorXd::LinSpaced(50, -1, 2) / 3, correction = 1e-17 * value;
  const program::Checkpoint written{{{"stage", "loading"}},
                                    {State(value, correction), 0.1 / 3, -1, 1e-3 / 7, -1}};
  program::write_checkpoint(results, "state", written);
  const auto read = program::read_checkpoint(folder.path / "state");
  BOOST_REQUIRE(read.has_value());
  BOOST_TEST((read->notes == written.notes));
  const auto &a = read->start, &b = written.start;
  BOOST_TEST((a.state.value() == value && a.state.correction() == correction));
  BOOST_TEST((a.parameter == b.parameter && a.step == b.step));
  BOOST_TEST((a.direction == -1 && a.reference_sign == -1));
  BOOST_TEST(!program::read_checkpoint(folder.path / "nothing").has_value());

  const std::string whole = contents_of(folder.path / "state");
  const std::string numbers = whole.substr(whole.find('\n'));
  for (const std::string& broken :
       {std::string{}, whole.substr(0, whole.size() - 1), whole + "x", "no JSON" + numbers,
        "[50]" + numbers, R"({"size": 50})" + numbers, R"({"size": -1})" + numbers,
        R"({"size": "x"})" + numbers, whole.substr(1)}) {
    results.write("broken", broken);
    BOOST_CHECK_THROW(program::read_checkpoint(folder.path / "broken"), io::UserError);
  }
}
