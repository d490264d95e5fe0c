// What a whole program costs.
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "oned/scenes.hpp"
#include "verification/cost/cost_parts.hpp"

namespace talus::verification {

// The whole program, from process start to the files written, if it stands beside this one.
void program_costs(Chapter& chapter, const Context&) {
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  io::Table table{"A whole program from process start to its files, milliseconds of wall time",
                  {"program", "best of 5"},
                  {}};
  int failures = 0;
  for (const auto& scene : oned::scenes()) {
    const auto program = folder / scene.name;
    if (error || !std::filesystem::exists(program)) {
      chapter.text("Skipped: the program " + scene.name + " does not stand beside verify.");
      continue;
    }
    const auto output = std::filesystem::temp_directory_path() /
                        ("talus-" + scene.name + "-" + std::to_string(std::rand()));
    const std::string command =
        "'" + program.string() + "' --output '" + output.string() + "' >/dev/null 2>&1";
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) {
      const auto start = std::chrono::steady_clock::now();
      if (std::system(command.c_str()) != 0) {
        ++failures;
        break;
      }
      best = std::min(
          best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                    .count());
    }
    std::filesystem::remove_all(output, error);
    table.rows.push_back({scene.name, io::rounded(best, 3)});
  }
  chapter.check(Kind::self_consistency, "programs that did not run", failures, 0, 0);
  chapter.table(std::move(table));
}

}  // namespace talus::verification
