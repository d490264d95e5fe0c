#include "common/io/options.hpp"

#include <algorithm>
#include <charconv>
#include <iostream>
#include <new>
#include <numbers>
#include <optional>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "common/io/table.hpp"

namespace talus::io {
namespace {

std::string memory_held() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return rounded(static_cast<double>(usage.ru_maxrss) * 1024 / 1e9, 2) + " GB";  // from KiB
}

template <class Number>
std::string range_of(Number lower, Number upper) {
  if constexpr (std::is_integral_v<Number>)
    return std::to_string(lower) + " ... " + std::to_string(upper);
  else
    return rounded(lower, 6) + " ... " + rounded(upper, 6);
}

// The number that `text` is from its first to its last character.
template <class Number>
std::optional<Number> number_from(const std::string& text) {
  Number value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

template <class Number>
Number in_range(const std::string& option, const std::string& text, std::optional<Number> value,
                Number lower, Number upper, const std::string& unit = "") {
  if (value && *value >= lower && *value <= upper) return *value;
  throw UserError(option + ": '" + text + "' is not a " +
                  (std::is_integral_v<Number> ? "whole number" : "number") +
                  " in the allowed range " + range_of(lower, upper) + unit);
}

// An option whose text `set` checks and takes; `shown` is its default in --help.
CLI::Option* add_value(CLI::App& app, const std::string& name, const std::string& type,
                       const std::string& description,
                       const std::function<void(const std::string&)>& set,
                       const std::function<std::string()>& shown) {
  return app
      .add_option(
          name,
          [set](const CLI::results_t& words) {
            set(words.front());
            return true;
          },
          description, true, shown)
      ->type_name(type);
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

}  // namespace

CLI::Option* add_integer(CLI::App& app, const std::string& name, int& value,
                         const std::string& description, int lower, int upper) {
  return add_value(
      app, name, "INT", description + " [" + range_of(lower, upper) + "]",
      [=, &value](const std::string& text) { value = whole_in_range(name, text, lower, upper); },
      [&value] { return std::to_string(value); });
}

CLI::Option* add_real(CLI::App& app, const std::string& name, double& value,
                      const std::string& description, double lower, double upper) {
  return add_value(
      app, name, "FLOAT", description + " [" + range_of(lower, upper) + "]",
      [=, &value](const std::string& text) { value = real_in_range(name, text, lower, upper); },
      [&value] { return rounded(value, 6); });
}

CLI::Option* add_angle(CLI::App& app, const std::string& name, double& value,
                       const std::string& description, double lower, double upper) {
  return add_value(
      app, name, "ANGLE",
      description + ", in radians, or in degrees as 23deg [" + range_of(lower, upper) + "]",
      [=, &value](const std::string& text) { value = angle_in_range(name, text, lower, upper); },
      [&value] { return rounded(value, 6); });
}

CLI::Option* add_reals(CLI::App& app, const std::string& name, std::vector<double>& values,
                       const std::string& description, double lower, double upper) {
  constexpr int most = 1000;
  return add_value(
             app, name, "FLOAT", description + " [each " + range_of(lower, upper) + "]",
             [=, &values](const std::string& text) {
               values.clear();
               for (const std::string& part : split(text, ','))
                 values.push_back(real_in_range(name, part, lower, upper));
             },
             [&values] {
               std::string list;
               for (const double value : values)
                 list += (list.empty() ? "" : ",") + rounded(value, 6);
               return list;
             })
      ->expected(1, most);
}

CLI::Option* add_choice(CLI::App& app, const std::string& name, std::string& value,
                        const std::string& description, const std::vector<std::string>& names,
                        const std::map<std::string, std::string>& older) {
  std::string list;
  for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
  return add_value(
      app, name, "NAME", description + " [" + list + "]",
      [=, &value](const std::string& text) {
        const auto now = older.find(text);
        if (now == older.end() && std::find(names.begin(), names.end(), text) == names.end())
          throw UserError(name + ": '" + text + "' is none of: " + list +
                          did_you_mean(text, names));
        value = now == older.end() ? text : now->second;
      },
      [&value] { return value; });
}

CLI::Option* add_text(CLI::App& app, const std::string& name, std::string& value,
                      const std::string& description) {
  return add_value(
      app, name, "TEXT", description,
      [=, &value](const std::string& text) {
        if (text.empty()) throw UserError(name + ": '' is no value");
        value = text;
      },
      [&value] { return value; });
}

double real_in_range(const std::string& option, const std::string& text, double lower,
                     double upper) {
  return in_range(option, text, number_from<double>(text), lower, upper);
}

int whole_in_range(const std::string& option, const std::string& text, int lower, int upper) {
  return in_range(option, text, number_from<int>(text), lower, upper);
}

double angle_in_range(const std::string& option, const std::string& text, double lower,
                      double upper) {
  const std::string unit = "deg";
  std::optional<double> angle = number_from<double>(text);
  if (text.ends_with(unit)) {
    angle = number_from<double>(text.substr(0, text.size() - unit.size()));
    if (angle) *angle *= std::numbers::pi / 180;
  }
  return in_range(option, text, angle, lower, upper, " radians (or 23deg)");
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  hold_standard_streams();
  const auto complain = [&](const std::string& message, int code) {
    std::cerr << app.get_name() << ": " << in_one_line(message) << '\n';
    return code;
  };
  const auto parse = [&] {
    std::vector<std::string> words = well_formed(app, {argv + 1, argv + argc});
    std::reverse(words.begin(), words.end());  // as CLI11 wants them
    try {
      app.parse(words);
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
    std::cout << app.help();
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

}  // namespace talus::io
