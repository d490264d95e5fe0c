#include "common/io/options.hpp"

#include <algorithm>
#include <charconv>
#include <numbers>
#include <optional>
#include <type_traits>

#include <CLI/CLI.hpp>

#include "common/io/table.hpp"

namespace talus::io {
namespace {

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

}  // namespace

Option add_value(CommandLine& line, const std::string& name, const std::string& type,
                 const std::string& description, const std::function<void(const std::string&)>& set,
                 const std::function<std::string()>& shown) {
  const auto take = [set](const CLI::results_t& words) {
    set(words.front());
    return true;
  };
  CLI::Option* option = shown ? line.app().add_option(name, take, description, true, shown)
                              : line.app().add_option(name, take, description);
  return Option(option->type_name(type));
}

Option add_flag(CommandLine& line, const std::string& name, bool& value,
                const std::string& description) {
  return Option(line.app().add_flag(name, value, description));
}

Option add_words(CommandLine& line, const std::string& name, std::vector<std::string>& words,
                 const std::string& description) {
  return Option(line.app().add_option(name, words, description));
}

Option add_integer(CommandLine& line, const std::string& name, int& value,
                   const std::string& description, int lower, int upper) {
  return add_value(
      line, name, "INT", description + " [" + range_of(lower, upper) + "]",
      [=, &value](const std::string& text) { value = whole_in_range(name, text, lower, upper); },
      [&value] { return std::to_string(value); });
}

Option add_real(CommandLine& line, const std::string& name, double& value,
                const std::string& description, double lower, double upper) {
  return add_value(
      line, name, "FLOAT", description + " [" + range_of(lower, upper) + "]",
      [=, &value](const std::string& text) { value = real_in_range(name, text, lower, upper); },
      [&value] { return rounded(value, 6); });
}

Option add_angle(CommandLine& line, const std::string& name, double& value,
                 const std::string& description, double lower, double upper) {
  return add_value(
      line, name, "ANGLE",
      description + ", in radians, or in degrees as 23deg [" + range_of(lower, upper) + "]",
      [=, &value](const std::string& text) { value = angle_in_range(name, text, lower, upper); },
      [&value] { return rounded(value, 6); });
}

Option add_reals(CommandLine& line, const std::string& name, std::vector<double>& values,
                 const std::string& description, double lower, double upper) {
  constexpr int most = 1000;
  return add_value(
             line, name, "FLOAT", description + " [each " + range_of(lower, upper) + "]",
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
      .takes(1, most);
}

Option add_choice(CommandLine& line, const std::string& name, std::string& value,
                  const std::string& description, const std::vector<std::string>& names,
                  const std::map<std::string, std::string>& older) {
  std::string list;
  for (const std::string& each : names) list += (list.empty() ? "" : ", ") + each;
  return add_value(
      line, name, "NAME", description + " [" + list + "]",
      [=, &value](const std::string& text) {
        const auto now = older.find(text);
        if (now == older.end() && std::find(names.begin(), names.end(), text) == names.end())
          throw UserError(name + ": '" + text + "' is none of: " + list +
                          did_you_mean(text, names));
        value = now == older.end() ? text : now->second;
      },
      [&value] { return value; });
}

Option add_text(CommandLine& line, const std::string& name, std::string& value,
                const std::string& description) {
  return add_value(
      line, name, "TEXT", description,
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

}  // namespace talus::io
