#include "verification/study/kinds.hpp"

#include <algorithm>

#include "common/io/options.hpp"

namespace talus::study {

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      {"converge", "How fast does the error fall with the size of the elements?", false, converge},
      {"cost", "What is the cheapest way to a given error?", true, cost},
      {"stability", "Where does a solve arrive, and how does it end elsewhere?", false, stability},
      {"sweep", "How does the flow depend on an option?", false, sweep},
      {"ladder", "Which model does the scene need, and what do richer ones cost?", true, ladder}};
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
