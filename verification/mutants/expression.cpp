#include "verification/mutants/expression.hpp"

#include <algorithm>
#include <cctype>

namespace talus::mutants {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
}
bool is_operator(char c) {
  return std::string("+-*/%<>=!&|^?:").find(c) != std::string::npos;
}
bool is_opening(char c) {
  return c == '(' || c == '[' || c == '{';
}
bool is_closing(char c) {
  return c == ')' || c == ']' || c == '}';
}

// What is in quotes as x, so that brackets and commas in it are none of the code.
std::string blanked(const std::string& code) {
  std::string text = code;
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quote == 0) {
      const bool is_digit_separator =
          c == '\'' && i > 0 && std::isdigit(static_cast<unsigned char>(text[i - 1]));
      if (c == '"' || (c == '\'' && !is_digit_separator)) quote = c;
    } else if (c == quote) {
      quote = 0;
    } else {
      if (c == '\\' && i + 1 < text.size()) text[i++] = 'x';
      text[i] = 'x';
    }
  }
  return text;
}

// Whether an assignment's = stands at `i`, its sign before it included (+=).
bool is_assignment(const std::string& code, std::size_t i) {
  if (code[i] != '=') return false;
  if (i + 1 < code.size() && code[i + 1] == '=') return false;
  return i == 0 || std::string("=<>!").find(code[i - 1]) == std::string::npos;
}

bool is_scope(const std::string& code, std::size_t i) {
  return (i > 0 && code[i - 1] == ':') || (i + 1 < code.size() && code[i + 1] == ':');
}

bool is_keyword_before(const std::string& code, std::size_t end, const std::string& word) {
  return end >= word.size() && code.compare(end - word.size(), word.size(), word) == 0 &&
         (end == word.size() || !is_word(code[end - word.size() - 1]));
}

std::size_t opening_of(const std::string& code, std::size_t closing) {
  int depth = 0;
  for (std::size_t i = closing;; --i) {
    if (is_closing(code[i])) ++depth;
    if (is_opening(code[i]) && --depth == 0) return i;
    if (i == 0) return 0;
  }
}

bool is_header_of_statement(const std::string& code, std::size_t opening) {
  std::size_t end = opening;
  while (end > 0 && code[end - 1] == ' ') --end;
  for (const char* word : {"if", "for", "while", "switch", "constexpr"})
    if (is_keyword_before(code, end, word)) return true;
  return false;
}

bool ends_expression(const std::string& code, std::size_t i) {
  const char c = code[i];
  return is_opening(c) || c == ',' || c == ';' || c == '?' || (c == ':' && !is_scope(code, i)) ||
         is_assignment(code, i);
}

std::size_t begin_of(const std::string& code, std::size_t begin) {
  while (begin > 0) {
    const std::size_t i = begin - 1;
    if (is_closing(code[i])) {
      const std::size_t opening = opening_of(code, i);
      if (code[i] == '}' || (code[i] == ')' && is_header_of_statement(code, opening))) break;
      begin = opening;
      continue;
    }
    if (ends_expression(code, i)) break;
    if (is_keyword_before(code, begin, "return") || is_keyword_before(code, begin, "else") ||
        is_keyword_before(code, begin, "co_return"))
      break;
    begin = i;
  }
  while (begin < code.size() && std::isspace(static_cast<unsigned char>(code[begin]))) ++begin;
  return begin;
}

std::size_t end_of(const std::string& code, std::size_t end) {
  int depth = 0;
  for (; end < code.size(); ++end) {
    const char c = code[end];
    if (is_opening(c)) ++depth;
    if (is_closing(c) && --depth < 0) break;
    if (depth == 0 && !is_closing(c) &&
        (c == ',' || c == ';' || c == '?' || (c == ':' && !is_scope(code, end))))
      break;
  }
  while (end > 0 && std::isspace(static_cast<unsigned char>(code[end - 1]))) --end;
  return end;
}

// With the other halves of the brackets in it.
Span balanced(const std::string& code, Span part) {
  int depth = 0, lowest = 0;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (is_opening(code[i])) ++depth;
    if (is_closing(code[i])) lowest = std::min(lowest, --depth);
  }
  const int missing = -lowest;
  for (int open = 0; part.begin > 0 && open < missing;) {
    const char c = code[--part.begin];
    if (is_opening(c)) ++open;
    if (is_closing(c)) --open;
  }
  for (depth += missing; part.end < code.size() && depth > 0; ++part.end) {
    if (is_opening(code[part.end])) ++depth;
    if (is_closing(code[part.end])) --depth;
  }
  return part;
}

// With the brackets around it; as it is where there are none.
Span with_brackets(const std::string& code, Span part) {
  int depth = 0;
  for (std::size_t begin = part.begin; begin-- > 0;) {
    if (is_closing(code[begin])) ++depth;
    if (!is_opening(code[begin]) || --depth >= 0) continue;
    depth = 0;
    for (std::size_t end = begin; end < code.size(); ++end) {
      if (is_opening(code[end])) ++depth;
      if (!is_closing(code[end]) || --depth > 0) continue;
      if (end >= part.end) return {begin, end + 1};
      break;
    }
    depth = 0;
  }
  return part;
}

}  // namespace

Span enclosing_expression(const std::string& code, Span part) {
  const std::string text = blanked(code);
  for (part = balanced(text, part);;) {
    const Span whole{begin_of(text, part.begin), end_of(text, part.end)};
    const Span larger = with_brackets(text, part);
    if (is_single(text.substr(whole.begin, whole.end - whole.begin)) || larger.begin == part.begin)
      return whole;
    part = larger;
  }
}

bool is_single(const std::string& code) {
  const std::string text = blanked(code);
  int depth = 0, questions = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_opening(c)) ++depth;
    if (is_closing(c) && --depth < 0) return false;
    if (depth != 0) continue;
    if (c == '?') ++questions;
    if (c == ',' || c == ';' || (c == ':' && !is_scope(text, i) && --questions < 0)) return false;
  }
  return depth == 0 && !code.starts_with('{');
}

Span difference(const std::string& original, const std::string& changed) {
  const std::size_t shorter = std::min(original.size(), changed.size());
  std::size_t begin = 0, tail = 0;
  while (begin < shorter && original[begin] == changed[begin]) ++begin;
  while (tail < shorter - begin &&
         original[original.size() - 1 - tail] == changed[changed.size() - 1 - tail])
    ++tail;
  const auto splits = [](const std::string& text, std::size_t at) {
    if (at == 0 || at >= text.size()) return false;
    const char left = text[at - 1], right = text[at];
    return (is_word(left) && is_word(right)) || (is_operator(left) && is_operator(right));
  };
  while (begin > 0 && (splits(original, begin) || splits(changed, begin))) --begin;
  while (tail > 0 &&
         (splits(original, original.size() - tail) || splits(changed, changed.size() - tail)))
    --tail;
  return {begin, std::max(begin, original.size() - tail)};
}

bool has_assignment(const std::string& code, Span part) {
  const std::string text = blanked(code);
  int depth = 0;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (is_opening(text[i])) ++depth;
    if (is_closing(text[i])) --depth;
    if (depth == 0 && is_assignment(text, i)) return true;
  }
  return false;
}

std::string trimmed(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return line.substr(begin, line.find_last_not_of(" \t") + 1 - begin);
}

std::string without_comments(const std::string& code) {
  const std::string text = blanked(code);
  std::string kept;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0)
      while (i < text.size() && text[i] != '\n') ++i;
    if (i < text.size()) kept += code[i];
  }
  return kept;
}

}  // namespace talus::mutants
