// What a study produces: checks against bounds, with the text, tables and figures around them.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "common/io/figure.hpp"
#include "common/io/table.hpp"
#include "oned/shear_scene.hpp"
#include "verification/harness/given_curves.hpp"
#include "verification/harness/reference.hpp"

namespace talus::verification {

/// A number and the bounds it must keep, both included. NaN keeps none.
struct Check {
  std::string what;
  double value = 0, lower = 0, upper = 0;
  Kind kind = Kind::self_consistency;
  bool passed() const { return value >= lower && value <= upper; }
};

/// What the front page of the report asks.
enum class Question { speed_against_accuracy, where_methods_fail, which_model, flows };

/// A figure that answers one of them, and what it shows, in a sentence made from its numbers.
struct Headline {
  Question question;
  io::Figure figure;
  std::string sentence;
};

/// How solves of a kind end: the names of the ends and how many met each, `arrival` among them.
struct Ends {
  std::string of;              ///< scene and model
  bool is_recommended = true;  ///< or a way with something missing
  std::map<std::string, int> counts = {};
};
inline constexpr const char* arrival = "arrives";

/// A chapter of the report, or what a part of a study adds to it.
struct Chapter {
  std::string name, title;
  std::vector<std::variant<std::string, io::Table, io::Figure>> blocks;  ///< text, tables, figures
  std::vector<Check> checks;
  std::vector<std::string> answers = {};  ///< to its question, from what was computed
  std::vector<Headline> headlines = {};
  std::vector<Ends> ends = {};  ///< counted together with those of other parts

  void text(std::string paragraph) { blocks.emplace_back(std::move(paragraph)); }
  void table(io::Table table) { blocks.emplace_back(std::move(table)); }
  void figure(io::Figure figure) { blocks.emplace_back(std::move(figure)); }
  void answer(std::string sentence) { answers.push_back(std::move(sentence)); }
  /// Its first place is the front page of the report; the sentence is an answer of the chapter too.
  void headline(Question question, io::Figure figure, std::string sentence) {
    answer(sentence);
    headlines.push_back({question, std::move(figure), std::move(sentence)});
  }
  /// A number within the uncertainty of another's.
  bool check(const std::string& what, double value, const Reference& reference) {
    return check(reference.kind, what + " (" + reference.source + ")", value,
                 reference.value - reference.uncertainty, reference.value + reference.uncertainty);
  }
  /// Returns whether it holds, for the sentences that rest on it.
  bool check(Kind kind, std::string what, double value, double lower, double upper) {
    checks.push_back({std::move(what), value, lower, upper, kind});
    return checks.back().passed();
  }
  bool passed() const {
    for (const Check& each : checks)
      if (!each.passed()) return false;
    return true;
  }
};

/// How much a part does, whom it tells how far it is, and what the user gave to be drawn.
struct Context {
  bool full = false;
  std::function<void(double fraction)> progress = [](double) {};
  std::vector<GivenCurve> given = {};
};

/// CPU minutes that a part takes, measured on `measured_on`.
struct Minutes {
  double quick = 0, full = 0;
  double of(bool is_full) const { return is_full ? full : quick; }
};
inline constexpr const char* measured_on = "one core of a 2-core virtual machine";

/// What one process does of a study: its share of the chapter.
struct Part {
  std::string name;  ///< of its own within the study; none if it is all of it
  std::function<void(Chapter&, const Context&)> run;
  Minutes minutes = {};
  bool is_timing = false;  ///< CPU time is what it is about: nothing may run beside it
};

struct Study {
  std::string name, question;
  std::vector<Part> parts;                    ///< in the order of the report
  std::vector<OpenFigure> open_figures = {};  ///< those in which --data is drawn

  /// STUDY or STUDY/PART: what `verify` calls it, and the folder of its files.
  std::string name_of(const Part& part) const {
    return part.name.empty() ? name : name + "/" + part.name;
  }
  Minutes minutes() const {
    Minutes sum;
    for (const Part& part : parts) {
      sum.quick += part.minutes.quick;
      sum.full += part.minutes.full;
    }
    return sum;
  }
};

/// The registry, in the order of the report.
const std::vector<Study>& studies();

/// Chapters of the full report that other programs leave, to be merged: those of `mutants`.
inline const std::vector<Study>& studies_elsewhere() {
  static const std::vector<Study> all = {
      {"mutants", "How many one-line mistakes are noticed?", {{"", {}, {}}}}};
  return all;
}

}  // namespace talus::verification
