#include "common/io/options.hpp"

#include <charconv>
#include <cmath>
#include <iostream>

#include "common/io/table.hpp"

namespace talus::io {
namespace {

template <class Number>
std::string out_of_range(const std::string& text, Number lower, Number upper) {
  std::string range, kind;
  if constexpr (std::is_integral_v<Number>) {
    kind = "a whole number";
    range = std::to_string(lower) + " ... " + std::to_string(upper);
  } else {
    kind = "a number";
    range = rounded(lower, 6) + " ... " + rounded(upper, 6);
  }
  return "'" + text + "' is not " + kind + " in the allowed range " + range;
}

// An empty message if `text` is entirely a number within the range.
template <class Number>
std::string check_range(const std::string& text, Number lower, Number upper, Number& value) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  const bool valid = error == std::errc() && stop == end && value >= lower && value <= upper;
  return valid ? std::string() : out_of_range(text, lower, upper);
}

template <class Number>
Number in_range(const std::string& option, const std::string& text, Number lower, Number upper) {
  Number value = 0;
  const std::string message = check_range(text, lower, upper, value);
  if (!message.empty()) throw UserError(option + ": " + message);
  return value;
}

template <class Number>
CLI::Validator within(Number lower, Number upper) {
  return {[=](std::string& text) {
            Number ignored;
            return check_range(text, lower, upper, ignored);
          },
          ""};
}

template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& name, Number& value,
                        const std::string& description, Number lower, Number upper,
                        const std::string& range) {
  return app.add_option(name, value, description + " [" + range + "]")
      ->check(within(lower, upper))
      ->capture_default_str();
}

}  // namespace

CLI::Option* add_integer(CLI::App& app, const std::string& name, int& value,
                         const std::string& description, int lower, int upper) {
  return add_number(app, name, value, description, lower, upper,
                    std::to_string(lower) + " ... " + std::to_string(upper));
}

CLI::Option* add_real(CLI::App& app, const std::string& name, double& value,
                      const std::string& description, double lower, double upper) {
  return add_number(app, name, value, description, lower, upper,
                    rounded(lower, 6) + " ... " + rounded(upper, 6));
}

CLI::Option* add_reals(CLI::App& app, const std::string& name, std::vector<double>& values,
                       const std::string& description, double lower, double upper) {
  return app
      .add_option(name, values,
                  description + " [each " + rounded(lower, 6) + " ... " + rounded(upper, 6) + "]")
      ->delimiter(',')
      ->check(within(lower, upper))
      ->capture_default_str();
}

CLI::Option* add_choice(CLI::App& app, const std::string& name, std::string& value,
                        const std::string& description, const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
  return app.add_option(name, value, description + " [" + list + "]")
      ->check(CLI::Validator(
          [=](std::string& text) {
            for (const std::string& each : names)
              if (text == each) return std::string();
            return "'" + text + "' is none of: " + list;
          },
          ""))
      ->capture_default_str();
}

double real_in_range(const std::string& option, const std::string& text, double lower,
                     double upper) {
  return in_range(option, text, lower, upper);
}

int whole_in_range(const std::string& option, const std::string& text, int lower, int upper) {
  return in_range(option, text, lower, upper);
}

int run_program(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  const auto complain = [&](const std::string& message, int code) {
    std::cerr << app.get_name() << ": " << message << '\n';
    return code;
  };
  try {
    app.parse(argc, argv);
    return body();
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    return complain(std::string(error.what()) + " (see --help)", 2);
  } catch (const UserError& error) {
    return complain(error.what(), 2);
  } catch (const std::exception& error) {
    return complain(error.what(), 1);
  }
}

}  // namespace talus::io
