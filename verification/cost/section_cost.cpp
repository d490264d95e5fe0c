// What an error of the heap's flow rate costs: meshes, walls, methods.
#include <algorithm>
#include <cmath>

#include "twod/section.hpp"
#include "verification/cost/cost_parts.hpp"
#include "verification/harness/fit.hpp"
#include "verification/harness/methods.hpp"
#include "verification/references/references.hpp"

namespace talus::verification {
namespace {

constexpr double angle = 0.42;
constexpr double limit_rate = references::heap_flow_rate_limit.value;

struct Method {
  std::string label;
  shear::ShearOptions options;
};

std::vector<Method> methods() {
  std::vector<Method> methods = {{"interior point", twod::default_options()}};
  for (const auto& [label, lambda_r] :
       {std::pair{"Newton, λr 1e-5", 1e-5}, {"Newton, λr 1e-8", 1e-8}})
    methods.push_back({label, twod::newton_options(lambda_r)});
  return methods;
}

// What λr does on the same mesh, in parts of Q*: of the interior point its distance from the limit,
// of Newton that from the interior point.
class Distances {
 public:
  void add(std::size_t method, double rate) {
    if (method == 0) own_ = rate;
    ranges_.resize(std::max(ranges_.size(), method + 1));
    ranges_[method].add((rate - (method == 0 ? limit_rate : own_)) / limit_rate);
  }
  std::string caption(const std::vector<Method>& methods) const {
    std::string text = "The " + methods.front().label + " is off the limit by " +
                       ranges_.front().text(2) + " of Q*";
    for (std::size_t i = 1; i < methods.size(); ++i)
      text += ", " + methods[i].label + " off the " + methods.front().label +
              " on the same mesh by " + ranges_[i].text(2);
    return text + ". Distances of opposite sign cancel on some mesh between.";
  }

 private:
  double own_ = std::nan("");  // the interior point's on this mesh
  std::vector<Range> ranges_;
};

}  // namespace

void section_costs(Chapter& chapter, const Context& context) {
  const std::vector<int> acrosses =
      context.full ? std::vector{9, 18, 35, 70, 140} : std::vector{9, 18, 25};
  io::Figure figure{"cost_section", "", {}, 2};
  const std::vector<Method> all_methods = methods();
  Distances distances;
  int failures = 0;
  for (const twod::Wall wall : {twod::Wall::no_slip, twod::Wall::friction}) {
    twod::Section section;
    section.angle = angle;
    section.wall = wall;
    io::Panel panel{wall == twod::Wall::no_slip ? "Q*, no slip" : "Q*, relaxed wall",
                    "CPU seconds",
                    "relative error",
                    true,
                    true,
                    {}};
    for (const double grading : {1.0, 2.0}) {
      std::vector<io::Curve> curves;
      for (const Method& method : all_methods)
        curves.push_back({method.label + (grading > 1 ? ", graded" : ", uniform"), {}, {}});
      for (const int across : acrosses)
        for (std::size_t i = 0; i < all_methods.size(); ++i) {
          const shear::ShearOptions& options = all_methods[i].options;
          // The finest one for what the other is measured against.
          if (across > 70 && options.method != shear::Method::interior_point) continue;
          auto space = twod::space_of(section, {across, (across * 10 + 6) / 7, grading, grading});
          const auto solution = twod::solve(section, space, options);
          failures += solve::is_success(solution.end) ? 0 : 1;
          const double rate = if_success(solution.end, twod::flow_rate(solution, space));
          distances.add(i, rate);
          curves[i].x.push_back(solution.seconds);
          curves[i].y.push_back(std::abs(rate / limit_rate - 1));
        }
      panel.curves.insert(panel.curves.end(), curves.begin(), curves.end());
    }
    figure.panels.push_back(panel);
  }
  chapter.check(Kind::self_consistency, "heap section: solves that did not succeed", failures, 0,
                0);
  figure.caption =
      "Error of Q* of the heap's section at α = 0.42 against CPU time, every point a mesh (" +
      std::to_string(acrosses.front()) + " to " + std::to_string(acrosses.back()) +
      " elements across, Newton to 70). " + distances.caption(all_methods);
  chapter.figure(std::move(figure));
}

}  // namespace talus::verification
