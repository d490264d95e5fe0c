// Where an expression of C++ begins and ends: as much of the language as mutants need.
#pragma once

#include <string>

namespace talus::mutants {

/// Characters [begin, end) of a text.
struct Span {
  std::size_t begin = 0, end = 0;
  bool overlaps(const Span& other) const { return begin < other.end && other.begin < end; }
};

/// The smallest whole expression of `code` that contains `part`: an argument, a condition, an
/// initialiser, one side of ?:, what is returned or assigned, or a statement without its semicolon.
Span enclosing_expression(const std::string& code, Span part);

/// Whether code can stand in brackets of its own: its own brackets in pairs, no list.
bool is_single(const std::string& code);

/// The part of `original` outside of which `changed` is the same, whole words and operators.
Span difference(const std::string& original, const std::string& changed);

/// Whether `part` holds an assignment outside of brackets, or begins a declaration.
bool has_assignment(const std::string& code, Span part);

/// Without the blanks around it.
std::string trimmed(const std::string& line);

/// Without // comments, what is quoted blanked out: as long as before, up to the comments.
std::string without_comments(const std::string& code);

}  // namespace talus::mutants
