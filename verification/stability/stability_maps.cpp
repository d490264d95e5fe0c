// Maps over λr and the mesh: how every solve from rest ends, and what happens without one
// ingredient.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "verification/harness/methods.hpp"
#include "verification/stability/line_answer.hpp"
#include "verification/stability/stability_parts.hpp"

namespace talus::verification {
namespace {

constexpr int most_iterations_allowed = 40;
// Velocities are of order 1. Under a free surface, where the viscosity vanishes, a residual of
// 1e-12 leaves up to 2e-8 in them.
constexpr double largest_error_allowed = 1e-9;

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

// Of the ends that a figure shows: " Unmarked cells converged. S: stagnated."
std::string meaning_of_marks(const std::set<solve::End>& ends) {
  std::string text = " Unmarked cells converged.";
  for (const solve::End end : ends) {
    if (end == solve::End::converged) continue;
    std::string name = solve::name_of(end);
    std::ranges::replace(name, '_', ' ');
    text += std::string(" ") + mark_of(end) + ": " + name + ".";
  }
  return text + (std::ranges::all_of(ends, solve::is_success) ? "" : " Grey: no success.");
}

// Distances are in the maximum norm.
struct MapResult {
  io::Map map;
  std::map<solve::End, int> ends;
  int cells = 0, successes = 0, most_iterations = 0;
  double largest_error = 0;     // of a success, from the answer found element by element
  double largest_distance = 0;  // of a success from the reference, over λr
  // The same over what theory says it is, where that can be told from round-off.
  double smallest_ratio = std::numeric_limits<double>::infinity(), largest_ratio = 0;

  double if_all_succeed(double value) const { return if_counts(successes == cells, value); }
};

// What successes on a mesh are measured against: the reference solved, and as it should be.
struct Reference {
  int elements;
  oned::Solution solved;
  Eigen::VectorXd in_theory;
};
using References = std::vector<Reference>;

// Of eq. (4), or of the law itself next to its limit.
RateLaw limit_of(const oned::ShearScene& scene, const NamedMethod& method) {
  if (has_yield_stress(method)) return rate_of(scene.law());
  return rate_of(
      {scene.law(), method.options.regularisation, reference_for(method).options.lambda_r});
}

References references_for(const oned::ShearScene& scene, const NamedMethod& method,
                          int most_elements) {
  References references;
  for (const int elements : doubled_elements(most_elements)) {
    auto solved = solve_or_nan(scene, oned::boundaries(scene, {.elements = elements}),
                               reference_for(method).options);
    auto in_theory = line_answer(scene, solved.space, limit_of(scene, method));
    references.push_back({elements, std::move(solved), std::move(in_theory)});
  }
  return references;
}

double max_distance(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd difference = a - b;
  return difference.hasNaN() ? std::numeric_limits<double>::quiet_NaN()
                             : difference.lpNorm<Eigen::Infinity>();
}

// A success and the reference against theory.
void measure(MapResult& result, const oned::ShearScene& scene, const NamedMethod& method,
             const oned::Solution& solution, const Reference& reference) {
  constexpr double told_from_round_off = 100 * largest_error_allowed;
  const double lambda_r = method.options.lambda_r;
  const Eigen::VectorXd& found = solution.velocity.value();
  const Eigen::VectorXd in_theory = line_answer(
      scene, solution.space, rate_of({scene.law(), method.options.regularisation, lambda_r}));
  const double distance = max_distance(found, reference.solved.velocity.value());
  const double expected = max_distance(in_theory, reference.in_theory);
  result.largest_error = solve::nan_max(result.largest_error, max_distance(found, in_theory));
  if (expected < told_from_round_off) return;
  result.smallest_ratio = solve::nan_min(result.smallest_ratio, distance / expected);
  result.largest_ratio = solve::nan_max(result.largest_ratio, distance / expected);
}

// Every λr on every mesh, from rest; against theory too if it is a way to recommend.
MapResult sweep(const oned::ShearScene& scene, NamedMethod method, bool recommended,
                const References& references) {
  MapResult result;
  result.map.value_label = "Newton iterations";
  result.map.largest = most_iterations_allowed;
  for (const Reference& reference : references)
    result.map.columns.push_back(std::to_string(reference.elements));
  for (const double lambda_r : swept_lambda_r()) {
    method.options.lambda_r = lambda_r;
    result.map.rows.push_back(short_power(lambda_r));
    result.map.values.emplace_back();
    result.map.marks.emplace_back();
    for (const Reference& reference : references) {
      const auto solution = oned::solve(
          scene, oned::boundaries(scene, {.elements = reference.elements}), method.options);
      const bool success = solve::is_success(solution.end);
      ++result.cells;
      ++result.ends[solution.end];
      if (success) {
        result.most_iterations = std::max(result.most_iterations, solution.iterations());
        ++result.successes;
        result.largest_distance = solve::nan_max(
            result.largest_distance,
            max_distance(solution.velocity.value(), reference.solved.velocity.value()) / lambda_r);
        if (recommended) measure(result, scene, method, solution, reference);
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
  const auto newtonian = [length = scene.length, f = scene.body_force(0),
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
    o.continuation = shear::Continuation::on_failure;
  });
  without("frozen viscosity (η' dropped)",
          [](oned::SolveOptions& o) { o.tangent_term = shear::TangentTerm::frozen; });
  without("η' with the wrong sign",
          [](oned::SolveOptions& o) { o.tangent_term = shear::TangentTerm::wrong_sign; });
  return variants;
}

}  // namespace

std::vector<double> swept_lambda_r() {
  std::vector<double> values;
  for (int k = 2; k <= 12; ++k) values.push_back(std::pow(10.0, -k));
  return values;
}

void maps(Chapter& chapter, const Context& context) {
  chapter.text(
      "Every cell of the maps is one solve from rest without fallback. A success is checked "
      "against the interior point on the same mesh, or, for the control law without yield stress, "
      "against itself at λr = 1e-14: a wrong one would be silent. The limits of rest are those of "
      "eq. (4); the control law is left out of them because it is never at rest. The ends are "
      "explained in docs/theory.md.");
  io::Table table{"How the cells of the maps end",
                  {"scene", "variant", "cells", "ends", "most iterations",
                   "largest |w - w(reference)| / λr", "largest |w - w(theory)|"},
                  {}};
  const auto scenes = oned::scenes();
  std::size_t done = 0;
  for (const auto& scene : scenes) {
    const auto variants = map_variants(scene);
    const int most_elements = context.full ? 5120 : 1280;
    const References certified = references_for(scene, reference_method(), most_elements);
    io::Figure ours{"maps_" + scene.name,
                    "The " + scene.title +
                        " on a line: Newton iterations from rest over λr and the number of "
                        "elements.",
                    {},
                    2};
    io::Figure less{"maps_less_" + scene.name,
                    "The " + scene.title +
                        " on a line under eq. (12), with one thing taken away: Newton iterations "
                        "from rest.",
                    {},
                    2};
    std::set<solve::End> usual_ends, changed_ends;
    Ends usual{scene.name + ", line"}, changed{scene.name + ", line", false};
    for (const auto& [method, recommended] : variants) {
      const MapResult result =
          has_yield_stress(method)
              ? sweep(scene, method, recommended, certified)
              : sweep(scene, method, recommended, references_for(scene, method, most_elements));
      (recommended ? ours : less)
          .panels.push_back(
              {scene.name + ": " + method.label, "elements", "λr", false, false, {}, result.map});
      std::string ends;
      for (const auto& [end, count] : result.ends) {
        ends += (ends.empty() ? "" : ", ") + solve::name_of(end) + " " + std::to_string(count);
        (recommended ? usual_ends : changed_ends).insert(end);
        (recommended ? usual : changed)
            .counts[solve::is_success(end) ? arrival : solve::name_of(end)] += count;
      }
      table.rows.push_back({scene.name, method.label, std::to_string(result.cells), ends,
                            std::to_string(result.most_iterations),
                            io::rounded(result.largest_distance, 3),
                            recommended ? io::rounded(result.largest_error, 2) : ""});
      if (recommended) {
        const std::string label = scene.name + ", " + method.label;
        chapter.check(Kind::self_consistency, label + ": cells of the map without success",
                      result.cells - result.successes, 0, 0);
        chapter.check(Kind::self_consistency, label + ": most Newton iterations",
                      result.if_all_succeed(result.most_iterations), 1, most_iterations_allowed);
        chapter.check(Kind::other_method,
                      label + ": farthest velocity from the answer found element by element",
                      result.if_all_succeed(result.largest_error), 0, largest_error_allowed);
        chapter.check(Kind::other_method,
                      label + ": smallest distance from the reference, over that in theory",
                      result.if_all_succeed(result.smallest_ratio), 0.99, 1.01);
        chapter.check(Kind::other_method,
                      label + ": largest distance from the reference, over that in theory",
                      result.if_all_succeed(result.largest_ratio), 0.99, 1.01);
      } else if (method.options.tangent_term == shear::TangentTerm::wrong_sign) {
        chapter.check(Kind::control, scene.name + ", wrong sign of η': successes (must be few)",
                      result.successes, 0, result.cells / 2);
      }
      context.progress(static_cast<double>(++done) /
                       static_cast<double>(scenes.size() * variants.size()));
    }
    chapter.ends.push_back(std::move(usual));
    chapter.ends.push_back(std::move(changed));
    ours.caption += meaning_of_marks(usual_ends);
    less.caption += meaning_of_marks(changed_ends);
    chapter.figure(std::move(ours));
    chapter.figure(std::move(less));
  }
  chapter.table(std::move(table));
}

}  // namespace talus::verification
