#include "verification/study/question.hpp"

#include <cstdlib>

#include "common/io/options.hpp"

namespace talus::study {

Table asked(const std::string& scene, const std::vector<std::string>& words,
            const std::vector<std::string>& quantities) {
  Table table{program_of(scene), {}, quantities};
  table.varied = varied_options(table.program, words);
  for (const std::string& each : quantities) {
    const bool is_error = each.rfind("error_", 0) == 0;
    if (!table.program.quantity(each) && !(is_error && table.program.quantity(each.substr(6))))
      throw io::UserError("--quantity: '" + each + "' is no result of " + scene +
                          " (see its --describe)");
  }
  return table;
}

void solve(Table& table) {
  std::string folder = (std::filesystem::temp_directory_path() / "talus-cases-XXXXXX").string();
  if (!mkdtemp(folder.data())) throw io::UserError("no folder for cases: '" + folder + "'");
  table.rows = run_cases(table.program, possible(table.program, combinations(table.varied)), folder,
                         {}, [](const Row&, double) {});
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

}  // namespace talus::study
