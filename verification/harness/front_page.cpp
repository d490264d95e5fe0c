#include "verification/harness/front_page.hpp"

#include <algorithm>
#include <set>

#include "verification/harness/html.hpp"

namespace talus::verification {
namespace {

struct Heading {
  Question question;
  const char* title;
};
constexpr Heading headings[] = {
    {Question::speed_against_accuracy, "Speed against accuracy"},
    {Question::where_methods_fail, "Where methods fail"},
    {Question::which_model, "Which model a scene needs"},
};

std::vector<Ends> all_ends(const std::vector<Written>& chapters) {
  std::vector<Ends> all;
  for (const Written& chapter : chapters)
    all.insert(all.end(), chapter.ends.begin(), chapter.ends.end());
  return all;
}

// By scene and model, in alphabetical order.
std::map<std::string, std::map<std::string, int>> grouped(const std::vector<Ends>& all,
                                                          bool is_recommended) {
  std::map<std::string, std::map<std::string, int>> groups;
  for (const Ends& each : all)
    if (each.is_recommended == is_recommended)
      for (const auto& [end, count] : each.counts) groups[each.of][end] += count;
  return groups;
}

int count_in(const std::map<std::string, int>& counts, const std::string& end) {
  const auto found = counts.find(end);
  return found == counts.end() ? 0 : found->second;
}

// Sums over ends of one sort.
std::map<std::string, int> sums(const std::vector<Ends>& all, bool is_recommended) {
  std::map<std::string, int> counts;
  for (const auto& [_, group] : grouped(all, is_recommended))
    for (const auto& [end, count] : group) counts[end] += count;
  return counts;
}

// "9 of 12 arrive: 2 stagnated, 1 not_finite".
std::string sentence_of(const std::map<std::string, int>& counts) {
  int all = 0;
  std::string failures;
  for (const auto& [end, count] : counts) {
    all += count;
    if (end != arrival)
      failures += (failures.empty() ? "" : ", ") + std::to_string(count) + " " + end;
  }
  std::ranges::replace(failures, '_', ' ');
  return std::to_string(count_in(counts, arrival)) + " of " + std::to_string(all) + " arrive" +
         (failures.empty() ? "" : " (" + failures + ")");
}

// Answers of one question, with the pages that say more.
std::string card(const std::string& title, const std::string& pictures, const std::string& sentence,
                 const std::string& page) {
  return "<section><h2><a href=\"" + page + ".html\">" + escaped(title) + "</a></h2>\n" + pictures +
         "<p>" + escaped(sentence) + " <a href=\"" + page + ".html\">More: " + page +
         "</a></p></section>\n";
}

std::string cards(const std::vector<Written>& chapters, const std::filesystem::path& folder) {
  std::string html;
  for (const auto& [question, title] : headings)
    for (const Written& chapter : chapters) {
      for (const WrittenHeadline& each : chapter.headlines)
        if (each.question == question)
          html += card(title, each.pictures, each.sentence, chapter.name);
      if (question == Question::where_methods_fail && !chapter.ends.empty()) {
        html += card(title, html_of_pictures(ends_figure(chapters), "", folder),
                     ends_sentence(chapters), chapter.name);
        break;  // those of all chapters
      }
    }
  return html.empty() ? "" : "<div class=cards>\n" + html + "</div>\n";
}

std::string flows(const std::vector<Written>& chapters) {
  std::string html;
  for (const Written& chapter : chapters)
    for (const WrittenHeadline& each : chapter.headlines)
      if (each.question == Question::flows)
        html += "<section>" + each.pictures + "<p>" + escaped(each.sentence) + " <a href=\"" +
                chapter.name + ".html\">More: " + chapter.name + "</a></p></section>\n";
  return html.empty() ? "" : "<h2>The flows</h2>\n<div class=cards>\n" + html + "</div>\n";
}

std::string verdict(const std::vector<Written>& chapters) {
  std::vector<Check> all;
  for (const Written& chapter : chapters)
    all.insert(all.end(), chapter.checks.begin(), chapter.checks.end());
  const auto held = std::ranges::count_if(all, &Check::passed);
  const bool passed = held == std::ssize(all);
  io::Table kinds{"", {"held against", "hold", "checks"}, {}};
  for (const Kind kind : kinds_of_checks) {
    const auto is_of_kind = [&](const Check& check) { return check.kind == kind; };
    const auto holds = [&](const Check& check) { return is_of_kind(check) && check.passed(); };
    kinds.rows.push_back({name_of(kind), std::to_string(std::ranges::count_if(all, holds)),
                          std::to_string(std::ranges::count_if(all, is_of_kind))});
  }
  kinds.title = "by what they are held against";
  return "<div class=verdict><p><strong class=" +
         std::string(passed ? "holds>Every check holds." : "fails>Some checks do not hold.") +
         "</strong> " + std::to_string(held) + " of " + std::to_string(all.size()) +
         " hold.</p>\n" + html_of(kinds) + "</div>\n";
}

std::string studies_table(const std::vector<Written>& chapters) {
  std::string html = "<h2>The studies</h2>\n" + start_of_table("the studies") +
                     "<tr><th>study<th>question<th>checks"
                     "<th>CPU s<th>to run it again\n";
  for (const Written& chapter : chapters)
    html += "<tr><td><a href=\"" + chapter.name + ".html\">" + chapter.name + "</a><td>" +
            escaped(chapter.title) + "<td class=" + (chapter.passed() ? "holds>" : "fails>") +
            std::to_string(chapter.held()) + " of " + std::to_string(chapter.checks.size()) +
            " hold<td>" + io::fixed(chapter.seconds(), chapter.seconds() < 10 ? 1 : 0) + "<td>" +
            html_of_command(chapter.command()) + "\n";
  return html + "</table></div>\n";
}

}  // namespace

io::Figure ends_figure(const std::vector<Written>& chapters) {
  io::Figure figure{
      "ends",
      "How the solves of the maps end, by scene and model: by the ways we recommend, and "
      "below them with one thing taken away. Numbers count the solves; laws, meshes "
      "and λr are those of the maps.",
      {},
      1};
  const std::vector<Ends> all = all_ends(chapters);
  if (all.empty()) return figure;
  std::set<std::string> failures;
  for (const Ends& each : all)
    for (const auto& [end, _] : each.counts)
      if (end != arrival) failures.insert(end);
  io::Bars bars{{}, {arrival}, {}};
  bars.parts.insert(bars.parts.end(), failures.begin(), failures.end());
  bars.counts.resize(bars.parts.size());
  const auto add_row = [&](const std::string& row, const std::map<std::string, int>& counts) {
    bars.rows.push_back(row);
    for (std::size_t part = 0; part < bars.parts.size(); ++part)
      bars.counts[part].push_back(count_in(counts, bars.parts[part]));
  };
  for (const bool is_recommended : {true, false}) {
    const auto groups = grouped(all, is_recommended);
    if (!groups.empty()) add_row(is_recommended ? "recommended:" : "one thing less:", {});
    for (const auto& [of, counts] : groups) add_row(of, counts);
  }
  for (std::string& part : bars.parts) std::ranges::replace(part, '_', ' ');
  figure.panels = {{"", "share of the solves, %", "", false, false, {}, std::nullopt, bars}};
  return figure;
}

std::string ends_sentence(const std::vector<Written>& chapters) {
  const std::vector<Ends> all = all_ends(chapters);
  const auto recommended = sums(all, true), others = sums(all, false);
  std::string sentence;
  if (!recommended.empty())
    sentence = "Of the solves by the ways we recommend " + sentence_of(recommended);
  if (!others.empty())
    sentence += (sentence.empty() ? "With" : "; with") + std::string(" one thing taken away ") +
                sentence_of(others);
  return sentence.empty() ? "" : sentence + ".";
}

std::string front_page(const std::vector<Written>& chapters, const std::string& command,
                       const std::filesystem::path& folder) {
  return html_page(
      "Verification of steady dense granular flow", command,
      verdict(chapters) + cards(chapters, folder) + flows(chapters) + studies_table(chapters));
}

}  // namespace talus::verification
