#include "verification/mutants/verifier_run.hpp"

#include <chrono>

#include "common/testing/temporary_folder.hpp"

namespace talus::mutants {

Run run_verifier(const Verifier& verifier, const std::vector<std::string>& variables,
                 double time_limit) {
  const testing::TemporaryFolder scratch;
  std::vector<std::string> arguments = variables;
  arguments.push_back("TMPDIR=" + scratch.path().string());
  for (std::size_t i = 0; i < verifier.command.size(); ++i)
    arguments.push_back(i > 0 && verifier.command[i - 1] == "--output"
                            ? (scratch.path() / "output").string()
                            : verifier.command[i]);
  const auto start = std::chrono::steady_clock::now();
  Run run{process::run(
      {"/usr/bin/env", arguments, verifier.folder, {}, {}, false, time_limit, 4 * time_limit})};
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace talus::mutants
