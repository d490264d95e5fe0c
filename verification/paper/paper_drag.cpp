// The paper's Fig. 12: drag of the cylinder, and its coefficient.
#include <algorithm>
#include <cmath>
#include <limits>

#include "verification/harness/fit.hpp"
#include "verification/paper/paper_cylinder.hpp"

namespace talus::verification {
namespace {

constexpr double in_creep = 20;          // U/λr
constexpr double onset_of_flow = 0.049;  // F
constexpr double in_flow = 0.005;        // where the paper takes its solution for valid

// Drag at a velocity of the sweep, linear in log U; NaN outside.
double drag_at(const std::vector<twod::CylinderMeasures>& sweep, double velocity) {
  for (std::size_t i = 1; i < sweep.size(); ++i) {
    const double from = sweep[i - 1].mean_velocity, to = sweep[i].mean_velocity;
    if (velocity < from || velocity > to) continue;
    const double share = std::log(velocity / from) / std::log(to / from);
    return sweep[i - 1].drag + share * (sweep[i].drag - sweep[i - 1].drag);
  }
  return std::nan("");
}

std::string in_percent(double share) {
  return known(100 * share, 2) + "%";
}

}  // namespace

double DragCurve::end_of_creep() const {
  double velocity = std::nan("");
  for (const auto& m : sweep)
    if (m.mean_velocity < in_creep * m.lambda_r) velocity = m.mean_velocity;
  return velocity;
}

double DragCurve::exponent() const {
  std::vector<double> velocity, coefficient;
  for (const auto& m : sweep) {
    if (m.mean_velocity < in_flow) continue;
    velocity.push_back(m.mean_velocity);
    coefficient.push_back(m.drag_coefficient());
  }
  return fitted_order(velocity, coefficient);
}

double DragCurve::spread() const {
  double slowest = std::nan("");
  for (const auto& m : sweep)
    if (m.mean_velocity >= in_flow)
      slowest = solve::nan_min(m.mean_velocity, std::isnan(slowest) ? m.mean_velocity : slowest);
  // All of the curves flow from that of the largest pressure on, up to the end of the smallest.
  const auto [least, most] = std::ranges::minmax(confining_pressures);
  const double from = slowest * std::sqrt(most);
  const double to = sweep.empty() ? std::nan("") : sweep.back().mean_velocity * std::sqrt(least);
  constexpr int places = 50;
  double worst = if_counts(from < to, 1);
  for (int i = 0; i <= places; ++i) {
    const double froude = std::min(to, from * std::pow(to / from, static_cast<double>(i) / places));
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (const double p : confining_pressures) {
      const double drag = drag_at(sweep, froude / std::sqrt(p));
      smallest = solve::nan_min(smallest, drag);
      largest = solve::nan_max(largest, drag);
    }
    worst = solve::nan_max(worst, largest / smallest);
  }
  return worst;
}

double DragCurve::gain() const {
  const auto onset =
      std::ranges::find_if(sweep, [](const auto& m) { return m.loading >= onset_of_flow; });
  double largest = if_counts(onset != sweep.end(), 0);
  for (auto each = onset; each != sweep.end(); ++each)
    largest = solve::nan_max(largest, each->drag / onset->drag - 1);
  return largest;
}

double DragCurve::last_slope() const {
  if (sweep.size() < 2) return std::nan("");
  const auto &one = sweep[sweep.size() - 2], &other = sweep.back();
  return std::log(other.drag / one.drag) / std::log(other.mean_velocity / one.mean_velocity);
}

void judge_drag(PaperPage& page, const DragCurve& own, const DragCurve& well_posed,
                const DragCurve& coarse) {
  Chapter& chapter = page.chapter();
  bool holds = chapter.check(Kind::publication, "Fig. 12: Fr where creep ends, eq. (12), λr = 1e-6",
                             own.end_of_creep(), 2e-6, 5e-5);
  holds &= chapter.check(Kind::publication, "Fig. 12: Fr where creep ends, eq. (12), λr = 1e-3",
                         coarse.end_of_creep(), 2e-3, 2e-2);
  for (const auto& [law, curve] : {std::pair{"eq. (12)", &own}, {"barker-gray", &well_posed}}) {
    holds &= chapter.check(Kind::publication,
                           std::string("Fig. 12: drag gained from F = 0.049 on, ") + law,
                           curve->gain(), 0.05, 0.3);
    holds &= chapter.check(Kind::publication,
                           std::string("Fig. 12: slope of log drag where the sweep ends, ") + law,
                           curve->last_slope(), -0.1, 0.1);
  }
  page.item(
      "Fig. 12, drag",
      "its slope breaks at Fr ≈ 0.005, where creep ends; it tends to a value; in the end its "
      "dynamic part is as large as the static one",
      "creep ends at Fr = " + known(own.end_of_creep(), 2) + " (p_ext = 1), with λr = 1e-3 at " +
          known(coarse.end_of_creep(), 2) + "; in flow the drag gains " + in_percent(own.gain()) +
          ", with the well-posed law " + in_percent(well_posed.gain()) +
          ", and d log F_D / d log U comes to " + known(own.last_slope(), 1) + " and " +
          known(well_posed.last_slope(), 1),
      holds,
      "a break, a value: yes; the place of the break is that of a coarser λr, and the dynamic "
      "part stays far below the static one");
}

void judge_coefficient(PaperPage& page, const DragCurve& own, const DragCurve& well_posed) {
  Chapter& chapter = page.chapter();
  bool holds = true;
  for (const auto& [law, curve] : {std::pair{"eq. (12)", &own}, {"barker-gray", &well_posed}}) {
    holds &= chapter.check(Kind::publication, std::string("Fig. 12: exponent of C_D in Fr, ") + law,
                           curve->exponent(), -2.05, -1.9);
    holds &= chapter.check(
        Kind::publication,
        std::string("Fig. 12: C_D/p_ext at one Fr, largest over smallest of five p_ext, ") + law,
        curve->spread(), 1, 1.15);
  }
  page.item("Fig. 12, C_D",
            "C_D goes with the inverse square of U; C_D/p_ext of the five pressures collapses",
            "C_D goes with Fr to the power of " + io::fixed(own.exponent(), 2) +
                ", with the well-posed law " + io::fixed(well_posed.exponent(), 2) +
                "; at one Fr, C_D of the five pressures differs by a factor of 10, C_D/p_ext by " +
                in_percent(own.spread() - 1) + " and " + in_percent(well_posed.spread() - 1) +
                " at most",
            holds, "agrees; the experiments' symbols are to be had only from their owners");
}

}  // namespace talus::verification
