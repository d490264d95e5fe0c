#include "verification/mutants/instrument.hpp"

#include <algorithm>
#include <map>
#include <regex>

#include "common/io/options.hpp"
#include "common/io/result_folder.hpp"
#include "verification/mutants/expression.hpp"

namespace talus::mutants {
namespace {

// Lines as one, without comments.
std::string in_one_line(const std::string& lines) {
  if (lines.empty()) return "";
  std::string code;
  for (const std::string& line : io::split(lines, '\n'))
    code += (code.empty() ? "" : " ") + trimmed(without_comments(line));
  return code;
}

// Lines [begin, end) of a file.
struct Place {
  std::size_t begin, end;
  auto operator<=>(const Place&) const = default;
};

Place place_of(const std::vector<std::string>& lines, const Mutant& mutant) {
  std::vector<std::string> wanted;
  for (const std::string& line : io::split(mutant.original, '\n')) wanted.push_back(trimmed(line));
  std::vector<Place> places;
  for (std::size_t i = 0; i + wanted.size() <= lines.size(); ++i)
    if (std::equal(wanted.begin(), wanted.end(), lines.begin() + static_cast<std::ptrdiff_t>(i),
                   [](const auto& line, const auto& text) { return line == trimmed(text); }))
      places.push_back({i, i + wanted.size()});
  if (places.size() != 1)
    throw io::UserError(mutant.name + ": '" + mutant.original + "' stands " +
                        std::to_string(places.size()) + " times in " + mutant.file.string() +
                        ", not once");
  return places.front();
}

std::string is_chosen(int number) {
  return "talus::mutant::is(" + std::to_string(number) + ")";
}

// A mutant that differs within an expression of the code.
struct Alternative {
  int number;
  Form form;
  Span span;  // of the code
  std::string mutated;

  // What it puts in place of a larger piece of the code.
  std::string within(const std::string& code, Span piece) const {
    return mutated.substr(piece.begin, mutated.size() - (code.size() - piece.end) - piece.begin);
  }
};

bool is_statement_of_its_own(const std::string& code, Span span) {
  const std::string text = code.substr(span.begin, span.end - span.begin);
  static const std::regex keyword(R"(^(break|continue|return|if|for|while|throw)\b)");
  return std::regex_search(text, keyword) || text.empty() || !is_single(text) ||
         has_assignment(code, span);
}

// The pieces of the code in which mutants differ, none overlapping another, each with its mutants.
std::vector<std::pair<Span, std::vector<Alternative>>> pieces(
    const std::vector<Alternative>& alternatives) {
  std::vector<std::pair<Span, std::vector<Alternative>>> found;
  for (const Alternative& each : alternatives) {
    Span span = each.span;
    std::vector<Alternative> together{each};
    for (std::size_t i = 0; i < found.size();) {
      if (!found[i].first.overlaps(span)) {
        ++i;
        continue;
      }
      span = {std::min(span.begin, found[i].first.begin), std::max(span.end, found[i].first.end)};
      together.insert(together.end(), found[i].second.begin(), found[i].second.end());
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
    found.emplace_back(span, together);
  }
  std::ranges::sort(found, {}, [](const auto& piece) { return piece.first.begin; });
  return found;
}

std::string choice(const std::string& code, Span span,
                   const std::vector<Alternative>& alternatives) {
  std::string text = "(" + code.substr(span.begin, span.end - span.begin) + ")";
  for (const Alternative& each : alternatives) {
    const std::string mutated = "(" + each.within(code, span) + ")";
    text = each.form == Form::plain_object
               ? "talus::mutant::pick(" + is_chosen(each.number) + ", [&] { return " +
                     "talus::mutant::plain" + mutated + "; }, [&] { return talus::mutant::plain(" +
                     text + "); })"
               : "(" + is_chosen(each.number) + " ? " + mutated + " : " + text + ")";
  }
  return text;
}

// A constant that is to be chosen at run time.
std::string variable(const std::string& code) {
  static const std::map<std::string, std::string> beginnings{
      {"inline constexpr ", "inline const "},
      {"static constexpr ", "static inline const "},
      {"constexpr ", "const "}};
  for (const auto& [constant, other] : beginnings)
    if (code.starts_with(constant)) return other + code.substr(constant.size());
  return code;
}

std::string with_mutants(const std::string& code, const std::vector<Numbered>& mutants) {
  std::string statements;
  std::vector<Alternative> alternatives;
  for (const auto& [number, mutant] : mutants) {
    const std::string mutated = in_one_line(mutant->mutated);
    const Span differs = difference(code, mutated);
    const Span span = enclosing_expression(code, differs);
    const Span in_mutated{span.begin, mutated.size() + span.end - code.size()};
    const bool is_head = code.ends_with("{");  // of a loop or a condition
    if (mutated.empty() || (!is_head && (is_statement_of_its_own(code, span) ||
                                         is_statement_of_its_own(mutated, in_mutated))))
      statements += "if (" + is_chosen(number) + ") { " + mutated + " } else ";
    else
      alternatives.push_back({number, mutant->form, span, mutated});
  }
  std::string text;
  std::size_t done = 0;
  for (const auto& [span, together] : pieces(alternatives)) {
    text += code.substr(done, span.begin - done) + choice(code, span, together);
    done = span.end;
  }
  text = variable(text + code.substr(done));
  return statements.empty() ? text : statements + "{ " + text + " }";
}

}  // namespace

std::string instrumented(const std::string& text, const std::vector<Numbered>& mutants) {
  const std::vector<std::string> lines = io::split(text, '\n');
  std::map<Place, std::vector<Numbered>> places;
  for (const Numbered& each : mutants) places[place_of(lines, *each.mutant)].push_back(each);
  std::string result = std::string("#include \"") + choice_header_name + "\"\n";
  std::size_t next = 0;
  for (const auto& [place, here] : places) {
    if (place.begin < next)
      throw io::UserError(here.front().mutant->name + ": its lines overlap those of another");
    std::string code;
    for (; next < place.begin; ++next) result += lines[next] + "\n";
    for (; next < place.end; ++next) code += (code.empty() ? "" : "\n") + lines[next];
    result += with_mutants(in_one_line(code), here) + "\n";
  }
  for (; next < lines.size(); ++next) result += lines[next] + (next + 1 < lines.size() ? "\n" : "");
  return result;
}

std::string choice_header() {
  return R"(#pragma once
#include <cstdio>
#include <cstdlib>
#include <type_traits>

#include <fcntl.h>
#include <unistd.h>

namespace talus::mutant {

inline int number_of(const char* variable) {
  const char* const value = std::getenv(variable);
  return value != nullptr ? std::atoi(value) : -1;
}

inline void reach(int number) {
  static const char* const file = std::getenv("TALUS_MUTANTS_REACHED");
  static bool is_known[100000];
  if (file == nullptr || is_known[number]) return;
  is_known[number] = true;
  char text[16];
  const int length = std::snprintf(text, sizeof text, "%d\n", number);
  const int out = open(file, O_WRONLY | O_APPEND | O_CREAT, 0644);
  if (out < 0) return;
  // Where files may not grow, this one need not.
  if (write(out, text, static_cast<size_t>(length)) != length) is_known[number] = false;
  close(out);
}

inline bool is_at_run_time(int number) {
  static const int chosen = number_of("TALUS_MUTANT");
  reach(number);
  return chosen == number;
}

constexpr bool is(int number) {
  return std::is_constant_evaluated() ? false : is_at_run_time(number);
}

template <typename T>
auto plain(const T& value) {
  if constexpr (requires { typename T::PlainObject; })
    return typename T::PlainObject(value);
  else
    return value;
}

template <typename Mutated, typename Original>
auto pick(bool is_chosen, const Mutated& mutated, const Original& original) {
  return is_chosen ? mutated() : original();
}

}  // namespace talus::mutant
)";
}

}  // namespace talus::mutants
