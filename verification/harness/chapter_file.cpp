#include "verification/harness/chapter_file.hpp"

#include <charconv>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

namespace talus::verification {
namespace {

using nlohmann::json;

constexpr const char* chapter_file = "chapter.json";

// JSON has no number for NaN.
double number_in(const json& text) {
  const auto& digits = text.get_ref<const std::string&>();
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return value;
}

std::string name_of(Question question) {
  switch (question) {
    case Question::speed_against_accuracy:
      return "speed against accuracy";
    case Question::where_methods_fail:
      return "where methods fail";
    case Question::which_model:
      return "which model";
    case Question::flows:
      return "flows";
  }
  return {};
}

Question question_named(const std::string& name) {
  for (const Question question : {Question::speed_against_accuracy, Question::where_methods_fail,
                                  Question::which_model, Question::flows})
    if (name_of(question) == name) return question;
  throw std::out_of_range("the front page does not ask '" + name + "'");
}

}  // namespace

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::exact:
      return "exact solution";
    case Kind::manufactured:
      return "manufactured solution";
    case Kind::other_code:
      return "other code";
    case Kind::publication:
      return "publication";
    case Kind::other_method:
      return "other method here";
    case Kind::self_consistency:
      return "itself";
    case Kind::control:
      return "something broken";
  }
  return {};
}

Kind kind_named(const std::string& name) {
  for (const Kind kind : kinds_of_checks)
    if (name_of(kind) == name) return kind;
  throw std::out_of_range("no check is against '" + name + "'");
}

void remove_chapter(const io::ResultFolder& folder) {
  folder.remove_older(
      {chapter_file, "checks.csv", "table*.csv", "*.dat", "*.gp", "*.svg", "*.png"});
}

void write_chapter_files(const io::ResultFolder& folder, const Chapter& chapter, bool is_full,
                         double seconds) {
  io::Table checks{"", {"check", "against", "value", "lower", "upper", "holds"}, {}};
  for (const auto& check : chapter.checks)
    checks.rows.push_back({check.what, name_of(check.kind), io::exact(check.value),
                           io::exact(check.lower), io::exact(check.upper),
                           check.passed() ? "yes" : "no"});
  folder.write("checks.csv", io::to_csv(checks));
  int tables = 0;
  for (const Headline& headline : chapter.headlines) io::write_panels(folder, headline.figure);
  for (const auto& block : chapter.blocks) {
    if (const auto* table = std::get_if<io::Table>(&block))
      folder.write("table" + std::to_string(++tables) + ".csv", io::to_csv(*table));
    else if (const auto* figure = std::get_if<io::Figure>(&block))
      io::write_panels(folder, *figure);
  }
  const Written written = write_chapter(chapter, folder.path());
  json contents = {{"full", is_full},
                   {"body", written.body},
                   {"checks", checks.rows},
                   {"answers", written.answers},
                   {"headlines", json::array()},
                   {"ends", json::array()},
                   {"seconds", seconds}};
  for (const WrittenHeadline& each : written.headlines)
    contents["headlines"].push_back({name_of(each.question), each.pictures, each.sentence});
  for (const Ends& each : written.ends)
    contents["ends"].push_back({each.of, each.is_recommended, each.counts});
  folder.write(chapter_file, contents.dump());
}

bool has_chapter(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / chapter_file);
}

std::optional<Record> read_chapter(const std::filesystem::path& folder) {
  try {
    std::ifstream file(folder / chapter_file);
    const json contents = json::parse(file);
    Record record{{"", "", contents.at("body"), {}, contents.at("answers")}, contents.at("full")};
    for (const json& row : contents.at("checks"))
      record.written.checks.push_back({row.at(0), number_in(row.at(2)), number_in(row.at(3)),
                                       number_in(row.at(4)), kind_named(row.at(1))});
    for (const json& row : contents.at("headlines"))
      record.written.headlines.push_back({question_named(row.at(0)), row.at(1), row.at(2)});
    for (const json& row : contents.at("ends"))
      record.written.ends.push_back({row.at(0), row.at(1), row.at(2)});
    record.written.costs.push_back({"", contents.at("seconds")});
    return record;
  } catch (const std::exception&) {  // of JSON, or no kind of check
    return std::nullopt;
  }
}

void copy_chapter(const std::filesystem::path& from, const io::ResultFolder& to) {
  if (std::filesystem::equivalent(from, to.path())) return;
  remove_chapter(to);
  for (const auto& file : std::filesystem::directory_iterator(from))
    if (file.is_regular_file())
      std::filesystem::copy_file(file, to.path() / file.path().filename(),
                                 std::filesystem::copy_options::overwrite_existing);
}

Chapter chapter_of_failure(const Study& study, const Part& part, const std::string& did_not) {
  Chapter chapter{study.name_of(part), study.question, {}, {}};
  chapter.check(Kind::self_consistency, chapter.name + " " + did_not,
                std::numeric_limits<double>::quiet_NaN(), 0, 0);
  return chapter;
}

std::vector<Written> chapters_of(const std::vector<Study>& studies,
                                 const std::function<Written(const Study&, const Part&)>& written) {
  std::vector<Written> chapters;
  for (const Study& study : studies) {
    Written& chapter = chapters.emplace_back();
    chapter.name = study.name;
    chapter.title = study.question;
    for (const Part& part : study.parts) {
      Written each = written(study, part);
      for (Cost& cost : each.costs) cost.name = part.run ? study.name_of(part) : "";
      if (study.parts.size() > 1)
        each.body = "<h2 id=\"" + part.name + "\">" + part.name + "</h2>\n" + each.body;
      chapter.append(each);
    }
  }
  return chapters;
}

}  // namespace talus::verification
