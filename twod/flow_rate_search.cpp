#include "twod/flow_rate_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/io/table.hpp"

namespace talus::twod {
namespace {

constexpr int coarsening = 4;
constexpr int most_angles = 100, most_failures = 12;

// log(Q*/target) as a function of the angle, with the solution last found.
class Excess {
 public:
  Excess(double target, const Section& section, const SectionMesh& mesh,
         shear::CrossSection<2>& space, const shear::ShearOptions& options, Start start)
      : target_(target),
        section_(section),
        mesh_(mesh),
        space_(space),
        options_(options),
        start_(start) {}

  /// Nothing if the solve fails, as last().end says.
  std::optional<double> operator()(double angle) {
    constexpr double rate_of_rest = 1e-12;  // far below every other
    section_.angle = angle;
    // A plug does not form again from a faster flow: where the last solution leads nowhere, rest
    // does.
    const bool has_before = before_.velocity.size() > 0;
    if (has_before) last_ = solve(section_, space_, options_, &before_);
    if (!has_before || !solve::is_success(last_.end))
      last_ = start_ == Start::nested ? solve_nested(section_, mesh_, space_, options_)
                                      : solve(section_, space_, options_);
    if (!solve::is_success(last_.end)) return std::nullopt;
    before_.velocity = last_.velocity;
    return std::log(std::max(flow_rate(last_, space_), rate_of_rest) / target_);
  }
  const SectionSolution& last() const { return last_; }

 private:
  double target_;
  Section section_;
  SectionMesh mesh_;
  shear::CrossSection<2>& space_;
  const shear::ShearOptions& options_;
  Start start_;
  shear::ShearStart<2> before_;
  SectionSolution last_;
};

// Angles with too small and too large a flow rate, and log(Q*/target) there where it is known.
struct Bracket {
  double low, high;
  std::optional<double> at_low = {}, at_high = {};

  double width() const { return high - low; }
  bool holds(double angle) const { return angle > low && angle < high; }
  double middle() const { return 0.5 * (low + high); }
};

Bracket limits(const Section& section, const shear::ShearOptions& options) {
  constexpr double smallest_angle = 1e-3;
  const double yield = std::atan(section.law.mu_s);
  return {options.method == shear::Method::newton ? std::min(smallest_angle, yield) : yield,
          std::atan(section.law.mu_2())};
}

// Relative, of the flow rate: 1e-10, or what the solves leave in doubt.
double rate_tolerance(const shear::ShearOptions& options) {
  return std::max(1e-10, options.method == shear::Method::newton
                             ? 10 * options.newton.tolerance
                             : 0.5 * options.interior_point.tolerance);
}

// Why the bracket closed without an angle in it.
FlowRateError nothing_in(const Bracket& bracket, double target) {
  const auto rate = [&](const std::optional<double>& value) {
    return io::rounded(target * std::exp(value.value_or(0)), 6);
  };
  const std::string at = " at an angle of " + io::rounded(bracket.high, 8);
  if (!bracket.at_high)
    return {solve::End::no_steady_state,
            "no angle below the limit of existence carries this flow rate, the largest found is " +
                rate(bracket.at_low) + at + "; lower --flow-rate"};
  if (!bracket.at_low)
    return {solve::End::stagnated, "the creep of the regularised law alone carries " +
                                       rate(bracket.at_high) + at + "; try a smaller --lambda-r"};
  return {solve::End::stagnated, "the flow rate jumps from " + rate(bracket.at_low) + " to " +
                                     rate(bracket.at_high) + at + "; try a smaller --tolerance"};
}

// Secants from `angle` and d log Q*/dα there (0: not known), kept inside the bracket.
void search(Excess& excess, Bracket bracket, double angle, double slope, double target,
            double tolerance) {
  constexpr double narrowest = 1e-13, narrowest_at_limit = 1e-6;
  const double whole = bracket.width();
  double last_angle = 0, last_value = 0, gain_before = 2;  // none yet
  int failures = 0;
  for (int i = 0; i < most_angles; ++i) {
    const auto value = excess(angle);
    if (!value && excess.last().end != solve::End::no_steady_state) {
      // Somewhere else between: the fractional parts of multiples of the golden ratio.
      if (++failures == most_failures) break;
      angle = bracket.low + bracket.width() * std::fmod(0.618034 * failures, 1);
      continue;
    }
    if (value && std::abs(*value) <= tolerance) return;
    const bool is_low = value && *value < 0;
    (is_low ? bracket.low : bracket.high) = angle;
    (is_low ? bracket.at_low : bracket.at_high) = value;
    const bool has_limits = bracket.at_low && bracket.at_high;
    if (bracket.width() < (has_limits ? narrowest : narrowest_at_limit * whole)) {
      if (has_limits && std::abs(value.value_or(1)) <= 100 * tolerance) return;
      throw nothing_in(bracket, target);
    }
    if (!value) {
      angle = bracket.middle();
      continue;
    }
    if (last_angle > 0) slope = (*value - last_value) / (angle - last_angle);
    const double next = angle - *value / slope;
    const double gain = last_angle > 0 ? std::abs(*value / last_value) : 1;
    const bool gains = gain * gain_before < 0.5 || last_angle == 0;
    last_angle = angle;
    last_value = *value;
    gain_before = gain;
    angle = gains && bracket.holds(next) ? next : bracket.middle();
  }
  const solve::End end = failures > 0 ? excess.last().end : solve::End::stagnated;
  throw FlowRateError(solve::is_success(end) ? solve::End::stagnated : end,
                      "no angle was found with this flow rate, the last tried was " +
                          io::rounded(angle, 8) + "; " + solve::advice_for(solve::End::stagnated));
}

// An angle near the root, and the slope there.
struct Guess {
  double angle = 0, slope = 0;
};

// From a coarser mesh, if there is one and it finds its way.
std::optional<Guess> coarse_guess(double target, const Section& section, const SectionMesh& mesh,
                                  const shear::ShearOptions& options, Start start) {
  SectionMesh coarse = mesh;
  coarse.across /= coarsening;
  coarse.up /= coarsening;
  if (std::min(coarse.across, coarse.up) < CoarserMesh::fewest_elements) return std::nullopt;
  auto space = space_of(section, coarse);
  try {
    const auto found = solve_for_flow_rate(target, section, coarse, space, options, start);
    const Bracket all = limits(section, options);
    const double angle = found.section.angle;
    const double difference = std::min(1e-4, 0.1 * (angle - all.low));
    Excess excess(target, section, coarse, space, options, start);
    const auto below = excess(angle - difference);
    return Guess{angle, below ? -*below / difference : 0};
  } catch (const FlowRateError&) {
    return std::nullopt;
  }
}

}  // namespace

SectionSolution solve_for_flow_rate(double target, const Section& section, const SectionMesh& mesh,
                                    shear::CrossSection<2>& space,
                                    const shear::ShearOptions& options, Start start) {
  Excess excess(target, section, mesh, space, options, start);
  const Bracket all = limits(section, options);
  // Flow starts above arctan μs, later than that because of the side walls.
  const double yield = std::atan(section.law.mu_s);
  const Guess guess = coarse_guess(target, section, mesh, options, start)
                          .value_or(Guess{yield + 0.1 * (all.high - yield)});
  search(excess, all, guess.angle, guess.slope, target, rate_tolerance(options));
  return excess.last();
}

}  // namespace talus::twod
