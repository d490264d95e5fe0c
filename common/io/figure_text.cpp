#include "common/io/figure_text.hpp"

#include <algorithm>

namespace talus::io {

std::string in_quotes(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "''" : std::string(1, c);
  return result + "'";
}

int length_of(const std::string& text) {
  return static_cast<int>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::vector<std::string> lines_of(const std::string& text, int longest) {
  std::vector<std::string> lines(1);
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at);
    if (!lines.back().empty() && length_of(lines.back()) + 1 + length_of(word) > longest)
      lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    at = end + 1;
  }
  return lines;
}

std::string wrapped(const std::string& text, int longest, bool keeps_a_line_free) {
  std::string result = "\"";
  for (const std::string& line : lines_of(text, longest)) {
    if (result.size() > 1) result += "\\n";
    for (const char c : line)
      result += c == '"' || c == '\\' || c == '`' ? "\\" + std::string(1, c) : std::string(1, c);
  }
  return result + (keeps_a_line_free ? "\\n \"" : "\"");
}

}  // namespace talus::io
