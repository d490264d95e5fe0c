// The limits of existence, swept from both sides: what a mesh makes of them.
#include <algorithm>
#include <cmath>
#include <functional>

#include "verification/harness/methods.hpp"
#include "verification/stability/stability_parts.hpp"

namespace talus::verification {
namespace {

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
  int false_flows = 0;   // successes of Newton for flows that do not exist
  int unseen_rest = 0;   // rest that the interior point does not certify
  int false_rest = 0;    // rest of the discrete problem where the exact one flows
  int failures = 0;      // of Newton although a steady state exists
  double undecided = 0;  // a load at which the interior point ends neither way: how far, relative,
                         // the farthest lies from the limit that bisection then finds
};

io::Curve sweep_load(const oned::ShearScene& scene, int elements, int loads, LimitCounts& counts) {
  io::Curve newton{"Newton, λr 1e-6, n = " + std::to_string(elements), {}, {}, io::Style::points};
  for (int i = 0; i < loads; ++i) {
    const double load = scene.load.fast + (scene.load.rest - scene.load.fast) * i / (loads - 1);
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

std::vector<std::string> discrete_limits(const oned::ShearScene& scene, int elements,
                                         LimitCounts& counts) {
  std::vector<double> undecided;
  // That a flow exists takes a gap, not one at round-off; the certificates know no tolerance.
  oned::SolveOptions deciding = reference_method().options;
  deciding.interior_point.tolerance = 1e-6;
  const auto certificate = [&](double load) {
    const auto loaded = scene.load.scene(load);
    auto solution = oned::solve(loaded, oned::boundaries(loaded, {.elements = elements}), deciding);
    const bool flows_not = solution.end == solve::End::no_steady_state;
    if (!flows_not && !solve::is_success(solution.end)) undecided.push_back(load);
    return solution;
  };
  const auto has_regime = [&](rheology::Regime regime) {
    return [&scene, regime](double load) { return scene.load.scene(load).regime() == regime; };
  };
  // A load at which the interior point decides nothing leaves the limit open by its distance.
  const oned::LoadSweep& load = scene.load;
  const auto discrete = [&](double outside, const std::function<bool(double)>& is_outside) {
    const double limit = bisect(load.usual, outside, is_outside);
    for (const double each : undecided)
      counts.undecided = solve::nan_max(counts.undecided, std::abs(each / limit - 1));
    undecided.clear();
    return io::rounded(limit, 8);
  };
  return {
      scene.name,
      std::to_string(elements),
      io::rounded(bisect(load.usual, load.fast, has_regime(rheology::Regime::no_steady_state)), 8),
      discrete(load.fast,
               [&](double value) { return certificate(value).end == solve::End::no_steady_state; }),
      io::rounded(bisect(load.usual, load.rest, has_regime(rheology::Regime::at_rest)), 8),
      discrete(load.rest, [&](double value) { return certificate(value).interior_point.at_rest; })};
}

}  // namespace

void limits(Chapter& chapter, const Context& context) {
  chapter.text(
      "Past the load μ2 p no steady flow exists, but a mesh tests the stress at its quadrature "
      "points only, which may stay inside. Then Newton returns a converged number for a flow that "
      "does not exist: the programs test the load first. The "
      "interior point says no_steady_state where the discrete problem itself has no solution, and "
      "rest where a stress in equilibrium stays within yield.");
  io::Figure figure{
      "limits",
      "Largest velocity of each scene on a line against its load, Newton under eq. (12). Where "
      "there is no exact curve the points are creep (side of rest) or numbers without a flow "
      "(fast side).",
      {},
      2};
  io::Table table{
      "Limits of existence: exact, and of the discrete problem by the interior point's "
      "certificates",
      {"scene", "elements", "exact limit of flow", "discrete", "exact limit of rest", "discrete"},
      {}};
  const int loads = context.full ? 161 : 81;
  for (const auto& scene : oned::scenes()) {
    io::Panel panel{scene.name, scene.load.symbol, "largest velocity / sqrt(gd)", false, true, {}};
    io::Curve exact{"exact", {}, {}, io::Style::line};
    for (int i = 0; i < 4 * loads; ++i) {
      const double load =
          scene.load.fast + (scene.load.rest - scene.load.fast) * i / (4 * loads - 1);
      const auto loaded = scene.load.scene(load);
      if (loaded.regime() != rheology::Regime::flowing) continue;
      exact.x.push_back(load);
      exact.y.push_back(std::max(loaded.exact_velocity(0), loaded.exact_velocity(loaded.length)));
    }
    panel.curves.push_back(exact);
    LimitCounts counts;
    for (const int elements : {10, 40, 160}) {
      panel.curves.push_back(sweep_load(scene, elements, loads, counts));
      table.rows.push_back(discrete_limits(scene, elements, counts));
    }
    chapter.check(Kind::other_method,
                  scene.name + ": loads with a steady state at which Newton fails", counts.failures,
                  0, 0);
    chapter.check(Kind::self_consistency,
                  scene.name + ": loads at rest that the interior point does not certify",
                  counts.unseen_rest, 0, 0);
    chapter.check(Kind::other_method,
                  scene.name + ": discrete limits, farthest load that is not decided",
                  counts.undecided, 0, 1e-3);
    chapter.text(scene.name + ", three meshes of " + std::to_string(loads) +
                 " loads each: Newton returned a number for " + std::to_string(counts.false_flows) +
                 " loads past the exact limit of flow, and the discrete problem rests at " +
                 std::to_string(counts.false_rest) +
                 " loads where the exact one flows. The discrete limits are open by up to " +
                 io::rounded(counts.undecided, 2) +
                 " of the load: so near, the interior point decides nothing.");
    figure.panels.push_back(panel);
  }
  chapter.figure(std::move(figure));
  chapter.table(std::move(table));
}

}  // namespace talus::verification
