#include "verification/harness/html.hpp"

#include <algorithm>

#include "verification/harness/alt_text.hpp"

namespace talus::verification {
namespace {

std::string html_of_picture(const std::string& file, const io::PanelSize& size,
                            const std::string& alt) {
  return "<a class=picture href=\"" + escaped(file) + "\"><img loading=lazy src=\"" +
         escaped(file) + "\" width=" + std::to_string(size.width) +
         " height=" + std::to_string(size.height) + " alt=\"" + escaped(alt) + "\"></a>\n";
}

// Of the points that have one.
std::string html_of_commands(const io::Figure& figure) {
  io::Table table{"", {"curve", "x", "y", "command"}, {}};
  for (const io::Panel& panel : figure.panels)
    for (const io::Curve& curve : panel.curves)
      for (std::size_t i = 0; i < curve.commands.size(); ++i)
        table.rows.push_back({(figure.panels.size() > 1 ? panel.title + ": " : "") + curve.label,
                              io::rounded(curve.x[i], 3), io::rounded(curve.y[i], 3),
                              curve.commands[i]});
  if (table.rows.empty()) return "";
  table.title = "points of this figure";
  return html_of(table);
}

std::string html_of_row(const std::vector<std::string>& row, const std::string& tag,
                        std::size_t commands) {
  std::string html = "<tr>";
  for (std::size_t i = 0; i < row.size(); ++i)
    html += "<" + tag + ">" +
            (i == commands && tag == "td" ? html_of_command(row[i]) : escaped(row[i]));
  return html + "\n";
}

}  // namespace

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

std::string html_of_command(const std::string& command) {
  return "<code class=command>" + escaped(command) + "</code>";
}

std::string start_of_table(const std::string& title) {
  return "<div class=scroll tabindex=0 role=region aria-label=\"" + escaped(title) + "\"><table>";
}

std::string folded(const std::string& title, const std::string& contents, bool is_open) {
  return std::string("<details") + (is_open ? " open" : "") + "><summary>" + escaped(title) +
         "</summary>\n" + contents + "</details>\n";
}

std::string html_of(const io::Table& table) {
  const auto commands =
      static_cast<std::size_t>(std::ranges::find(table.header, "command") - table.header.begin());
  std::string html = start_of_table(table.title) + html_of_row(table.header, "th", commands);
  for (const auto& row : table.rows) html += html_of_row(row, "td", commands);
  return folded(table.title + " (" + std::to_string(table.rows.size()) + " rows)",
                html + "</table></div>\n");
}

std::string html_of_pictures(const io::Figure& figure, const std::string& name,
                             const std::filesystem::path& folder) {
  const std::string path = name.empty() ? "" : name + "/";
  const auto is_there = [&](const std::string& file) {
    return std::filesystem::exists(folder / file);
  };
  std::string html;
  for (std::size_t i = 0; i < figure.panels.size() && is_there(io::panel_file(figure, i)); ++i)
    html += html_of_picture(path + io::panel_file(figure, i), io::size_of(figure.panels[i]),
                            alt_text(figure.panels[i]));
  if (html.empty() && is_there(figure.name + ".png")) {
    std::string alt = figure.caption;
    for (const io::Panel& panel : figure.panels) alt += " " + alt_text(panel);
    html = html_of_picture(path + figure.name + ".png", io::size_of(figure), alt);
  }
  if (html.empty()) return "<p class=fails>Skipped: gnuplot drew no figure.</p>\n";
  return "<div class=panels>\n" + html + "</div>\n";
}

std::string html_of(const io::Figure& figure, const std::string& name,
                    const std::filesystem::path& folder) {
  return "<figure>" + html_of_pictures(figure, name, folder) + "<figcaption>" +
         escaped(figure.caption) + " Drawn by " +
         html_of_command((name.empty() ? "" : "cd " + name + " && ") + "gnuplot " + figure.name +
                         ".gp") +
         "</figcaption>" + html_of_commands(figure) + "</figure>\n";
}

std::string html_of(const std::vector<Check>& checks) {
  const auto held = std::ranges::count_if(checks, &Check::passed);
  std::string html =
      start_of_table("checks") + "<tr><th>check<th>against<th>value<th>bounds<th>verdict\n";
  for (const Check& check : checks)
    html += "<tr><td>" + escaped(check.what) + "<td>" + name_of(check.kind) + "<td>" +
            io::rounded(check.value, 5) + "<td>[" + io::rounded(check.lower, 5) + ", " +
            io::rounded(check.upper, 5) +
            "]<td class=" + (check.passed() ? "holds>holds\n" : "fails>FAILS\n");
  return folded(std::to_string(held) + " of " + std::to_string(checks.size()) + " checks hold",
                html + "</table></div>\n", held < std::ssize(checks));
}

std::string kinds_in(const std::vector<Check>& checks) {
  std::string text;
  for (const Kind kind : kinds_of_checks) {
    const auto count = std::ranges::count(checks, kind, &Check::kind);
    if (count > 0)
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " against " + name_of(kind);
  }
  return text;
}

}  // namespace talus::verification
