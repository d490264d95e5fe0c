#include "verification/harness/chapter_file.hpp"

#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

namespace talus::verification {
namespace {

constexpr const char* chapter_file = "chapter.json";

}  // namespace

void remove_chapter(const io::ResultFolder& folder) {
  folder.remove_older({chapter_file, "checks.csv", "table*.csv", "*.dat", "*.gp", "*.svg"});
}

void write_chapter_files(const io::ResultFolder& folder, const Chapter& chapter, double seconds) {
  io::Table checks{"", {"check", "value", "lower", "upper", "holds"}, {}};
  for (const auto& check : chapter.checks)
    checks.rows.push_back({check.what, io::exact(check.value), io::exact(check.lower),
                           io::exact(check.upper), check.passed() ? "yes" : "no"});
  folder.write("checks.csv", io::to_csv(checks));
  int tables = 0;
  for (const auto& block : chapter.blocks) {
    if (const auto* table = std::get_if<io::Table>(&block))
      folder.write("table" + std::to_string(++tables) + ".csv", io::to_csv(*table));
    else if (const auto* figure = std::get_if<io::Figure>(&block))
      io::write_figure(folder, *figure, "svg");
  }
  const Written written = write_chapter(chapter, folder.path());
  const nlohmann::json contents = {{"title", written.title},       {"html", written.html},
                                   {"checks", written.checks},     {"held", written.held},
                                   {"failures", written.failures}, {"seconds", seconds}};
  folder.write(chapter_file, contents.dump());
}

bool has_chapter(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / chapter_file);
}

Written read_chapter(const std::string& name, const std::filesystem::path& folder) {
  std::ifstream file(folder / chapter_file);
  const auto contents = nlohmann::json::parse(file);
  return {name,
          contents.at("title"),
          contents.at("html"),
          contents.at("checks"),
          contents.at("held"),
          contents.at("failures"),
          contents.at("seconds")};
}

Chapter chapter_of_failure(const Study& study, const std::string& reason) {
  Chapter chapter{study.name, study.question, {}, {}};
  chapter.check("study did not end: " + reason, std::numeric_limits<double>::quiet_NaN(), 0, 0);
  return chapter;
}

}  // namespace talus::verification
