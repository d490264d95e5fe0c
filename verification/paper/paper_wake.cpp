// The paper's Figs 13 to 16: what is read off a flow around the cylinder.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "twod/cylinder_report.hpp"
#include "verification/harness/fit.hpp"
#include "verification/paper/paper_cylinder.hpp"

namespace talus::verification {
namespace {

using State = twod::CylinderFlow::State;

constexpr double pi = std::numbers::pi;

// What is measured with either law, and the name of that.
template <class Measured>
std::array<std::pair<std::string, const Measured*>, 2> with_either_law(const Measured& own,
                                                                       const Measured& well_posed) {
  return {std::pair{std::string("eq. (12)"), &own}, {"barker-gray", &well_posed}};
}

void read_perimeter(Wake& wake, const twod::CylinderFlow& cylinder, const State& state) {
  wake.largest_pressure = wake.stress_gap = 0;
  wake.lowest_pressure = std::numeric_limits<double>::infinity();
  wake.lambda_r = cylinder.flow().rheology().lambda_r;
  for (const twod::PerimeterPoint& point : twod::perimeter(cylinder, state)) {
    const auto& law = point.at.law;
    if (law.regularised_pressure > wake.largest_pressure) {
      wake.largest_pressure = law.regularised_pressure;
      wake.stagnation_angle = point.angle;
    }
    if (law.total_pressure < wake.lowest_pressure) {
      wake.lowest_pressure = law.total_pressure;
      wake.lowest_angle = point.angle;
      wake.lowest_regularised = law.regularised_pressure / wake.lambda_r;
    }
    wake.stress_gap = solve::nan_max(
        wake.stress_gap, std::abs(point.regularised_normal_stress() - point.normal_stress));
  }
}

// Vertical velocities at the nodes of a line from the cylinder on, by the distance from it.
struct Profile {
  std::vector<double> distance, velocity;
};
Profile profile_along(int axis, int sign, double length, const twod::CylinderFlow& cylinder,
                      const State& state) {
  std::vector<std::pair<double, double>> points;
  const auto& nodes = cylinder.space().mesh().nodes;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double along = sign * nodes[n][axis], across = nodes[n][1 - axis];
    if (std::abs(across) > 1e-9 || along < 0.5 - 1e-9 || along > 0.5 + length) continue;
    const auto index = cylinder.space().velocity_index(static_cast<Eigen::Index>(n), 1);
    points.emplace_back(along - 0.5, state.value()[index]);
  }
  std::ranges::sort(points);
  Profile profile;
  for (const auto& [distance, velocity] : points) {
    profile.distance.push_back(distance);
    profile.velocity.push_back(velocity);
  }
  return profile;
}

// Where the fall beside the cylinder first has 90% of its largest speed.
double layer_of(const Profile& profile) {
  const double fastest = std::ranges::min(profile.velocity);
  for (std::size_t i = 0; i < profile.velocity.size(); ++i)
    if (profile.velocity[i] <= 0.9 * fastest) return profile.distance[i];
  return std::nan("");
}

// Extremes by more than a thousandth of the largest speed.
int extremes_of(const Profile& profile) {
  const double threshold = -1e-3 * std::ranges::min(profile.velocity);
  int extremes = 0, direction = 0;
  double turning = profile.velocity.front();
  for (const double velocity : profile.velocity) {
    if (direction * (velocity - turning) > 0 || direction == 0) {
      if (std::abs(velocity - turning) < threshold) continue;
      direction = velocity > turning ? 1 : -1;
      turning = velocity;
    } else if (std::abs(velocity - turning) > threshold) {
      ++extremes;
      direction = -direction;
      turning = velocity;
    }
  }
  return extremes;
}

// In the middle of the elements.
void read_viscosity(Wake& wake, const twod::CylinderFlow& cylinder, const State& state) {
  const io::QuadraticGrid grid = twod::grid(cylinder, state);
  const auto field = [&](const std::string& name) -> const std::vector<double>& {
    return std::ranges::find(grid.cell_fields, name, &io::Field::name)->values;
  };
  const auto decades = [](const std::vector<double>& values) {
    const auto [smallest, largest] = std::ranges::minmax_element(values);
    return std::log10(*largest / *smallest);
  };
  wake.static_decades = decades(field("viscosity_static_part"));
  wake.dynamic_decades = decades(field("viscosity_dynamic_part"));
  const auto height_of = [&](auto element) {
    return fem::ElementPoint<2>(cylinder.space().mesh(), static_cast<std::size_t>(element),
                                fem::Point<2>::Zero())
        .position[1];
  };
  const auto& dynamic = field("viscosity_dynamic_part");
  wake.largest_dynamic_at = height_of(std::ranges::max_element(dynamic) - dynamic.begin());
  const auto& viscosity = field("viscosity");
  const auto lowest = std::ranges::min_element(viscosity);
  wake.lowest_viscosity = *lowest;
  wake.lowest_viscosity_at = height_of(lowest - viscosity.begin());
}

}  // namespace

Wake wake_of(const twod::CylinderFlow& cylinder, const State& state) {
  Wake wake;
  read_perimeter(wake, cylinder, state);
  wake.layer = layer_of(profile_along(0, 1, 4, cylinder, state));
  wake.extremes = extremes_of(profile_along(1, -1, 4, cylinder, state));
  read_viscosity(wake, cylinder, state);
  return wake;
}

void judge_fields(PaperPage& page, const Wake& own, const Wake& well_posed) {
  bool holds = true;
  for (const auto& [law, wake] : with_either_law(own, well_posed)) {
    holds &= page.chapter().check(Kind::publication,
                                  "Fig. 13: θ of the largest pressure, over π, " + law,
                                  wake->stagnation_angle / pi, 0.85, 1);
    holds &= page.chapter().check(Kind::publication, "Fig. 13: largest p_regu, " + law,
                                  wake->largest_pressure, 4, 15);
    holds &=
        page.chapter().check(Kind::publication, "Fig. 13: lowest p_tot on the cylinder, " + law,
                             wake->lowest_pressure, -0.05, 0.01);
    holds &= page.chapter().check(Kind::publication, "Fig. 13: θ of that, over π, " + law,
                                  wake->lowest_angle / pi, 0, 0.5);
  }
  page.item("Fig. 13", "highest pressure at the upstream stagnation point, a very low one behind",
            "p_regu up to " + known(own.largest_pressure, 2) +
                " p_ext at θ = " + known(own.stagnation_angle / pi, 2) + "π, p_tot down to " +
                known(own.lowest_pressure, 1) + " at " + known(own.lowest_angle / pi, 2) +
                "π; with barker-gray " + known(well_posed.largest_pressure, 2) + " and " +
                known(well_posed.lowest_pressure, 1),
            holds, "agrees");
}

void judge_close_up(PaperPage& page, const Wake& own, const Wake& well_posed) {
  bool holds = true;
  for (const auto& [law, wake] : with_either_law(own, well_posed)) {
    holds &= page.chapter().check(
        Kind::publication,
        "Fig. 14: from the side of the cylinder to 90% of the speed, in D, " + law, wake->layer,
        0.02, 0.5);
    holds &= page.chapter().check(Kind::publication,
                                  "Fig. 14: extremes of the velocity on the axis behind, " + law,
                                  wake->extremes, 0, 0);
  }
  page.item(
      "Fig. 14", "very thin boundary layers where the cylinder is passed; wiggles in the wake",
      "90% of the largest speed beside the cylinder " + known(own.layer, 2) +
          " D from it; on the axis behind, the velocity rises without a wiggle; the same with "
          "barker-gray",
      holds, "layers: yes, not thinner than that; no wiggles in the velocity");
}

void judge_perimeter(PaperPage& page, const Wakes& own, const Wakes& well_posed) {
  bool holds = true;
  for (const auto& [law, wakes] : with_either_law(own, well_posed)) {
    const auto& [slow, fast] = *wakes;
    holds &= page.chapter().check(Kind::publication, "Fig. 15: lowest p_dyn at F = 0.054, " + law,
                                  fast.lowest_pressure - 1, -1.05, -1);
    holds &= page.chapter().check(Kind::publication, "Fig. 15: lowest p_dyn at F = 0.044, " + law,
                                  slow.lowest_pressure - 1, -0.999, -0.9);
    holds &= page.chapter().check(
        Kind::exact, "Fig. 15: p_regu at F = 0.054 where it is lowest, over λr²/(4|p|), " + law,
        fast.lowest_regularised * 4 * std::abs(fast.lowest_pressure) / fast.lambda_r, 0.99, 1.01);
  }
  const Wake& wake = own.flowing;
  page.item("Fig. 15",
            "p_dyn is negative behind the cylinder and p_tot with it; p_regu is bounded from below "
            "by λr",
            "p_dyn down to " + known(wake.lowest_pressure - 1, 4) + ", p_tot to " +
                known(wake.lowest_pressure, 2) + " (at F = 0.044 to " +
                known(own.creeping.lowest_pressure, 2) + "); p_regu there " +
                known(wake.lowest_regularised, 2) +
                " λr; normal stress and its regularised "
                "counterpart at most " +
                known(wake.stress_gap, 2) + " apart",
            holds, "signs: agree; p_regu falls far below λr");
}

void judge_viscosity(PaperPage& page, const Wakes& own) {
  const auto& [slow, fast] = own;
  Chapter& chapter = page.chapter();
  bool holds = chapter.check(Kind::publication, "Fig. 16: decades of the static part, F = 0.054",
                             fast.static_decades, 7, 10);
  for (const auto& [loading, wake] : {std::pair{"0.044", &slow}, {"0.054", &fast}}) {
    holds &= chapter.check(Kind::publication,
                           std::string("Fig. 16: decades of the dynamic part, F = ") + loading,
                           wake->dynamic_decades, 1.3, 3.5);
    holds &= chapter.check(
        Kind::publication,
        std::string("Fig. 16: z where the dynamic part is largest, upstream is up, F = ") + loading,
        wake->largest_dynamic_at, 0.5, 1);
    holds &= chapter.check(Kind::publication,
                           std::string("Fig. 16: z where the viscosity is lowest, F = ") + loading,
                           wake->lowest_viscosity_at, -1, -0.2);
  }
  holds &= chapter.check(Kind::publication, "Fig. 16: lowest viscosity, F = 0.054",
                         fast.lowest_viscosity, 1e-5, 0.1);
  page.item(
      "Fig. 16",
      "the static part spans over seven decades, the dynamic one not more than one and is "
      "largest in the wake; η is tiny there",
      "at F = 0.054 " + known(fast.static_decades, 2) + " and " + known(fast.dynamic_decades, 2) +
          " decades, at 0.044 " + known(slow.static_decades, 2) + " and " +
          known(slow.dynamic_decades, 2) +
          "; the dynamic part goes with sqrt(p) and is largest in front of the cylinder; η in "
          "the wake is down to " +
          known(fast.lowest_viscosity, 1),
      holds, "static part and wake: agree; the dynamic part spans more and is largest upstream");
}

}  // namespace talus::verification
