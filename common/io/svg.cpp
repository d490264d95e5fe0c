#include "common/io/svg.hpp"

#include <cstdio>
#include <utility>

#include "common/io/svg_geometry.hpp"

namespace talus::io {
namespace {

// Without every stretch from one text to another, both included.
std::string without(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    const std::size_t end = text.find(to, at + from.size());
    if (end == std::string::npos) break;
    text.erase(at, end + to.size() - at);
  }
  return text;
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// Colours as #rrggbb.
std::string with_short_colours(const std::string& svg) {
  std::string result;
  std::size_t from = 0;
  for (std::size_t at = svg.find("rgb("); at != std::string::npos; at = svg.find("rgb(", from)) {
    int red = 0, green = 0, blue = 0;
    char hex[8] = "";
    if (std::sscanf(svg.c_str() + at, "rgb(%d ,%d ,%d )", &red, &green, &blue) != 3) break;
    std::snprintf(hex, sizeof hex, "#%02x%02x%02x", red & 255, green & 255, blue & 255);
    result += svg.substr(from, at - from) + hex;
    from = svg.find(')', at) + 1;
  }
  return result + svg.substr(from);
}

// White space as one character, a line break where there was one.
std::string collapsed(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t' && c != '\n')
      result += c;
    else if (result.ends_with(' ') || result.ends_with('\n'))
      result.back() = c == '\n' ? '\n' : result.back();
    else
      result += c == '\n' ? '\n' : ' ';
  return result;
}

// Without groups that hold nothing.
std::string without_empty_groups(const std::string& svg) {
  static const std::string end = ">\n</g>\n";
  std::string result;
  std::size_t from = 0;
  for (std::size_t at = svg.find(end); at != std::string::npos; at = svg.find(end, from)) {
    const std::size_t start = svg.rfind('<', at);
    const bool is_empty = svg.compare(start, 3, "<g ") == 0 && start >= from;
    result += svg.substr(from, (is_empty ? start : at + end.size()) - from);
    from = at + end.size();
  }
  return result + svg.substr(from);
}

// Without the definitions of marks that are not drawn; a mark may be made of an earlier one.
std::string without_unused_marks(const std::string& svg) {
  const std::string begin = "<defs>\n", end = "</defs>\n";
  const std::size_t first = svg.find(begin), last = svg.find(end);
  if (first == std::string::npos || last == std::string::npos) return svg;
  const std::string drawn = svg.substr(last);
  std::string kept;
  for (std::size_t at = last; at > first + begin.size();) {
    const std::size_t start = svg.rfind('\n', at - 2) + 1;
    const std::string mark = svg.substr(start, at - start);
    const std::size_t id = mark.find("id='") + 4;
    const std::string use = "#" + mark.substr(id, mark.find('\'', id) - id) + "'";
    if (drawn.find(use) != std::string::npos || kept.find(use) != std::string::npos)
      kept.insert(0, mark);
    at = start;
  }
  return svg.substr(0, first + begin.size()) + kept + drawn;
}

}  // namespace

std::string without_padding(const std::string& svg, const std::string& font) {
  constexpr std::pair<const char*, const char*> spans[] = {{"<title>", "</title>"},
                                                           {"<desc>", "</desc>"},
                                                           {"<filter", "</filter>"},
                                                           {" font-family=", ".00\""},
                                                           {" stroke-linecap=", "=\"miter\""}};
  std::string result = svg;
  for (const auto& [from, to] : spans) result = without(result, from, to);
  result = with(without_empty_groups(collapsed(result)), " = '", "='");
  // What nearly every group says is said once, around all of them.
  const std::string usual =
      R"( fill="none" color="black" stroke="currentColor" stroke-width="1.00")";
  const std::string all = R"(<g id="gnuplot_canvas")";
  result = with(with(result, usual, ""), all, all + usual);
  result = with(result, R"(fill="#ffffff"/>)", R"(fill="#ffffff" stroke="none"/>)");
  result = without_unused_marks(with(with_short_colours(result), R"( class="gridline")", ""));
  return with_short_geometry(result.insert(result.find("<svg") + 4, " " + font));
}

}  // namespace talus::io
