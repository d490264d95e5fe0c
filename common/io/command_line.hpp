// The words of a command line, GNU style: which options they give, and what is wrong with them.
#pragma once

#include <string>
#include <vector>

#include "common/io/cli.hpp"

namespace talus::io {

/// What `app` is to parse for the words after the program's name: every option once, followed by
/// exactly one word (several values are joined by commas, one that was left out is empty), then
/// what is no option. Stops at --help. Throws UserError for an unknown option, one given twice or
/// without its value, a flag with one, and a word that belongs to nothing.
std::vector<std::string> well_formed(const CLI::App& app, const std::vector<std::string>& words);

/// "; did you mean X?" with the name nearest to `word`; empty if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

/// Options, whether a run as it was asked for uses them, and what to say if it does not: by what,
/// and what would.
struct Use {
  std::vector<std::string> options;
  bool is_used = true;
  std::string not_used_by;
};

/// Throws UserError for the first option that was given although it is not used.
void refuse_unused(const CLI::App& app, const std::vector<Use>& table);

}  // namespace talus::io
