#include "verification/study/page.hpp"

#include <cmath>

#include "verification/harness/html_report.hpp"

namespace talus::study {
namespace {

using nlohmann::json;

json number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json as_json(const Kind& kind, const Table& table, const Findings& findings,
             const std::string& command) {
  json study = {{"kind", kind.name},
                {"scene", table.program.name()},
                {"command", command},
                {"cases", json::array()},
                {"fits", json::array()}};
  for (const Row& row : table.rows) study["cases"].push_back(row.record);
  for (const Fit& fit : findings.fits)
    study["fits"].push_back({{"quantity", fit.quantity},
                             {"curve", fit.curve},
                             {"order", number(fit.order)},
                             {"points", fit.points}});
  for (const auto& [curve, row] : findings.front)
    study["front"].push_back({{"curve", curve},
                              {"case", row->record.value("case", "")},
                              {"cpu_seconds", number(row->number("cpu_seconds"))},
                              {"command", row->record.at("command")}});
  return study;
}

std::vector<io::Figure> figures_of(const verification::Chapter& chapter) {
  std::vector<io::Figure> figures;
  for (const auto& block : chapter.blocks)
    if (const auto* figure = std::get_if<io::Figure>(&block)) figures.push_back(*figure);
  return figures;
}

}  // namespace

std::vector<std::string> files() {
  std::vector<std::string> names = {"index.html", "cases.csv", "study.json"};
  for (const char* figure : {"errors", "cost", "stability", "sweep", "ladder"})
    for (const std::string& file : io::files_of(figure)) names.push_back(file);
  for (const std::string& asset : verification::names_of_assets()) names.push_back(asset);
  return names;
}

std::string write_files(const io::ResultFolder& folder, const Kind& kind, const Table& table,
                        const Findings& findings, const std::string& command) {
  const io::Table cases = cases_table(table);
  folder.write("cases.csv", io::to_csv(cases));
  const std::vector<io::Figure> figures = figures_of(findings.chapter);
  const std::string drawn = io::draw(folder, figures, {"svg", "png", "pdf"});
  for (const io::Figure& figure : figures)
    if (figure.panels.size() > 1) io::write_panels(folder, figure);
  verification::Chapter chapter = findings.chapter;
  chapter.name = "";
  chapter.title = kind.question;
  chapter.text(count_of_ends(all_rows(table)) + ".");
  chapter.table(cases);
  verification::write_assets(folder);
  folder.write("index.html",
               verification::html_page(
                   kind.name + " of " + table.program.name() + ": " + kind.question, command,
                   verification::html_of(verification::write_chapter(chapter, folder.path()))));
  folder.write("study.json", as_json(kind, table, findings, command).dump(1) + "\n");
  return " cases.csv study.json index.html" + drawn;
}

}  // namespace talus::study
