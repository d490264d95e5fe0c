// Maps over λr and the mesh: how every solve from rest ends, and what happens without one
// ingredient.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "verification/methods.hpp"
#include "verification/stability_parts.hpp"

namespace talus::verification {
namespace {

constexpr int most_iterations_allowed = 40;

char mark_of(solve::End end) {
  switch (end) {
    case solve::End::converged:
      return ' ';
    case solve::End::at_round_off_floor:
      return 'f';
    case solve::End::stagnated:
      return 'S';
    case solve::End::line_search_failed:
      return 'L';
    case solve::End::linear_solver_failed:
      return 'X';
    case solve::End::non_finite:
      return 'N';
    case solve::End::no_steady_state:
      return 'U';
    case solve::End::out_of_memory:
      return 'M';
  }
  return '?';
}

struct MapResult {
  io::Map map;
  std::map<solve::End, int> ends;
  int cells = 0, most_iterations = 0;
  double largest_distance = 0;  // from the reference, over λr, in the maximum norm
};

// The answer on every mesh that successes are measured against.
using References = std::vector<std::pair<int, oned::Solution>>;

References references_for(const oned::ShearScene& scene, const NamedMethod& method,
                          int most_elements) {
  References references;
  for (const int elements : doubled_elements(most_elements))
    references.emplace_back(elements,
                            oned::solve(scene, oned::boundaries(scene, {.elements = elements}),
                                        reference_for(method).options));
  return references;
}

double max_distance(const oned::Solution& a, const oned::Solution& b) {
  return (a.velocity.value() - b.velocity.value()).lpNorm<Eigen::Infinity>();
}

// Every λr on every mesh, from rest.
MapResult sweep(const oned::ShearScene& scene, NamedMethod method, const References& references) {
  MapResult result;
  result.map.value_label = "Newton iterations";
  result.map.largest = most_iterations_allowed;
  for (const auto& [elements, reference] : references)
    result.map.columns.push_back(std::to_string(elements));
  for (const double lambda_r : swept_lambda_r()) {
    method.options.lambda_r = lambda_r;
    result.map.rows.push_back(short_power(lambda_r));
    result.map.values.emplace_back();
    result.map.marks.emplace_back();
    for (const auto& [elements, reference] : references) {
      const auto solution =
          oned::solve(scene, oned::boundaries(scene, {.elements = elements}), method.options);
      const bool success = solve::is_success(solution.end);
      ++result.cells;
      ++result.ends[solution.end];
      if (success) {
        result.most_iterations = std::max(result.most_iterations, solution.iterations());
        result.largest_distance =
            std::max(result.largest_distance, max_distance(solution, reference) / lambda_r);
      }
      result.map.values.back().push_back(success ? solution.iterations()
                                                 : std::numeric_limits<double>::quiet_NaN());
      result.map.marks.back().push_back(
          solution.end == solve::End::converged ? "" : std::string(1, mark_of(solution.end)));
    }
  }
  return result;
}

// The recommended method with every regularisation, and eq. (12) with one thing taken away.
std::vector<std::pair<NamedMethod, bool>> map_variants(const oned::ShearScene& scene) {
  std::vector<std::pair<NamedMethod, bool>> variants;
  for (const NamedMethod& method : newton_methods(1e-6)) variants.emplace_back(method, true);
  const auto without = [&](const std::string& label, auto&& change) {
    NamedMethod method = newton_method(rheology::ChauchatMedale{}, 1e-6);
    method.label = "eq. (12), " + label;
    change(method.options);
    variants.emplace_back(method, false);
  };
  without("iterate in double",
          [](oned::SolveOptions& o) { o.precision = solve::Precision::plain; });
  without("full steps, no line search",
          [](oned::SolveOptions& o) { o.newton.line_search = solve::LineSearch::none; });
  // The profile of a fluid of viscosity 1: sheared everywhere, stopped by no plug.
  const auto newtonian = [length = scene.length, f = scene.body_force,
                          wall_at_start = scene.wall_at_start](double x) {
    const double from_free_end = wall_at_start ? length - x : x;
    return 0.5 * f * (length * length - from_free_end * from_free_end);
  };
  without("from a Newtonian profile", [&](oned::SolveOptions& o) { o.start = newtonian; });
  without("from a Newtonian profile, full steps", [&](oned::SolveOptions& o) {
    o.start = newtonian;
    o.newton.line_search = solve::LineSearch::none;
  });
  without("from a Newtonian profile, with the fallback", [&](oned::SolveOptions& o) {
    o.start = newtonian;
    o.continuation = flow::Continuation::on_failure;
  });
  without("frozen viscosity (η' dropped)",
          [](oned::SolveOptions& o) { o.tangent_term = flow::TangentTerm::frozen; });
  without("η' with the wrong sign",
          [](oned::SolveOptions& o) { o.tangent_term = flow::TangentTerm::wrong_sign; });
  return variants;
}

}  // namespace

std::vector<double> swept_lambda_r() {
  std::vector<double> values;
  for (int k = 2; k <= 12; ++k) values.push_back(std::pow(10.0, -k));
  return values;
}

void add_maps(Chapter& chapter, const Context& context) {
  io::Table table{
      "How the cells of the maps end",
      {"scene", "variant", "cells", "ends", "most iterations", "largest |w - w(reference)| / λr"},
      {}};
  const auto scenes = oned::scenes();
  std::size_t done = 0;
  for (const auto& scene : scenes) {
    const auto variants = map_variants(scene);
    const int most_elements = context.full ? 5120 : 1280;
    const References certified = references_for(scene, reference_method(), most_elements);
    io::Figure ours{"maps_" + scene.name,
                    "Newton iterations from rest over λr and the number of elements; unmarked "
                    "cells converged, f: at the round-off floor.",
                    {},
                    2};
    io::Figure less{"maps_less_" + scene.name,
                    "The same with one thing taken away. f: at the round-off floor, S: stagnated, "
                    "L: line search failed, X: linear solver failed, N: not finite, U: no steady "
                    "state.",
                    {},
                    2};
    for (const auto& [method, recommended] : variants) {
      const MapResult result =
          has_yield_stress(method)
              ? sweep(scene, method, certified)
              : sweep(scene, method, references_for(scene, method, most_elements));
      (recommended ? ours : less)
          .panels.push_back(
              {scene.name + ": " + method.label, "elements", "λr", false, false, {}, result.map});
      std::string ends;
      int successes = 0;
      for (const auto& [end, count] : result.ends) {
        if (solve::is_success(end)) successes += count;
        ends += (ends.empty() ? "" : ", ") + solve::name_of(end) + " " + std::to_string(count);
      }
      table.rows.push_back({scene.name, method.label, std::to_string(result.cells), ends,
                            std::to_string(result.most_iterations),
                            io::rounded(result.largest_distance, 3)});
      if (recommended) {
        const std::string label = scene.name + ", " + method.label;
        chapter.check(label + ": cells of the map without success", result.cells - successes, 0, 0);
        chapter.check(label + ": most Newton iterations", result.most_iterations, 1,
                      most_iterations_allowed);
        chapter.check(label + ": distance of any success from the reference, over λr",
                      result.largest_distance, 0, 1000);
      } else if (method.options.tangent_term == flow::TangentTerm::wrong_sign) {
        chapter.check(scene.name + ", wrong sign of η': successes (must be few)", successes, 0,
                      result.cells / 2);
      }
      context.progress(0.8 * static_cast<double>(++done) /
                       static_cast<double>(scenes.size() * variants.size()));
    }
    chapter.figure(std::move(ours));
    chapter.figure(std::move(less));
  }
  chapter.table(std::move(table));
}

}  // namespace talus::verification
