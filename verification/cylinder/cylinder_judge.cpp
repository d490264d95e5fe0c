// What is said of the cylinder's creep and of its sweeps: a run that fails, or rests, fails a
// check.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "verification/cylinder/cylinder_parts.hpp"
#include "verification/harness/methods.hpp"
#include "verification/references/references.hpp"

namespace talus::verification {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
std::string percent(double share) {
  return io::rounded(100 * share, 2) + "%";
}

}  // namespace

double velocity_over_lambda_r(const twod::CylinderMeasures& measures) {
  return measures.mean_velocity / measures.lambda_r;
}

void judge_meshes(Chapter& chapter, const std::vector<FinerMeshes>& runs, double room) {
  double worst_imbalance = 0, worst_projected = 0, least_gain = 0;
  for (const auto& [loading, creeps] : runs) {
    double coarser = infinity;  // its divergence
    for (const Creep& creep : creeps) {
      const auto& m = creep.measures;
      worst_imbalance = solve::nan_max(worst_imbalance, std::abs(m.imbalance()));
      worst_projected = solve::nan_max(worst_projected, m.projected_divergence);
      least_gain = solve::nan_max(least_gain, m.divergence / coarser);
      coarser = m.divergence;
    }
    const auto& [drag, velocity] = references::cylinder_creep(loading);
    const auto& finest = creeps.back().measures;
    const std::string name = "F = " + io::rounded(loading) + ": ";
    chapter.check(name + "drag on the finest mesh", finest.drag, drag.within(room));
    chapter.check(name + "U on the finest mesh", finest.mean_velocity, velocity.within(room));
  }
  const bool balances =
      chapter.check(Kind::self_consistency, "weight against walls and cylinder: worst imbalance",
                    worst_imbalance, 0, 1e-10);
  const bool is_solenoidal = chapter.check(Kind::self_consistency, "projected divergence: worst",
                                           worst_projected, 0, 1e-12);
  const bool falls =
      chapter.check(Kind::self_consistency,
                    "div u on a mesh over that on the next coarser one: worst", least_gain, 0, 0.9);
  chapter.text(
      std::string("Creep, below F ≈ 0.049. Weight, wall friction and drag ") +
      (balances ? "balance to round-off." : "should balance to round-off, but a check fails.") +
      " The divergence as far as the pressures see it " +
      (is_solenoidal ? "is round-off" : "should be round-off, but a check fails") +
      "; what is left of div u, the error of the elements, " +
      (falls ? "falls with their size." : "should fall with their size, but a check fails.") +
      " The traction integral needs the stress where it is resolved worst; the reactions do not.");
}

void judge_halves(Chapter& chapter, const Creep& half, const Creep& full) {
  const bool agree = chapter.check(Kind::other_method,
                                   "drag on the full domain against the half: relative distance",
                                   std::abs(full.measures.drag / half.measures.drag - 1), 0, 1e-9);
  // At rest they would agree as well.
  const bool creeps = chapter.check(Kind::other_method, "half domain: U over λr",
                                    velocity_over_lambda_r(half.measures), 1.5, 2.5);
  chapter.text(agree && creeps
                   ? "The flow keeps its symmetry: half the domain gives the same digits, for " +
                         io::rounded(half.seconds / full.seconds, 2) + " of the CPU time."
                   : "Half the domain should give the digits of the whole, but a check fails.");
}

// What moves, moves with λr: the drag of a column at rest is its buoyancy, which would agree with
// itself.
void judge_outlets(Chapter& chapter, const std::vector<OutletPair>& pairs, const Creep& all_open) {
  double worst_drag = 0, worst_velocity = 0, slowest = infinity, nearest = infinity;
  for (const auto& [place, developed, open] : pairs) {
    const auto apart = [&](double twod::CylinderMeasures::*measure) {
      return std::abs(open.measures.*measure / developed.measures.*measure - 1);
    };
    worst_drag = solve::nan_max(worst_drag, apart(&twod::CylinderMeasures::drag));
    worst_velocity = solve::nan_max(worst_velocity, apart(&twod::CylinderMeasures::mean_velocity));
    slowest = solve::nan_min(slowest, velocity_over_lambda_r(developed.measures));
    nearest = std::min(nearest, place);
  }
  bool agree = chapter.check(Kind::self_consistency, "developed outlet: U over λr, slowest place",
                             slowest, 2, 5);
  agree &=
      chapter.check(Kind::other_method,
                    "open outlet, pressure given: drag apart from the developed one, worst place",
                    worst_drag, 0, 0.05);
  agree &= chapter.check(Kind::other_method,
                         "open outlet, pressure given: U apart from the developed one, worst place",
                         worst_velocity, 0, 0.2);
  const double buoyancy = -std::numbers::pi / 4 * 0.044;
  bool rests = chapter.check(Kind::self_consistency, "open outlet, pressure open too: |U|",
                             std::abs(all_open.measures.mean_velocity), 0, 1e-9);
  rests &=
      chapter.check(Kind::self_consistency, "open outlet, pressure open too: drag over buoyancy",
                    all_open.measures.drag / buoyancy, 0.98, 1.02);
  chapter.text(
      std::string(
          "The paper's open boundary keeps the boundary term of the weak form with the "
          "unknowns in it. If the pressure is left open as well, nothing fixes its level: ") +
      (rests ? "the column rests on the outlet and nothing flows."
             : "the column should rest on the outlet, but a check of that fails.") +
      (agree ? " With the pressure given and the viscous part open, the drag differs by " +
                   percent(worst_drag) + " at most, U by " + percent(worst_velocity) +
                   ", in outlets as near as " + io::rounded(nearest) + " diameters."
             : " With the pressure given and the viscous part open, drag and U should be near "
               "those of the developed outlet, but a check of that fails."));
}

std::string Sweep::label() const {
  return rheology::name_of(law) + ", " + twod::name_of(continuation) +
         (inertia ? "" : ", no inertia");
}

void judge_sweep(Chapter& chapter, const Sweep& sweep, const Followed& f) {
  const std::string name = sweep.label() + ": ";
  const double reached = f.largest_loading(), velocity = velocity_over_lambda_r(f.last());
  if (rheology::has_yield_stress(sweep.law) && sweep.is_natural()) {
    // Where it ends is its fold, if the mesh has one.
    chapter.check(Kind::self_consistency, name + "largest loading", reached, 0.044, beyond);
    chapter.check(Kind::self_consistency, name + "U over λr where the sweep stops: creep or more",
                  velocity, 2, infinity);
    return;
  }
  if (rheology::has_yield_stress(sweep.law)) {
    chapter.check(Kind::self_consistency, name + "largest loading, past yield at 0.049", reached,
                  0.0495, beyond);
    chapter.check(Kind::self_consistency,
                  name + "share of the area with C > 0 where the sweep stops",
                  f.last().ill_posed_share, 0.01, 1);
  } else if (sweep.goes_beyond()) {
    // The walls alone carry 0.065; only inertia stops the sweep before.
    chapter.check(Kind::self_consistency, name + "largest loading", reached,
                  sweep.inertia ? flowing : 0.065, beyond);
  } else {
    chapter.check(Kind::self_consistency, name + "loading reached", f.last().loading, flowing,
                  flowing);
    chapter.check(Kind::self_consistency, name + "folds", if_counts(f.arrived(), f.folds()), 0, 0);
    chapter.check(Kind::self_consistency, name + "share of the area with C > 0 there",
                  f.last().ill_posed_share, 0, 0.005);
  }
  chapter.check(Kind::self_consistency,
                name + "U over λr where the sweep stops: beyond creep, which has 2 to 10", velocity,
                20, infinity);
}

}  // namespace talus::verification
