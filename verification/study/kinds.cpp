#include "verification/study/kinds.hpp"

#include <algorithm>

#include "common/io/options.hpp"

namespace talus::study {
namespace {

void admit_any(const Table&) {}

void admit_sweep(const Table& table) {
  axis_of_sweep(table);
}

void admit_stability(const Table& table) {
  if (table.axes().empty()) throw io::UserError("stability: no option has several values");
}

void admit_ladder(const Table& table) {
  if (std::ranges::none_of(table.axes(), [](const Varied& axis) { return axis.name == "--model"; }))
    throw io::UserError("ladder: it takes several values of --model");
}

}  // namespace

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"converge", "How fast does the error fall with the size of the elements?", false, admit_any,
       converge},
      {"cost", "What is the cheapest way to a given error?", true, admit_any, cost},
      {"stability", "Where does a solve arrive, and how does it end elsewhere?", false,
       admit_stability, stability},
      {"sweep", "How does the flow depend on an option?", false, admit_sweep, sweep},
      {"ladder", "Which model does the scene need, and what do richer ones cost?", true,
       admit_ladder, ladder}};
  return all;
}

const Kind& kind_named(const std::string& name) {
  std::string known;
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
    known += (known.empty() ? "" : ", ") + kind.name;
  }
  throw io::UserError("KIND: '" + name + "' is none of: " + known + io::did_you_mean(name, names));
}

}  // namespace talus::study
