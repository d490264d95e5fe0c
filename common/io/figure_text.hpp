// Text in gnuplot's scripts: quoted, measured and broken into lines.
#pragma once

#include <string>
#include <vector>

namespace talus::io {

/// In single quotes, as it is.
std::string in_quotes(const std::string& text);

/// In letters: of UTF-8, the bytes that begin one.
int length_of(const std::string& text);

/// Lines of at most so many letters, broken between words.
std::vector<std::string> lines_of(const std::string& text, int longest);

/// The same in double quotes, where \n breaks the line.
std::string wrapped(const std::string& text, int longest, bool keeps_a_line_free = false);

}  // namespace talus::io
