#include "verification/harness/html_report.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

namespace talus::verification {
namespace {

constexpr const char* style = R"(
body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1180px;margin:2em auto;padding:0 1em}
h1{margin-bottom:.2em}h2{margin-top:2.2em;border-bottom:2px solid #0072b2;padding-bottom:.2em}
table{border-collapse:collapse;margin:1em 0;font-size:13px;display:block;overflow-x:auto}
caption{text-align:left;font-weight:600;padding:.3em 0}
th,td{border:1px solid #ccc;padding:.25em .6em;text-align:left;vertical-align:top}
th{background:#f0f4f8}figure{margin:1.2em 0}figure img{max-width:100%;border:1px solid #ddd}
figcaption{font-size:14px;color:#444}code{background:#f3f3f3;padding:.1em .3em}
.pass{color:#00704a;font-weight:600}.fail{color:#c0392b;font-weight:700}
details{margin:1em 0}summary{cursor:pointer;font-weight:600}nav a{margin-right:1.2em}
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

// An SVG as a data URI: gnuplot repeats ids, so figures must not share one document.
std::string data_uri(const std::string& svg) {
  constexpr const char* hex = "0123456789ABCDEF";
  std::string uri = "data:image/svg+xml,";
  for (const char c : svg) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || c == '%' || c == '#' || c == '<' || c == '>' || c == '"' || c == '\n') {
      uri += '%';
      uri += hex[byte >> 4];
      uri += hex[byte & 15];
    } else {
      uri += c;
    }
  }
  return uri;
}

std::string file_contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream contents;
  contents << file.rdbuf();
  return contents.str();
}

// Long tables are folded.
std::string html_of(const io::Table& table) {
  constexpr std::size_t longest_open = 24;
  const bool folded = table.rows.size() > longest_open;
  std::string html = folded ? "<details><summary>" + escaped(table.title) + "</summary><table>"
                            : "<table><caption>" + escaped(table.title) + "</caption>";
  const auto add = [&](const std::vector<std::string>& row, const std::string& tag) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<" + tag + ">" + escaped(cell) + "</" + tag + ">";
    html += "</tr>\n";
  };
  add(table.header, "th");
  for (const auto& row : table.rows) add(row, "td");
  return html + (folded ? "</table></details>\n" : "</table>\n");
}

std::string html_of(const io::Figure& figure, const std::string& chapter,
                    const std::filesystem::path& folder) {
  const std::string svg = file_contents(folder / (figure.name + ".svg"));
  std::string html = "<figure>";
  const auto columns = std::min(static_cast<std::size_t>(figure.columns), figure.panels.size());
  html += svg.empty()
              ? "<p class=fail>Skipped: gnuplot drew no figure.</p>"
              : "<img width=" + std::to_string(std::min<std::size_t>(560 * columns, 1150)) +
                    " alt=\"" + escaped(figure.caption) + "\" src=\"" + data_uri(svg) + "\">";
  return html + "<figcaption>" + escaped(figure.caption) + "<br><code>" +
         (chapter.empty() ? "" : "cd " + escaped(chapter) + " &amp;&amp; ") + "gnuplot " +
         figure.name + ".gp</code></figcaption></figure>\n";
}

std::string html_of_checks(const Written& written) {
  std::string html = std::string("<details") + (written.passed() ? "" : " open") + "><summary>" +
                     std::to_string(written.held()) + " of " +
                     std::to_string(written.checks.size()) + " checks hold</summary><table>" +
                     "<tr><th>check<th>against<th>value<th>bounds<th></tr>\n";
  for (const Check& check : written.checks)
    html += "<tr><td>" + escaped(check.what) + "<td>" + name_of(check.kind) + "<td>" +
            io::rounded(check.value, 5) + "<td>[" + io::rounded(check.lower, 5) + ", " +
            io::rounded(check.upper, 5) +
            "]<td class=" + (check.passed() ? "pass>holds" : "fail>FAILS") + "</tr>\n";
  return html + "</table></details>\n";
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
         " threads seen, one used by a study; compiler " + __VERSION__ + "; " + date;
}

// A whole document: `lead` stands above the machine and the command.
std::string page(const std::string& title, const std::string& heading, const std::string& lead,
                 const std::string& command, const std::string& body) {
  return "<!doctype html><html lang=en><head><meta charset=utf-8><title>" + escaped(title) +
         "</title><meta name=viewport content=\"width=device-width\"><style>" + std::string(style) +
         "</style></head><body>\n<h1>" + escaped(heading) + "</h1>\n" + lead + "<p>" +
         escaped(machine()) + "<br>Command: <code>" + escaped(command) + "</code></p>\n" + body +
         "</body></html>\n";
}

}  // namespace

std::size_t Written::held() const {
  return static_cast<std::size_t>(std::ranges::count_if(checks, &Check::passed));
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
  body += part.body;
  checks.insert(checks.end(), part.checks.begin(), part.checks.end());
  seconds += part.seconds;
}

Written write_chapter(const Chapter& chapter, const std::filesystem::path& folder) {
  Written written{chapter.name, chapter.title, "", chapter.checks, 0};
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

std::string html_of(const Written& chapter) {
  return "<h2 id=\"" + chapter.name + "\">" + escaped(chapter.title) + "</h2>\n" +
         (chapter.checks.empty() ? "" : html_of_checks(chapter)) + chapter.body;
}

// How many checks there are against what.
std::string html_of_kinds(const std::vector<Written>& chapters) {
  std::string html = "<table><tr><th>held against<th>checks</tr>\n";
  for (const Kind kind : kinds_of_checks) {
    std::ptrdiff_t count = 0;
    for (const Written& chapter : chapters)
      count += std::ranges::count(chapter.checks, kind, &Check::kind);
    html += "<tr><td>" + name_of(kind) + "<td>" + std::to_string(count) + "</tr>\n";
  }
  return html + "</table>\n";
}

std::string html_report(const std::vector<Written>& chapters, const std::string& command) {
  bool passed = true;
  std::string summary = "<table><tr><th>study<th>question<th>checks<th>CPU s<th>regenerate</tr>\n";
  std::string body;
  for (const Written& chapter : chapters) {
    passed = passed && chapter.passed();
    summary += "<tr><td><a href=\"#" + chapter.name + "\">" + chapter.name + "</a><td>" +
               escaped(chapter.title) +
               "<td class=" + (chapter.passed() ? "pass>all " : "fail>not all ") +
               std::to_string(chapter.checks.size()) + " hold<td>" +
               io::fixed(chapter.seconds, chapter.seconds < 10 ? 1 : 0) +
               "<td><code>./run verify " + chapter.name + "</code></tr>\n";
    body += html_of(chapter);
  }
  return page(
      "Talus: verification", "Talus: verification report",
      std::string("<p class=") +
          (passed ? "pass>Every check holds." : "fail>Some checks do not hold.") +
          "</p>\n<p>Steady dense granular flow with the μ(I) rheology: is the code right, what "
          "does an error cost, where do the methods fail?</p>\n",
      command, summary + "</table>\n" + html_of_kinds(chapters) + body);
}

std::string html_page(const std::string& title, const std::string& command,
                      const std::string& body) {
  return page("Talus: " + title, title, "", command, body);
}

}  // namespace talus::verification
