// The command line of a program, GNU style: its options, what was given, and what is wrong with it.
// CLI11, which takes seconds to translate, is behind this floor.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace talus::io {

/// An option of a command line, with what is not said when it is added (io/options.hpp).
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  /// What --help shows as its default.
  const Option& by_default(const std::string& shown) const;
  /// There is none, or it depends.
  const Option& without_default() const { return by_default(""); }
  /// What --help calls its value.
  const Option& of_type(const std::string& type) const;
  /// The two are not given together.
  const Option& excludes(const Option& other) const;
  /// From `least` to `most` values, which are joined by commas; none is empty text.
  const Option& takes(int least, int most) const;
  const Option& is_required() const;

 private:
  CLI::Option* option_;
};

/// An option as it was given, or not.
struct GivenOption {
  std::string name;  ///< with its dashes
  std::string type, standard, description;
  bool is_flag = false;
  std::optional<std::string> value = {};  ///< empty of a flag; none if it was not given
};

class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& program,
              const std::string& footer = {});

  /// False also if there is no such option.
  bool is_given(const std::string& option) const;
  /// In the order in which they were added, without --help and what has no dashes.
  std::vector<GivenOption> options() const;
  /// How many values it takes at most; none if there is no such option.
  std::optional<int> most_values(const std::string& option) const;

  /// Parses, runs `body`, and maps what goes wrong to one line on stderr and an exit code:
  /// 0 after --help, 2 for wrong input (UserError included), 1 for anything else thrown and where
  /// stdout did not take what was printed.
  int run(int argc, char** argv, const std::function<int()>& body);

  /// For what adds options.
  CLI::App& app() { return *app_; }

 private:
  std::shared_ptr<CLI::App> app_;
};

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
void refuse_unused(const CommandLine& line, const std::vector<Use>& table);

}  // namespace talus::io
