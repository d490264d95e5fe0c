// What an error of the heap's flow rate costs: meshes, walls, methods.
#include <cmath>

#include "twod/section.hpp"
#include "verification/cost_parts.hpp"

namespace talus::verification {
namespace {

constexpr double angle = 0.42;
// As in the study heap, from the interior point on meshes graded quadratically up to 140x200.
constexpr double limit_rate = 82.495;

struct Method {
  std::string label;
  flow::ShearOptions options;
};

std::vector<Method> methods() {
  std::vector<Method> methods = {{"interior point", twod::default_options()}};
  for (const auto& [label, lambda_r] :
       {std::pair{"Newton, λr 1e-5", 1e-5}, {"Newton, λr 1e-8", 1e-8}})
    methods.push_back({label, twod::newton_options(lambda_r)});
  return methods;
}

}  // namespace

void add_section_cost(Chapter& chapter, const Context& context) {
  const std::vector<int> acrosses =
      context.full ? std::vector{9, 18, 35, 70, 140} : std::vector{9, 18, 25};
  io::Figure figure{
      "cost_section",
      "Q* of the heap's section at α = 0.42 against CPU time, every point a mesh (" +
          std::to_string(acrosses.front()) + " to " + std::to_string(acrosses.back()) +
          " elements across, Newton to 70). What λr = 1e-5 adds, 2e-4, has the sign opposite to "
          "the error of the "
          "mesh: it helps until they cancel, and is what is left on finer meshes. At 1e-8 Newton "
          "has the error and the cost of the interior point.",
      {},
      2};
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
    panel.key = "bottom left Left reverse";
    for (const double grading : {1.0, 2.0})
      for (const Method& method : methods()) {
        io::Curve curve{method.label + (grading > 1 ? ", graded" : ", uniform"), {}, {}};
        for (const int across : acrosses) {
          // The finest one for what the other is measured against.
          if (across > 70 && method.options.method != flow::Method::interior_point) continue;
          auto space = twod::space_of(section, {across, (across * 10 + 6) / 7, grading, grading});
          const auto solution = twod::solve(section, space, method.options);
          if (!solve::is_success(solution.end)) {
            ++failures;
            continue;
          }
          curve.x.push_back(solution.seconds);
          curve.y.push_back(std::abs(twod::flow_rate(solution, space) / limit_rate - 1));
        }
        panel.curves.push_back(curve);
      }
    figure.panels.push_back(panel);
  }
  chapter.check("heap section: solves that did not succeed", failures, 0, 0);
  chapter.figure(std::move(figure));
}

}  // namespace talus::verification
