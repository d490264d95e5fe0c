#include "verification/fuzz/grammar.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "verification/harness/process.hpp"

namespace talus::fuzz {
namespace {

// "--elements INT=40           Quadratic elements [1 ... 100000]": name, type, default,
// description.
const std::regex option_line(
    R"((?:-\w,)?(--[\w-]+)(?:\{[^}]*\})?(?: ([A-Z]{3,})(?:=(\S+))?)?(?: \.\.\.)?)"
    R"((?: Excludes:(?: --[\w-]+)+)?\s*(.*))");
const std::regex range_of_numbers(R"(\[(each )?(\S+) \.\.\. ([^\s;\]]+)[^\]]*\]$)");
// They change what a run is for; records have a relation of their own, the rest the tests of the
// programs.
const std::string of_cases[] = {"--record", "--reference", "--dry-run", "--describe"};
const std::regex list_of_choices(R"(\[([\w-]+(?:, [\w-]+)+)\]$)");

std::vector<std::string> parts_of(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0, end;
  while ((end = text.find(separator, begin)) != std::string::npos) {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + separator.size();
  }
  parts.push_back(text.substr(begin));
  return parts;
}

Option option_from(const std::smatch& line) {
  Option option{.name = line[1], .standard = line[3], .help = line[4]};
  const std::string type = line[2];
  if (type.empty()) return option;
  option.form = Form::text;
  std::smatch match;
  if (std::regex_search(option.help, match, range_of_numbers)) {
    option.lower = std::stod(match[2]);
    option.upper = std::stod(match[3]);
    option.range = match[2].str() + " ... " + match[3].str();
    const bool each = match[1].matched;
    // Text with a range is a number with something more to it, such as a unit.
    option.form = type == "INT"     ? Form::whole
                  : !each           ? Form::real
                  : type == "FLOAT" ? Form::reals
                                    : Form::text;
  } else if (std::regex_search(option.help, match, list_of_choices)) {
    option.form = Form::choice;
    option.range = match[1];
    option.choices = parts_of(option.range, ", ");
  }
  if (option.standard.starts_with('['))  // a list
    option.standard = option.standard.substr(1, option.standard.size() - 2);
  return option;
}

}  // namespace

const Option* Program::find(const std::string& option) const {
  const auto found = std::ranges::find(options, option, &Option::name);
  return found == options.end() ? nullptr : &*found;
}

std::vector<Option> options_in(const std::string& help) {
  // Descriptions that stand on a line of their own go back to their options.
  std::vector<std::string> lines;
  std::istringstream in(help);
  for (std::string line; std::getline(in, line);) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    const std::string text = line.substr(indent);
    if (indent > 2 && !lines.empty() && !text.empty())
      lines.back() += " " + text;
    else
      lines.push_back(text);
  }
  std::vector<Option> options;
  std::smatch match;
  for (const std::string& line : lines)
    if (line.starts_with('-') && std::regex_match(line, match, option_line) &&
        match[1] != "--help" && match[1] != "--version" &&
        std::ranges::find(of_cases, match[1].str()) == std::end(of_cases))
      options.push_back(option_from(match));
  return options;
}

Program read_program(const std::filesystem::path& path) {
  const process::Outcome help = process::run({path, {"--help"}, "/"});
  Program program{path.filename().string(), path, options_in(help.out)};
  if (!help.is_success() || program.options.empty())
    throw std::runtime_error(path.string() + " --help tells no options");
  return program;
}

}  // namespace talus::fuzz
