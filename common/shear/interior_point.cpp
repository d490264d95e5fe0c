#include "common/shear/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/shear/load_capacity.hpp"
#include "common/shear/second_order_cone.hpp"
#include "common/solve/remaining_distance.hpp"

namespace talus::shear {
namespace {

// Power of the load below which the gap is measured against the natural power instead.
constexpr double smallest_power = 1e-12;
// Step below which the corrector is given up for a step towards the central path.
constexpr double shortest_step = 0.1;

template <int Dim>
double longest_step(const ConeState<Dim>& state, const ConeStep<Dim>& step) {
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < step.bound.size(); ++k) {
    longest = std::min(
        longest, step_to_cone(state.bound[k], state.gradient[k], step.bound[k], step.gradient[k]));
    longest = std::min(longest, step_to_cone(state.dual_bound[k], state.stress[k],
                                             step.dual_bound[k], step.stress[k]));
  }
  return longest;
}

}  // namespace

template <int Dim>
InteriorPoint<Dim>::InteriorPoint(Space& space, rheology::FrictionLaw law,
                                  const std::function<double(const Vector&)>& pressure,
                                  const std::function<double(const Vector&)>& body_force)
    : System(space, law, pressure, body_force) {
  for (std::size_t k = 0; k < pressure_.size(); ++k)
    point_power_.push_back(law_at(k).mu_s * pressure_[k] * law_.reference_shear_rate(pressure_[k]));
  natural_power_ = integral(point_power_);
}

template <int Dim>
double InteriorPoint<Dim>::integral(const std::vector<double>& values) const {
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k) sum += space_.points()[k].weight * values[k];
  return sum;
}

// Σ w (t z - g·τ) after a step, without the rest of the residual.
template <int Dim>
double InteriorPoint<Dim>::predicted_gap(const ConeState<Dim>& state, double length,
                                         const ConeStep<Dim>& step) const {
  double gap = 0;
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    const Vector g = state.gradient[k] + length * step.gradient[k];
    const Vector stress = state.stress[k] + length * step.stress[k];
    gap += space_.points()[k].weight * ((state.bound[k] + length * step.bound[k]) *
                                            (state.dual_bound[k] + length * step.dual_bound[k]) -
                                        g.dot(stress));
  }
  return gap;
}

template <int Dim>
InteriorPointIteration InteriorPoint<Dim>::measure(const ConeState<Dim>& state,
                                                   const ConeResidual<Dim>& r) const {
  InteriorPointIteration record;
  // Of the load and of walls that move; at nodes that rest, reactions do no work.
  const Eigen::VectorXd reactions = space_.reactions(state.stress);
  const double power =
      std::max((load_ + reactions).dot(state.velocity.value()), smallest_power * natural_power_);
  double contributions = 0;
  for (std::size_t k = 0; k < r.product.size(); ++k) {
    const double bounds = state.bound[k] * state.dual_bound[k];
    contributions += space_.points()[k].weight * (bounds + std::abs(bounds - r.product[k]));
  }
  record.relative_gap = integral(r.product) / power;
  record.round_off = std::numeric_limits<double>::epsilon() * contributions / power;
  const bool is_loaded = load_.template lpNorm<Eigen::Infinity>() > 0;
  record.equilibrium = r.equilibrium.template lpNorm<Eigen::Infinity>() /
                       (is_loaded ? load_ : reactions).template lpNorm<Eigen::Infinity>();
  return record;
}

template <int Dim>
bool InteriorPoint<Dim>::advance(ConeState<Dim>& state, ConeResidual<Dim>& r,
                                 InteriorPointIteration& record,
                                 const InteriorPointOptions& options) {
  ConeStep<Dim> step;
  this->assemble(state);
  if (!this->newton_step(r, step)) return false;
  const double gap = integral(r.product);
  const double predictor_length = std::min(1.0, longest_step(state, step));
  const double ratio = std::max(predicted_gap(state, predictor_length, step), 0.0) / gap;
  record.centring = std::min(1.0, ratio * ratio * ratio);

  // Corrector: the same factorisation, with the products of the predictor's increments.
  const std::vector<double> weights = options.path == CentralPath::natural
                                          ? point_power_
                                          : std::vector<double>(pressure_.size(), 1.0);
  const double total_weight = integral(weights);
  const ConeResidual<Dim> plain = r;
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    r.product[k] += step.bound[k] * step.dual_bound[k] - step.gradient[k].dot(step.stress[k]);
    r.alignment[k] += step.dual_bound[k] * step.gradient[k] - step.bound[k] * step.stress[k];
  }
  const auto solve_towards = [&](ConeResidual<Dim> target, double centring) {
    record.centring = centring;
    for (std::size_t k = 0; k < pressure_.size(); ++k)
      target.product[k] -= centring * gap / total_weight * weights[k];
    if (!this->newton_step(target, step)) return false;
    record.step = std::min(1.0, options.step_to_boundary * longest_step(state, step));
    return true;
  };
  if (!solve_towards(r, record.centring)) return false;
  // A point that lies too near its cone's boundary blocks the way: back to the central path first.
  for (const double centring : {0.5, 0.9, 1.0})
    if (record.step < shortest_step && !solve_towards(plain, centring)) return false;
  state = this->moved(state, record.step, step);
  return true;
}

template <int Dim>
InteriorPointSummary InteriorPoint<Dim>::solve(ConeState<Dim>& state,
                                               const InteriorPointOptions& options) {
  constexpr double equilibrium_tolerance = 1e-9;
  constexpr double near_round_off = 100;  // gap over its round-off at which no progress is expected
  constexpr double no_step = 1e-9;        // nothing moves: the next step would be the same
  constexpr int patience = 3;             // iterations without a smaller gap, once in equilibrium
  InteriorPointSummary summary;
  ConeState<Dim> good = state;
  int since_good = 0;
  solve::RemainingDistance remaining;
  bool was_in_equilibrium = false;
  const bool is_driven = space_.has_moving_walls(state.velocity);
  const auto ended = [&](solve::End end) {
    summary.end = end;
    return summary;
  };
  // Round-off ends the path: return to the last good iterate and say what it is worth.
  const auto gave_up = [&](solve::End end) {
    state = good;
    const bool at_floor = was_in_equilibrium && summary.last_good.relative_gap <=
                                                    near_round_off * summary.last_good.round_off;
    return ended(at_floor ? solve::End::at_round_off_floor : end);
  };
  for (;;) {
    ConeResidual<Dim> r = this->residual(state);
    InteriorPointIteration now = measure(state, r);
    if (summary.history.empty()) summary.last_good = now;  // of the state returned, good or not
    summary.history.push_back(now);
    const bool in_equilibrium = now.equilibrium <= equilibrium_tolerance;
    const bool is_finite = std::isfinite(now.relative_gap) && std::isfinite(now.equilibrium);
    const bool is_better = is_finite && now.relative_gap > 0 &&
                           (!was_in_equilibrium ||
                            (in_equilibrium && now.relative_gap < summary.last_good.relative_gap));
    if (in_equilibrium && !is_driven &&
        is_within_yield<Dim>(space_, law_, pressure_, state.stress)) {
      // Rest is then the exact minimum of the discrete energy.
      state.velocity.set_zero();
      state.gradient.assign(state.gradient.size(), Vector::Zero());
      summary.at_rest = true;
      summary.last_good = now;
      summary.last_good.relative_gap = 0;
      return ended(solve::End::converged);
    }
    // True of any velocity, near its equilibrium or not.
    if (is_finite && load_.dot(state.velocity.value()) > 0 &&
        recession<Dim>(space_, law_, pressure_, load_, state.velocity) < 0)
      return ended(solve::End::no_steady_state);
    if (is_better) {
      good = state;
      summary.last_good = now;
      was_in_equilibrium = in_equilibrium;
      since_good = 0;
    } else if (!is_finite || ++since_good >= patience) {
      return gave_up(is_finite ? solve::End::stagnated : solve::End::non_finite);
    }
    // A gap bounds an energy, which goes with the square of the velocity.
    const double near =
        std::sqrt(options.tolerance) * state.velocity.value().template lpNorm<Eigen::Infinity>();
    if (is_better && in_equilibrium && now.relative_gap <= options.tolerance &&
        remaining.bound() <= near)
      return ended(solve::End::converged);
    if (summary.factorisations() >= options.max_factorisations)
      return gave_up(solve::End::stagnated);
    const Eigen::VectorXd before = state.velocity.value();
    if (!advance(state, r, summary.history.back(), options))
      return gave_up(solve::End::linear_solver_failed);
    if (summary.history.back().step < no_step) return gave_up(solve::End::stagnated);
    remaining.stepped((state.velocity.value() - before).template lpNorm<Eigen::Infinity>(), 1);
  }
}

template class InteriorPoint<1>;
template class InteriorPoint<2>;

}  // namespace talus::shear
