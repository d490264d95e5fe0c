// The command line's edge: ranges in --help, and one clear line for every impossible value.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/io/cli.hpp"
#include "common/io/command_line.hpp"
#include "common/io/result_folder.hpp"

namespace talus::io {

// What checks the text of a value is what sets it: numbers are decimal, 0100 is a hundred.

/// Adds an integer option that must lie in [lower, upper].
CLI::Option* add_integer(CLI::App& app, const std::string& name, int& value,
                         const std::string& description, int lower, int upper);

/// Adds a real option that must be finite and lie in [lower, upper].
CLI::Option* add_real(CLI::App& app, const std::string& name, double& value,
                      const std::string& description, double lower, double upper);

/// Adds an option that takes radians in [lower, upper], or degrees as in 23deg.
CLI::Option* add_angle(CLI::App& app, const std::string& name, double& value,
                       const std::string& description, double lower, double upper);

/// Adds an option that takes reals separated by commas or spaces, each in [lower, upper].
CLI::Option* add_reals(CLI::App& app, const std::string& name, std::vector<double>& values,
                       const std::string& description, double lower, double upper);

/// Adds an option that takes one of the names; an older spelling of one is still understood.
CLI::Option* add_choice(CLI::App& app, const std::string& name, std::string& value,
                        const std::string& description, const std::vector<std::string>& names,
                        const std::map<std::string, std::string>& older = {});

/// Adds an option that takes any text that is not empty.
CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& value,
                      const std::string& description);

/// Runs `body` after parsing and maps what goes wrong to one line on stderr and an exit code:
/// 0 after --help, 2 for wrong input (UserError included), 1 for anything else thrown and where
/// stdout did not take what was printed.
int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& body);

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
