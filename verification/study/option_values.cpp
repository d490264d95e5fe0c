#include "verification/study/option_values.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "common/io/options.hpp"
#include "common/io/table.hpp"

namespace talus::study {
namespace {

constexpr int most_values = 10000;

// Numbers with what stands between and behind them: 9x13 is two, joined by "x"; 23deg is one.
struct Numbers {
  std::vector<double> values;
  std::string unit;
};

class Range {
 public:
  Range(std::string option, std::string type, std::string text)
      : option_(std::move(option)), type_(std::move(type)), text_(std::move(text)) {}

  std::vector<std::string> values() const {
    const auto parts = io::split(text_, ':');
    if (parts.size() == 1) return parts;
    if (parts.size() != 3 || parts[2].empty()) throw refused("is no range A:B:N, A:B:+d or A:B:x2");
    const Numbers first = numbers(parts[0]), last = numbers(parts[1]);
    if (first.unit != last.unit || first.values.size() != last.values.size())
      throw refused("begins and ends with different kinds of values");
    const char how = parts[2][0];
    const std::string amount = how == 'x' || how == '/' ? parts[2].substr(1) : parts[2];
    const double by = number(how == '+' ? amount.substr(1) : amount);
    if (how == 'x' || how == '/') return by_factor(first, last, how == 'x' ? by : 1 / by);
    if (type_ == "MESH") throw refused("is no range of meshes, such as 9x13:72x104:x2");
    const double from = first.values[0], to = last.values[0];
    if (how == '+' || how == '-') return by_steps(from, to, by, first.unit);
    return evenly(from, to, by, first.unit);
  }

 private:
  io::UserError refused(const std::string& why) const {
    return io::UserError(option_ + ": '" + text_ + "' " + why);
  }

  double number(const std::string& text) const {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      throw refused("holds '" + text + "', which is no number");
    return value;
  }

  Numbers numbers(const std::string& text) const {
    if (type_ == "MESH") {
      Numbers all{{}, "x"};
      for (const std::string& part : io::split(text, 'x')) all.values.push_back(number(part));
      return all;
    }
    const bool has_unit = type_ == "ANGLE" && text.ends_with("deg");
    return {{number(has_unit ? text.substr(0, text.size() - 3) : text)}, has_unit ? "deg" : ""};
  }

  // 0.05, not the 0.049999999999999996 of the formula.
  std::string shown(double value, const std::string& unit) const {
    if (type_ == "INT" && value != std::round(value))
      throw refused("leads to " + io::rounded(value, 6) + ", which is no whole number");
    return io::exact(io::number_in(io::rounded(value, 12))) + unit;
  }

  std::vector<std::string> evenly(double from, double to, double count,
                                  const std::string& unit) const {
    if (count != std::round(count) || count < 2 || count > most_values)
      throw refused("asks for " + io::rounded(count, 6) + " values, not 2 ... " +
                    std::to_string(most_values));
    std::vector<std::string> all;
    for (int i = 0; i < count; ++i)
      all.push_back(shown(from + (to - from) * i / (count - 1), unit));
    return all;
  }

  std::vector<std::string> by_steps(double from, double to, double step,
                                    const std::string& unit) const {
    if (!((to - from) * step > 0) || (to - from) / step >= most_values)
      throw refused("does not come from A to B in steps of d");
    std::vector<std::string> all;
    const int last = static_cast<int>(std::floor((to - from) / step * (1 + 1e-9)));
    for (int i = 0; i <= last; ++i) all.push_back(shown(from + i * step, unit));
    return all;
  }

  std::vector<std::string> by_factor(const Numbers& first, const Numbers& last,
                                     double factor) const {
    const double ratio = last.values[0] / first.values[0];
    const double steps = std::log(ratio) / std::log(factor);
    if (!(ratio > 0) || !(factor > 0) || !(steps >= 0) || steps >= most_values)
      throw refused("does not come from A to B by factors of k");
    std::vector<std::string> all;
    for (int i = 0; i <= static_cast<int>(std::floor(steps * (1 + 1e-9))); ++i) {
      std::string value;
      for (std::size_t k = 0; k < first.values.size(); ++k) {
        const double each = first.values[k] * std::pow(factor, i);
        value += (k == 0 ? "" : first.unit) + shown(type_ == "MESH" ? std::round(each) : each, "");
      }
      all.push_back(value + (type_ == "MESH" ? "" : first.unit));
    }
    return all;
  }

  std::string option_, type_, text_;
};

}  // namespace

std::vector<std::string> values_of(const std::string& option, const std::string& type,
                                   const std::string& text) {
  const bool has_ranges = type == "INT" || type == "FLOAT" || type == "ANGLE" || type == "MESH";
  if (!has_ranges && type != "NAME") return {text};
  std::vector<std::string> all;
  for (const std::string& part : io::split(text, ',')) {
    if (part.empty()) throw io::UserError(option + ": '" + text + "' has an empty value");
    for (const std::string& value :
         has_ranges ? Range(option, type, part).values() : std::vector<std::string>{part})
      all.push_back(value);
  }
  if (std::set(all.begin(), all.end()).size() != all.size())
    throw io::UserError(option + ": '" + text + "' gives a value twice");
  return all;
}

}  // namespace talus::study
