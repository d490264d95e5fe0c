#include "verification/mutants/propose.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <regex>

#include "common/io/options.hpp"
#include "common/io/result_folder.hpp"
#include "common/testing/temporary_folder.hpp"
#include "verification/mutants/expression.hpp"

namespace talus::mutants {
namespace {

// What is replaced, by what, and what the mistake is called.
struct Rule {
  const char *pattern, *replacement, *what;
};

const std::vector<Rule>& rules() {
  static const std::vector<Rule> all{
      {R"( \+ )", " - ", "- for +"},
      {R"( - )", " + ", "+ for -"},
      {R"( \* )", " / ", "/ for *"},
      {R"( / )", " * ", "* for /"},
      {R"( \+= )", " -= ", "-= for +="},
      {R"( -= )", " += ", "+= for -="},
      {R"( < )", " <= ", "<= for <"},
      {R"( > )", " >= ", ">= for >"},
      {R"( <= )", " < ", "< for <="},
      {R"( >= )", " > ", "> for >="},
      {R"( < )", " > ", "> for <"},
      {R"( == )", " != ", "!= for =="},
      {R"( && )", " || ", "|| for &&"},
      {R"( \|\| )", " && ", "&& for ||"},
      {R"(([=(,] ?|return )-(\w))", "$1$2", "a sign lost"},
      {R"(return (\w[^;]* [*/] [^;]*);)", "return -($1);", "the other sign"},
      {R"(std::max\()", "std::min(", "min for max"},
      {R"(std::min\()", "std::max(", "max for min"},
      {R"(\[0\])", "[1]", "index 1 for 0"},
      {R"(\[1\])", "[0]", "index 0 for 1"},
      {R"(\b0\.5\b)", "0.25", "a half halved"},
      {R"(\b2 \* )", "3 * ", "3 for 2"},
      {R"(\b([1-9]\d*\.?\d*e-\d+)\b)", "10 * $1", "ten times a constant"},
      {R"((\w+)\((\w+), (\w+)\))", "$1($3, $2)", "arguments in the wrong order"},
      {R"(^([A-Za-z_.\[\]()]+(\([^=]*\))?( [-+*/]?= .*)?;)$)", "", "a statement left out"},
  };
  return all;
}

// A line of a function that is a statement, or its head, by itself.
bool is_whole(const std::string& line) {
  static const std::regex other(
      R"(^(//|#|using|template|struct|class|enum|namespace|static_assert|for \(const auto|[})])|.*\\$)");
  if (line.size() < 6 || std::regex_search(line, other)) return false;
  if (line.back() != ';' && !line.ends_with(") {")) return false;
  return std::ranges::count(line, '(') == std::ranges::count(line, ')') &&
         (line.find('=') != std::string::npos || line.starts_with("return") ||
          line.starts_with("if (") || line.back() == ';');
}

// Whether the line before ends what came before it.
bool begins_anew(const std::string& before) {
  return before.empty() || before.ends_with(";") || before.ends_with("{") ||
         before.ends_with("}") || before.starts_with("//");
}

}  // namespace

std::vector<Mutant> proposals(const std::filesystem::path& tree, const std::filesystem::path& file,
                              int count, std::uint64_t seed) {
  if (!std::filesystem::is_regular_file(tree / file))
    throw io::UserError("--propose: '" + file.string() + "' is no file of the tree");
  std::vector<std::string> lines;
  for (const std::string& line : io::split(testing::contents_of(tree / file), '\n'))
    lines.push_back(trimmed(line));
  std::map<std::string, int> times;
  for (const std::string& line : lines) ++times[line];
  std::mt19937_64 random(seed);
  std::vector<Mutant> all;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (times[line] != 1 || !is_whole(line) || !begins_anew(lines[i - 1])) continue;
    std::vector<Mutant> here;
    for (const Rule& rule : rules()) {
      const std::regex pattern(rule.pattern);
      const std::string mutated = std::regex_replace(line, pattern, rule.replacement,
                                                     std::regex_constants::format_first_only);
      if (mutated != line) here.push_back({"", rule.what, file, line, mutated});
    }
    if (!here.empty()) all.push_back(here[random() % here.size()]);
  }
  std::ranges::shuffle(all, random);
  if (all.size() > static_cast<std::size_t>(count)) all.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].name = file.stem().string() + "-" + std::to_string(i + 1);
  return all;
}

std::string catalogue_text(const std::vector<Mutant>& mutants) {
  std::string text;
  std::filesystem::path file;
  for (const Mutant& mutant : mutants) {
    if (mutant.file != file) text += "== " + mutant.file.string() + "\n";
    file = mutant.file;
    text += mutant.name + ": " + mutant.what + "\n- " + mutant.original + "\n";
    if (!mutant.mutated.empty()) text += "+ " + mutant.mutated + "\n";
  }
  return text;
}

}  // namespace talus::mutants
