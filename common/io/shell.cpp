#include "common/io/shell.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace talus::io {

std::string shell_word(const std::string& text) {
  const auto is_plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("-_=.,:/+", c) != nullptr;
  };
  const auto is_control = [](char c) { return c >= 0 && c < ' '; };
  if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
  const bool has_control = std::ranges::any_of(text, is_control);
  std::string quoted = has_control ? "$'" : "'";
  for (const char c : text)
    if (is_control(c))  // a script is one line
      quoted += std::string("\\x") + (c < 16 ? '0' : '1') + "0123456789abcdef"[c % 16];
    else if (c == '\'')
      quoted += has_control ? "\\'" : "'\\''";
    else
      quoted += has_control && c == '\\' ? "\\\\" : std::string(1, c);
  return quoted + "'";
}

}  // namespace talus::io
