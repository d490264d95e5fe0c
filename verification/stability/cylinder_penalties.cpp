// What the penalty parameter does on the way to a flow past yield.
#include <cmath>

#include "verification/harness/methods.hpp"
#include "verification/stability/cylinder_atlas.hpp"
#include "verification/stability/stability_parts.hpp"

namespace talus::verification {
namespace {

bool is_iterated(const mixed::PenaltyOptions& penalty) {
  return penalty.kind == mixed::Penalty::iterated;
}

// Where the iterated penalty is meant to be used: larger ones stall its iterations, smaller ones
// lose the digits of the matrix.
bool conditions_well(const mixed::PenaltyOptions& penalty) {
  return is_iterated(penalty) && penalty.lambda_p < 2e-4 && penalty.lambda_p > 0.5e-8;
}

std::string label_of(const mixed::PenaltyOptions& penalty) {
  return is_iterated(penalty) ? "iterated" : "plain";
}

// λp from 1e-2 to 1e-12, from rest to a flow past yield.
PenaltyPaths penalty_paths(const rheology::Regularisation& law, double lambda_r, bool full) {
  twod::Cylinder scene = cylinder_around(16, law);
  scene.lambda_r = lambda_r;
  const auto solved = [&](const mixed::PenaltyOptions& penalty) {
    scene.penalty = penalty;
    return along_lambda_r(scene, 0.052, twod::Continuation::arclength, 60);
  };
  const std::vector<double> lambda_ps =
      full ? std::vector{1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12} : std::vector{1e-4, 1e-8, 1e-12};
  PenaltyPaths paths{law, solved({}), {}};
  for (const auto kind : {mixed::Penalty::iterated, mixed::Penalty::plain})
    for (const double lambda_p : lambda_ps) {
      const mixed::PenaltyOptions penalty{kind, lambda_p};
      paths.tried.push_back({penalty, solved(penalty)});
    }
  return paths;
}

void add_rows(io::Table& table, const PenaltyPaths& paths) {
  for (const auto& [penalty, f] : paths.tried)
    table.rows.push_back({rheology::name_of(paths.law), label_of(penalty),
                          short_power(penalty.lambda_p), solve::name_of(f.end),
                          std::to_string(f.points.size()), std::to_string(f.factorisations),
                          f.arrived() ? io::rounded(f.last().mean_velocity, 5) : "",
                          f.arrived() ? io::rounded(f.last().drag, 5) : "",
                          f.arrived() ? io::rounded(f.last().projected_divergence, 2) : ""});
}

}  // namespace

void judge_penalties(Chapter& chapter, const PenaltyPaths& paths) {
  const auto flow_of = [](const Followed& f, double twod::CylinderMeasures::*measure) {
    return if_counts(f.arrived(), f.last().*measure);
  };
  const double drag = flow_of(paths.usual, &twod::CylinderMeasures::drag);
  double worst = 0;
  int compared = 0;
  std::string not_arrived;
  for (const auto& [penalty, f] : paths.tried) {
    if (conditions_well(penalty)) {
      worst = solve::nan_max(worst, std::abs(flow_of(f, &twod::CylinderMeasures::drag) / drag - 1));
      ++compared;
    }
    if (!f.arrived())
      not_arrived += (not_arrived.empty() ? "" : ", ") + label_of(penalty) + " " +
                     short_power(penalty.lambda_p);
  }
  const std::string name = rheology::name_of(paths.law) + ", past yield, ";
  // At rest the drag is the buoyancy, whatever the penalty.
  const bool flows =
      chapter.check(Kind::self_consistency, name + "usual penalty: U, a flow's",
                    flow_of(paths.usual, &twod::CylinderMeasures::mean_velocity), 0.01, 1);
  const bool agree = chapter.check(
      Kind::self_consistency, name + "iterated penalty, λp from 1e-8 to 1e-4: change of the drag",
      if_counts(compared > 0, worst), 0, 1e-4);
  chapter.text(
      "Penalties past yield, " + rheology::name_of(paths.law) + ": " +
      (not_arrived.empty() ? "every path arrived" : "paths that did not arrive: " + not_arrived) +
      (flows && agree ? "; the iterated penalty leaves the drag as it is, λp from 1e-8 "
                        "to 1e-4."
                      : "; the iterated penalty should leave the drag as it is, λp from "
                        "1e-8 to 1e-4, but a check of that fails."));
}

void cylinder_penalties(Chapter& chapter, const Context& context) {
  const double lambda_r = context.full ? 1e-6 : 1e-4;
  io::Table table{
      "Penalty past yield: paths in λr from 0.1 to " + short_power(lambda_r) +
          " at F = 0.052, 16 elements around",
      {"law", "penalty", "λp", "end", "points", "factorisations", "U", "F_D", "projected div u"},
      {}};
  for (const auto& law : laws_of_paths()) {
    if (!context.full && rheology::has_yield_stress(law)) continue;
    const PenaltyPaths paths = penalty_paths(law, lambda_r, context.full);
    judge_penalties(chapter, paths);
    add_rows(table, paths);
  }
  chapter.table(std::move(table));
}

}  // namespace talus::verification
