// The command line's edge: ranges in --help, and one clear line for every impossible value.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/io/command_line.hpp"
#include "common/io/result_folder.hpp"

namespace talus::io {

// What checks the text of a value is what sets it: numbers are decimal, 0100 is a hundred.

/// Adds an option whose text `set` checks and takes; `shown` is its default in --help.
Option add_value(CommandLine& line, const std::string& name, const std::string& type,
                 const std::string& description, const std::function<void(const std::string&)>& set,
                 const std::function<std::string()>& shown = {});

/// Adds an integer option that must lie in [lower, upper].
Option add_integer(CommandLine& line, const std::string& name, int& value,
                   const std::string& description, int lower, int upper);

/// Adds a real option that must be finite and lie in [lower, upper].
Option add_real(CommandLine& line, const std::string& name, double& value,
                const std::string& description, double lower, double upper);

/// Adds an option that takes radians in [lower, upper], or degrees as in 23deg.
Option add_angle(CommandLine& line, const std::string& name, double& value,
                 const std::string& description, double lower, double upper);

/// Adds an option that takes reals separated by commas or spaces, each in [lower, upper].
Option add_reals(CommandLine& line, const std::string& name, std::vector<double>& values,
                 const std::string& description, double lower, double upper);

/// Adds an option that takes one of the names; an older spelling of one is still understood.
Option add_choice(CommandLine& line, const std::string& name, std::string& value,
                  const std::string& description, const std::vector<std::string>& names,
                  const std::map<std::string, std::string>& older = {});

/// Adds an option that takes any text that is not empty.
Option add_text(CommandLine& line, const std::string& name, std::string& value,
                const std::string& description);

/// Adds an option without a value.
Option add_flag(CommandLine& line, const std::string& name, bool& value,
                const std::string& description);

/// Adds what is no option: any number of words.
Option add_words(CommandLine& line, const std::string& name, std::vector<std::string>& words,
                 const std::string& description);

/// Parses a finite real; throws UserError naming the option, the value and the range.
double real_in_range(const std::string& option, const std::string& text, double lower,
                     double upper);

/// The same for a whole number.
int whole_in_range(const std::string& option, const std::string& text, int lower, int upper);

/// The same for radians, or degrees as in 23deg.
double angle_in_range(const std::string& option, const std::string& text, double lower,
                      double upper);

/// The parts of a text between separators, empty ones too.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace talus::io
