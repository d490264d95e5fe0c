#include "common/io/command_line.hpp"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <new>
#include <numeric>
#include <set>
#include <utility>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/io/processor.hpp"
#include "common/io/result_folder.hpp"
#include "common/io/table.hpp"

namespace talus::io {
namespace {

std::string memory_held() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return rounded(static_cast<double>(usage.ru_maxrss) * 1024 / 1e9, 2) + " GB";  // from KiB
}

// A value may hold line breaks.
std::string in_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\n' || c == '\r' ? "\\n" : std::string(1, c);
  return line;
}

// A closed stdout would lend its number to the next file that is opened.
void hold_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) == -1) {  // the lowest free number is taken; it cannot be used
      [[maybe_unused]] const int same =
          open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

bool is_option(const std::string& word) {
  if (word.size() < 2 || word[0] != '-') return false;
  return word[1] != '.' && std::isdigit(static_cast<unsigned char>(word[1])) == 0;
}

std::vector<std::string> names_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// Levenshtein's: letters put in, left out or changed.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({change, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row.back();
}

std::string quoted(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "'" : " '") + word + "'";
  return list;
}

// The option of the words from `at` on, with its value or values; `at` is moved behind them.
std::vector<std::string> read_option(const CLI::App& app, const std::vector<std::string>& words,
                                     std::size_t& at) {
  const std::string& word = words[at++];
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const CLI::Option* option = app.get_option_no_throw(name);
  if (!option)
    throw UserError(name + ": there is no such option" + did_you_mean(name, names_of(app)));
  const int most = option->get_items_expected_max(), least = option->get_items_expected_min();
  if (most == 0) {
    if (equals != std::string::npos) throw UserError(name + ": it takes no value");
    return {name};
  }
  std::vector<std::string> values;
  if (equals != std::string::npos)
    values.push_back(word.substr(equals + 1));
  else
    while (at < words.size() && !is_option(words[at]) && static_cast<int>(values.size()) < most)
      values.push_back(words[at++]);
  if (values.empty() && least > 0)
    throw UserError(name + ": its value is missing" +
                    (at < words.size() ? " before '" + words[at] + "'" : ""));
  if (least == 0 && values == std::vector<std::string>{""})
    throw UserError(name + ": '' is no value");
  std::string value;
  for (std::size_t i = 0; i < values.size(); ++i) value += (i == 0 ? "" : ",") + values[i];
  return {name, value};
}

// What `app` is to parse for the words after the program's name: every option once, followed by
// exactly one word (several values are joined by commas, one that was left out is empty), then
// what is no option. Stops at --help. Throws UserError for an unknown option, one given twice or
// without its value, a flag with one, and a word that belongs to nothing.
std::vector<std::string> well_formed(const CLI::App& app, const std::vector<std::string>& words) {
  std::vector<std::string> parsed, others;
  std::set<const CLI::Option*> given;
  std::string last_option;
  for (std::size_t at = 0; at < words.size();) {
    if (words[at] == "--") {
      others.insert(others.end(), words.begin() + static_cast<std::ptrdiff_t>(at) + 1, words.end());
      break;
    }
    if (!is_option(words[at])) {
      others.push_back(words[at++]);
      continue;
    }
    const std::vector<std::string> option = read_option(app, words, at);
    if (app.get_option(option[0]) == app.get_help_ptr()) return {option[0]};
    if (!given.insert(app.get_option(option[0])).second)
      throw UserError(option[0] + ": it is given twice");
    parsed.insert(parsed.end(), option.begin(), option.end());
    if (others.empty()) last_option = option[0];
  }
  if (others.empty()) return parsed;
  const bool takes_words =
      !app.get_options([](const CLI::Option* option) { return option->get_positional(); }).empty();
  if (!takes_words)
    throw UserError(quoted(others) +
                    (others.size() == 1 ? " belongs to no option" : " belong to no option") +
                    (last_option.empty() ? "" : ", nor to " + last_option + " before it"));
  parsed.push_back("--");
  parsed.insert(parsed.end(), others.begin(), others.end());
  return parsed;
}

}  // namespace

const Option& Option::by_default(const std::string& shown) const {
  option_->default_str(shown);
  return *this;
}

const Option& Option::of_type(const std::string& type) const {
  option_->type_name(type);
  return *this;
}

const Option& Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

const Option& Option::takes(int least, int most) const {
  option_->expected(least, most);
  return *this;
}

const Option& Option::is_required() const {
  option_->required();
  return *this;
}

CommandLine::CommandLine(const std::string& description, const std::string& program,
                         const std::string& footer)
    : app_(std::make_shared<CLI::App>(description, program)) {
  app_->footer(footer);
}

bool CommandLine::is_given(const std::string& option) const {
  const CLI::Option* found = std::as_const(*app_).get_option_no_throw(option);
  return found && found->count() > 0;
}

std::optional<int> CommandLine::most_values(const std::string& option) const {
  const CLI::Option* found = std::as_const(*app_).get_option_no_throw(option);
  if (!found) return std::nullopt;
  return found->get_items_expected_max();
}

std::vector<GivenOption> CommandLine::options() const {
  std::vector<GivenOption> all;
  for (const CLI::Option* option : std::as_const(*app_).get_options()) {
    if (option == app_->get_help_ptr() || option->get_lnames().empty()) continue;
    GivenOption given{"--" + option->get_lnames().front(), option->get_type_name(),
                      option->get_default_str(), option->get_description(),
                      option->get_items_expected_max() == 0};
    if (option->count() > 0) given.value = given.is_flag ? "" : option->results().front();
    all.push_back(given);
  }
  return all;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const bool is_beginning = word.size() > 2 && name.rfind(word, 0) == 0;
    const std::size_t distance = is_beginning ? 0 : edit_distance(word, name);
    if (distance >= std::min(least, std::max(word.size(), name.size()))) continue;
    least = distance;
    nearest = name;
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

int CommandLine::run(int argc, char** argv, const std::function<int()>& body) {
  require_processor();
  hold_standard_streams();
  const auto complain = [&](const std::string& message, int code) {
    std::cerr << app_->get_name() << ": " << in_one_line(message) << '\n';
    return code;
  };
  const auto parse = [&] {
    std::vector<std::string> words = well_formed(*app_, {argv + 1, argv + argc});
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
      app_->parse(words);
    } catch (const CLI::CallForHelp&) {
      throw;
    } catch (const CLI::ParseError& error) {
      throw UserError(error.what());
    }
  };
  int code = 0;
  try {
    try {
      parse();
    } catch (const UserError& error) {
      return complain(std::string(error.what()) + " (see --help)", 2);
    }
    code = body();
  } catch (const CLI::CallForHelp&) {
    std::cout << app_->help();
  } catch (const UserError& error) {
    return complain(error.what(), 2);
  } catch (const std::bad_alloc& error) {  // solve::OutOfMemory has more to say than its kin
    const std::string what = error.what();
    return complain(
        "out_of_memory: " +
            (what == std::bad_alloc().what() ? "no more to be had beyond " + memory_held() : what) +
            "; try fewer elements, or a machine with more memory",
        1);
  } catch (const std::exception& error) {
    return complain(error.what(), 1);
  }
  std::cout.flush();
  if (code == 0 && !std::cout) return complain("stdout did not take what was printed", 1);
  return code;
}

void refuse_unused(const CommandLine& line, const std::vector<Use>& table) {
  for (const Use& use : table)
    for (const std::string& option : use.options)
      if (!use.is_used && line.is_given(option))
        throw UserError(option + ": not used by " + use.not_used_by);
}

}  // namespace talus::io
