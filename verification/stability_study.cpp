// Where solves end, and how: maps over λr and mesh, the limits of existence, the round-off floor.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "verification/chapter.hpp"
#include "verification/methods.hpp"

namespace talus::verification {
namespace {

constexpr int most_iterations_allowed = 40;

char mark_of(solve::End end) {
  switch (end) {
    case solve::End::converged: return ' ';
    case solve::End::at_round_off_floor: return 'f';
    case solve::End::stagnated: return 'S';
    case solve::End::line_search_failed: return 'L';
    case solve::End::linear_solver_failed: return 'X';
    case solve::End::non_finite: return 'N';
    case solve::End::no_steady_state: return 'U';
  }
  return '?';
}

std::vector<double> swept_lambda_r() {
  std::vector<double> values;
  for (int k = 2; k <= 12; ++k) values.push_back(std::pow(10.0, -k));
  return values;
}

struct MapResult {
  io::Map map;
  std::map<solve::End, int> ends;
  int cells = 0, most_iterations = 0;
  double largest_distance = 0;  // from the interior point, over λr, in the maximum norm
};

double max_distance(const oned::Solution& a, const oned::Solution& b) {
  return (a.velocity.value() - b.velocity.value()).lpNorm<Eigen::Infinity>();
}

// Every λr on every mesh, from rest.
MapResult sweep(const oned::ShearScene& scene, NamedMethod method,
                const std::vector<std::pair<int, oned::Solution>>& references) {
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
      result.map.values.back().push_back(
          success ? solution.iterations() : std::numeric_limits<double>::quiet_NaN());
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
    o.continuation = true;
  });
  without("frozen viscosity (η' dropped)",
          [](oned::SolveOptions& o) { o.tangent_term = flow::TangentTerm::frozen; });
  without("η' with the wrong sign",
          [](oned::SolveOptions& o) { o.tangent_term = flow::TangentTerm::wrong_sign; });
  return variants;
}

void maps(Chapter& chapter, const Context& context) {
  io::Table table{"How the cells of the maps end",
                  {"scene", "variant", "cells", "converged", "at_round_off_floor", "stagnated",
                   "line_search_failed", "linear_solver_failed", "non_finite", "no_steady_state",
                   "most iterations",
                   "largest |w - w(interior point)| / λr"},
                  {}};
  const auto scenes = oned::scenes();
  std::size_t done = 0;
  for (const auto& scene : scenes) {
    const auto variants = map_variants(scene);
    std::vector<std::pair<int, oned::Solution>> references;
    for (const int elements : doubled_elements(context.full ? 5120 : 1280)) {
      references.emplace_back(elements,
                              oned::solve(scene, oned::boundaries(scene, {.elements = elements}),
                                          reference_method().options));
      chapter.check(scene.name + ", interior point, " + std::to_string(elements) +
                        " elements: factorisations to a gap of 1e-14",
                    solve::is_success(references.back().second.end)
                        ? references.back().second.iterations()
                        : std::numeric_limits<double>::quiet_NaN(),
                    1, 20);
    }
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
      const MapResult result = sweep(scene, method, references);
      (recommended ? ours : less)
          .panels.push_back({scene.name + ": " + method.label, "elements", "λr", false, false, {},
                             result.map});
      std::vector<std::string> row = {scene.name, method.label, std::to_string(result.cells)};
      int successes = 0;
      for (const solve::End end : solve::all_ends) {
        const auto found = result.ends.find(end);
        const int count = found == result.ends.end() ? 0 : found->second;
        if (solve::is_success(end)) successes += count;
        row.push_back(std::to_string(count));
      }
      row.push_back(std::to_string(result.most_iterations));
      row.push_back(io::rounded(result.largest_distance, 3));
      table.rows.push_back(row);
      if (recommended) {
        const std::string label = scene.name + ", " + method.label;
        chapter.check(label + ": cells of the map without success", result.cells - successes, 0, 0);
        chapter.check(label + ": most Newton iterations", result.most_iterations, 1,
                      most_iterations_allowed);
        chapter.check(label + ": distance of any success from the interior point, over λr",
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

double largest_velocity(const oned::Solution& solution) {
  return solution.velocity.value().lpNorm<Eigen::Infinity>();
}

// The load at which `is_outside` changes between a load inside and one outside.
double bisect(double inside, double outside, const std::function<bool(double)>& is_outside) {
  for (int i = 0; i < 45; ++i) {
    const double middle = 0.5 * (inside + outside);
    (is_outside(middle) ? outside : inside) = middle;
  }
  return 0.5 * (inside + outside);
}

// Newton's and the interior point's answers over a sweep of the load, on one mesh.
struct LimitCounts {
  int false_flows = 0;    // successes of Newton for flows that do not exist
  int unseen_rest = 0;    // rest that the interior point does not certify
  int false_rest = 0;     // rest of the discrete problem where the exact one flows
  int failures = 0;       // of Newton although a steady state exists
};

io::Curve sweep_load(const oned::ShearScene& scene, int elements, int loads, LimitCounts& counts) {
  io::Curve newton{"Newton, λr 1e-6, n = " + std::to_string(elements), {}, {}, io::Style::points};
  for (int i = 0; i < loads; ++i) {
    const double load =
        scene.load.fast + (scene.load.rest - scene.load.fast) * i / (loads - 1);
    const auto loaded = scene.load.scene(load);
    const auto line = oned::boundaries(loaded, {.elements = elements});
    const auto solution =
        oned::solve(loaded, line, newton_method(rheology::ChauchatMedale{}, 1e-6).options);
    const auto certified = oned::solve(loaded, line, reference_method().options);
    const auto regime = loaded.regime();
    const bool success = solve::is_success(solution.end);
    if (success) {
      newton.x.push_back(load);
      newton.y.push_back(largest_velocity(solution));
    }
    if (success && regime == rheology::Regime::no_steady_state) ++counts.false_flows;
    if (!success && regime != rheology::Regime::no_steady_state) ++counts.failures;
    const bool at_rest = certified.interior_point.at_rest;
    if (!at_rest && regime == rheology::Regime::at_rest) ++counts.unseen_rest;
    if (at_rest && regime != rheology::Regime::at_rest) ++counts.false_rest;
  }
  return newton;
}

std::vector<std::string> discrete_limits(const oned::ShearScene& scene, int elements) {
  const auto certificate = [&](double load) {
    const auto loaded = scene.load.scene(load);
    return oned::solve(loaded, oned::boundaries(loaded, {.elements = elements}),
                       reference_method().options);
  };
  const auto has_regime = [&](rheology::Regime regime) {
    return [&scene, regime](double load) { return scene.load.scene(load).regime() == regime; };
  };
  const oned::LoadSweep& load = scene.load;
  return {scene.name,
          std::to_string(elements),
          io::rounded(bisect(load.usual, load.fast, has_regime(rheology::Regime::no_steady_state)),
                      8),
          io::rounded(bisect(load.usual, load.fast,
                             [&](double value) {
                               return certificate(value).end == solve::End::no_steady_state;
                             }),
                      8),
          io::rounded(bisect(load.usual, load.rest, has_regime(rheology::Regime::at_rest)), 8),
          io::rounded(bisect(load.usual, load.rest,
                             [&](double value) {
                               return certificate(value).interior_point.at_rest;
                             }),
                      8)};
}

void limits(Chapter& chapter, const Context& context) {
  chapter.text(
      "Past the load μ2 p no steady flow exists, but a mesh tests the stress at its quadrature "
      "points only, which stay inside. Between the exact limit and that of the mesh, Newton returns "
      "a converged number for a flow that does not exist: the programs test the load first. The "
      "interior point says no_steady_state where the discrete problem itself has no solution, and "
      "rest where a stress in equilibrium stays within yield.");
  io::Figure figure{"limits",
                    "Largest velocity against the load. Where there is no exact curve the points are "
                    "creep (side of rest) or numbers without a flow (fast side).",
                    {},
                    2};
  io::Table table{"Limits of existence: exact, and of the discrete problem by the interior point's "
                  "certificates",
                  {"scene", "elements", "exact limit of flow", "discrete", "exact limit of rest",
                   "discrete"},
                  {}};
  const int loads = context.full ? 161 : 81;
  for (const auto& scene : oned::scenes()) {
    io::Panel panel{scene.name, scene.load.symbol, "largest velocity", false, true, {},
                    std::nullopt, "top center"};
    io::Curve exact{"exact", {}, {}, io::Style::line};
    for (int i = 0; i < 4 * loads; ++i) {
      const double load =
          scene.load.fast + (scene.load.rest - scene.load.fast) * i / (4 * loads - 1);
      const auto loaded = scene.load.scene(load);
      if (loaded.regime() != rheology::Regime::flowing) continue;
      exact.x.push_back(load);
      exact.y.push_back(
          std::max(loaded.exact_velocity(0), loaded.exact_velocity(loaded.length)));
    }
    panel.curves.push_back(exact);
    LimitCounts counts;
    for (const int elements : {10, 40, 160}) {
      panel.curves.push_back(sweep_load(scene, elements, loads, counts));
      table.rows.push_back(discrete_limits(scene, elements));
    }
    chapter.check(scene.name + ": loads with a steady state at which Newton fails",
                  counts.failures, 0, 0);
    chapter.check(scene.name + ": loads at rest that the interior point does not certify",
                  counts.unseen_rest, 0, 0);
    chapter.text(scene.name + ", three meshes of " + std::to_string(loads) +
                 " loads each: Newton returned a number for " +
                 std::to_string(counts.false_flows) +
                 " loads past the exact limit of flow, and the discrete problem rests at " +
                 std::to_string(counts.false_rest) + " loads where the exact one flows.");
    figure.panels.push_back(panel);
  }
  chapter.figure(std::move(figure));
  chapter.table(std::move(table));
}

// Final residual of plain double precision against the computed floor.
void floor(Chapter& chapter) {
  io::Panel panel{"where Newton in plain double stops", "computed floor", "final residual", true,
                  true, {}, std::nullopt, "top left"};
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
            smallest = std::min(smallest, ratio);
            largest = std::max(largest, ratio);
          } else {
            largest_compensated = std::max(largest_compensated, newton.final_residual());
          }
        }
      }
    panel.curves.push_back(plain);
    panel.curves.push_back(compensated);
  }
  panel.curves.push_back({"residual = floor", {1e-16, 1}, {1e-16, 1}, io::Style::dashed});
  chapter.check("plain double: largest final residual over computed floor", largest, 0, 1);
  chapter.check("plain double: smallest final residual over computed floor", smallest, 1e-3, 1);
  chapter.check("compensated: largest final residual, λr down to 1e-12", largest_compensated, 0,
                1e-10);
  chapter.figure({"floor",
                  "The residual in plain double ends a little below the floor computed with it: "
                  "ε Σ|contributions| plus what rounding of the velocities makes of the stress. With "
                  "the rounding of the iterate kept, residuals end near 1e-16 whatever λr.",
                  {panel},
                  1});
}

}  // namespace

Chapter stability_study(const Context& context) {
  Chapter chapter{"stability", "Where do the methods fail, and do they say so?", {}, {}};
  chapter.text(
      "Every cell of the maps is one solve from rest without fallback. A success is checked against "
      "the interior point on the same mesh: no silent wrong answer. The ends are explained in "
      "docs/theory.md.");
  maps(chapter, context);
  limits(chapter, context);
  context.progress(0.95);
  floor(chapter);
  return chapter;
}

}  // namespace talus::verification
