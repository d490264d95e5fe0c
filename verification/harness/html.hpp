// Pieces of the report in HTML: text, tables, figures, checks, commands. All text is escaped.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verification/harness/chapter.hpp"

namespace talus::verification {

std::string escaped(const std::string& text);

/// A command line, beside which the page's script puts a button that copies it.
std::string html_of_command(const std::string& command);

/// Of one that scrolls sideways by itself, if it is wider than the page; ends with </table></div>.
std::string start_of_table(const std::string& title);

/// What opens when its title is clicked.
std::string folded(const std::string& title, const std::string& contents, bool is_open = false);

/// Folded; a column "command" holds command lines.
std::string html_of(const io::Table& table);

/// A figure whose files are in `folder`, which the page calls `name` (nothing for its own folder):
/// a picture for each panel, or else the whole as a PNG; what is seen in it as text, and the
/// command lines of its points. A figure that gnuplot did not draw is reported as skipped.
std::string html_of(const io::Figure& figure, const std::string& name,
                    const std::filesystem::path& folder);

/// Only its pictures.
std::string html_of_pictures(const io::Figure& figure, const std::string& name,
                             const std::filesystem::path& folder);

/// Each with what it is held against and its bounds; open if one fails.
std::string html_of(const std::vector<Check>& checks);

/// How many there are of which kind: "9 against an exact solution, 2 ...".
std::string kinds_in(const std::vector<Check>& checks);

}  // namespace talus::verification
