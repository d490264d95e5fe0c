#include "verification/harness/html_report.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>

#include "verification/harness/front_page.hpp"
#include "verification/harness/html.hpp"

namespace talus::verification {

std::size_t Written::held() const {
  return static_cast<std::size_t>(std::ranges::count_if(checks, &Check::passed));
}

double Written::seconds() const {
  double sum = 0;
  for (const Cost& cost : costs) sum += cost.seconds;
  return sum;
}

std::string Written::command() const {
  const bool is_of_verify =
      std::ranges::any_of(costs, [](const Cost& cost) { return !cost.name.empty(); });
  return (is_of_verify || costs.empty() ? "./run verify " : "./run ") + name;
}

std::string Written::failures() const {
  std::string lines;
  for (const Check& check : checks)
    if (!check.passed())
      lines += "  FAILS: " + check.what + " = " + io::rounded(check.value, 5) + ", not in [" +
               io::rounded(check.lower, 5) + ", " + io::rounded(check.upper, 5) + "]\n";
  return lines;
}

void Written::append(const Written& part) {
  const auto add = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  body += part.body;
  add(checks, part.checks);
  add(answers, part.answers);
  add(headlines, part.headlines);
  add(ends, part.ends);
  add(costs, part.costs);
}

Written write_chapter(const Chapter& chapter, const std::filesystem::path& folder) {
  Written written{chapter.name, chapter.title, "", chapter.checks, chapter.answers,
                  {},           chapter.ends};
  for (const Headline& headline : chapter.headlines) {
    written.headlines.push_back({headline.question,
                                 html_of_pictures(headline.figure, chapter.name, folder),
                                 headline.sentence});
    written.body += html_of(headline.figure, chapter.name, folder);
  }
  for (const auto& block : chapter.blocks) {
    if (const auto* text = std::get_if<std::string>(&block))
      written.body += "<p>" + escaped(*text) + "</p>\n";
    else if (const auto* table = std::get_if<io::Table>(&block))
      written.body += html_of(*table);
    else
      written.body += html_of(std::get<io::Figure>(block), chapter.name, folder);
  }
  return written;
}

namespace {

// A sentence on the checks, behind what the parts found.
std::string html_of_answer(const Written& chapter) {
  std::string text;
  for (const std::string& answer : chapter.answers) text += escaped(answer) + " ";
  if (!chapter.checks.empty())
    text += (chapter.passed() ? "All " + std::to_string(chapter.checks.size())
                              : std::to_string(chapter.held()) + " of " +
                                    std::to_string(chapter.checks.size())) +
            " checks hold: " + escaped(kinds_in(chapter.checks)) + ".";
  return text.empty() ? "" : "<p class=answer>" + text + "</p>\n";
}

std::string html_of_costs(const Written& chapter) {
  std::string html;
  for (const Cost& cost : chapter.costs)
    if (!cost.name.empty())
      html += "<li>" + html_of_command("./run verify " + cost.name) + ": " +
              io::fixed(cost.seconds, cost.seconds < 10 ? 1 : 0) + " s of CPU time\n";
  return html.empty() ? "" : "<h2>To run it again</h2>\n<ul>" + html + "</ul>\n";
}

}  // namespace

std::string html_of(const Written& chapter) {
  return html_of_answer(chapter) + chapter.body +
         (chapter.checks.empty() ? "" : "<h2 id=checks>Checks</h2>\n" + html_of(chapter.checks)) +
         html_of_costs(chapter);
}

std::string machine() {
  std::string model = "unknown processor";
  std::ifstream cpus("/proc/cpuinfo");
  for (std::string line; std::getline(cpus, line);)
    if (line.rfind("model name", 0) == 0) {
      model = line.substr(line.find(':') + 2);
      break;
    }
  char date[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  return model + ", " + std::to_string(std::thread::hardware_concurrency()) +
         " threads seen, one used by a solve; compiler " + __VERSION__ + "; " + date;
}

std::string html_page(const std::string& title, const std::string& command, const std::string& body,
                      const std::string& home) {
  const std::string made =
      "<p class=made>" + html_of_command(command) + " " + escaped(machine()) + "</p>\n";
  return "<!doctype html><html lang=en><head><meta charset=utf-8><title>Talus: " + escaped(title) +
         "</title><meta name=viewport content=\"width=device-width\"><link rel=icon "
         "href=\"data:,\">"
         "<link rel=stylesheet href=report.css><script src=report.js defer></script></head>\n<body>"
         "<header>" +
         (home.empty() ? "" : "<nav><a href=\"" + home + "\">Talus: the report</a></nav>") +
         "<h1>" + escaped(title) + "</h1>\n" + (home.empty() ? made : "") + "</header>\n<main>\n" +
         body + "</main>\n" + (home.empty() ? "" : "<footer>" + made + "</footer>\n") +
         "</body></html>\n";
}

std::vector<std::string> report_files(const std::vector<Study>& studies) {
  std::vector<std::string> names = {"index.html"};
  for (const Study& study : studies) names.push_back(study.name + ".html");
  for (const Study& study : studies_elsewhere()) names.push_back(study.name + ".html");
  for (const auto& more : {names_of_assets(), io::files_of(ends_figure({}).name)})
    names.insert(names.end(), more.begin(), more.end());
  return names;
}

void write_report(const io::ResultFolder& folder, const std::vector<Written>& chapters,
                  const std::string& command) {
  write_assets(folder);
  const io::Figure ends = ends_figure(chapters);
  if (!ends.panels.empty()) io::write_panels(folder, ends);
  folder.write("index.html", front_page(chapters, command, folder.path()));
  for (const Written& chapter : chapters) {
    const bool counts_ends = !chapter.ends.empty();
    folder.write(chapter.name + ".html",
                 html_page(chapter.title, chapter.command(),
                           (counts_ends ? "<p class=answer>" + escaped(ends_sentence(chapters)) +
                                              "</p>\n" + html_of(ends, "", folder.path())
                                        : "") +
                               html_of(chapter),
                           "index.html"));
  }
}

}  // namespace talus::verification
