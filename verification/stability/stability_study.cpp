// What the interior point takes from rest, and where Newton in plain double precision stops.
#include <algorithm>
#include <limits>

#include "verification/harness/fit.hpp"
#include "verification/harness/methods.hpp"
#include "verification/stability/stability_parts.hpp"

namespace talus::verification {

void interior_point_counts(Chapter& chapter, const Context& context) {
  constexpr int most_allowed = 15;
  const int most_elements = context.full ? 5120 : 1280;
  io::Table table{"Factorisations of the interior point, from rest to a relative gap of 1e-10",
                  {"scene", "mesh"},
                  {}};
  for (const int n : doubled_elements(most_elements)) table.header.push_back(std::to_string(n));
  NamedMethod method = reference_method();
  method.options.interior_point.tolerance = 1e-10;
  for (const auto& scene : oned::scenes())
    for (const auto& order_case : scene.order_cases) {
      table.rows.push_back({scene.name, order_case.name});
      int failures = 0;
      double most = 0;
      for (const auto& mesh : doubled_meshes(order_case.mesh, most_elements)) {
        const auto solution = oned::solve(scene, oned::boundaries(scene, mesh), method.options);
        if (solution.end != solve::End::converged) ++failures;
        most = solve::nan_max(
            most, if_counts(solution.end == solve::End::converged, solution.iterations()));
        table.rows.back().push_back(std::to_string(solution.iterations()));
      }
      table.rows.back().resize(table.header.size());
      const std::string label = scene.name + ", " + order_case.name + ", interior point: ";
      chapter.check(Kind::self_consistency, label + "meshes on which it does not converge",
                    failures, 0, 0);
      chapter.check(Kind::self_consistency, label + "most factorisations", most, 1, most_allowed);
    }
  chapter.table(std::move(table));
}

void round_off_floor(Chapter& chapter, const Context&) {
  io::Panel panel{"where Newton in plain double stops",
                  "computed floor, relative",
                  "final residual, relative",
                  true,
                  true,
                  {}};
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  double largest_compensated = 0;
  for (const auto& scene : oned::scenes()) {
    io::Curve plain{scene.name + ", plain", {}, {}, io::Style::points};
    io::Curve compensated{scene.name + ", compensated", {}, {}, io::Style::points};
    for (const int elements : doubled_elements(1280))
      for (const double lambda_r : swept_lambda_r()) {
        NamedMethod method = newton_method(rheology::ChauchatMedale{}, lambda_r);
        method.options.newton.tolerance = 1e-18;  // let it go down as far as it can
        for (io::Curve* curve : {&plain, &compensated}) {
          method.options.precision =
              curve == &plain ? solve::Precision::plain : solve::Precision::compensated;
          const auto& newton =
              oned::solve(scene, oned::boundaries(scene, {.elements = elements}), method.options)
                  .newton.newton;
          curve->x.push_back(newton.round_off_floor());
          curve->y.push_back(std::max(newton.final_residual(), 1e-18));
          const double ratio = newton.final_residual() / newton.round_off_floor();
          if (curve == &plain) {
            smallest = solve::nan_min(smallest, ratio);
            largest = solve::nan_max(largest, ratio);
          } else {
            largest_compensated = solve::nan_max(largest_compensated, newton.final_residual());
          }
        }
      }
    panel.curves.push_back(plain);
    panel.curves.push_back(compensated);
  }
  panel.curves.push_back({"residual = floor", {1e-16, 1}, {1e-16, 1}, io::Style::dashed});
  chapter.check(Kind::self_consistency, "plain double: largest final residual over computed floor",
                largest, 0, 1);
  chapter.check(Kind::self_consistency, "plain double: smallest final residual over computed floor",
                smallest, 1e-3, 1);
  chapter.check(Kind::self_consistency, "compensated: largest final residual, λr down to 1e-12",
                largest_compensated, 0, 1e-10);
  chapter.figure(
      {"floor",
       "Chute and inclined plane on a line, eq. (12), 5 to 1280 elements, λr from 1e-2 to 1e-12. "
       "Where the residual in plain double ends, against the floor computed with it, "
       "ε Σ|contributions| plus what rounding of the velocities makes of the stress: at " +
           known(smallest, 2) + " to " + known(largest, 2) +
           " of it. With the rounding of the iterate kept, residuals end at " +
           known(largest_compensated, 2) + " at most.",
       {panel},
       1});
}

}  // namespace talus::verification
