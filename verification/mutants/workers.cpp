#include "verification/mutants/workers.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "common/testing/temporary_folder.hpp"

namespace talus::mutants {
namespace {

std::atomic<bool> is_interrupted = false;

}  // namespace

bool in_parallel(int jobs, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  const auto stop = [](int) { is_interrupted = true; };
  const auto old_int = std::signal(SIGINT, stop), old_term = std::signal(SIGTERM, stop);
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < jobs; ++i)
      workers.emplace_back([&] {
        for (std::size_t k; !is_interrupted && (k = next++) < count;) work(k);
      });
  }
  std::signal(SIGINT, old_int);
  std::signal(SIGTERM, old_term);
  return !is_interrupted;
}

bool interrupted() {
  return is_interrupted;
}

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
