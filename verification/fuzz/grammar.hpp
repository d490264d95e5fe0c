// The options of a program as its own --help tells them: an option that is added is tried at once.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace talus::fuzz {

enum class Form { flag, choice, whole, real, reals, text };

struct Option {
  std::string name;  ///< "--elements"
  Form form = Form::flag;
  double lower = 0, upper = 0;                            ///< of whole, real, each of reals
  double most = std::numeric_limits<double>::infinity();  ///< beyond, a run would be long
  std::string range = {};  ///< as printed: "1 ... 10", or the list of choices
  std::vector<std::string> choices = {};
  std::string standard = {};  ///< its default, "" if it is not told
  std::string help = {};      ///< what it is for
};

struct Program {
  std::string name;
  std::filesystem::path path;
  std::vector<Option> options;  ///< without --help

  const Option* find(const std::string& option) const;
};

/// Options in the text that --help prints.
std::vector<Option> options_in(const std::string& help);

/// Runs `path --help`; throws std::runtime_error if that tells no options.
Program read_program(const std::filesystem::path& path);

}  // namespace talus::fuzz
