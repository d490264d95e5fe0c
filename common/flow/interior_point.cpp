#include "common/flow/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/flow/load_capacity.hpp"

namespace talus::flow {
namespace {

// Power of the load below which the gap is measured against the natural power instead.
constexpr double smallest_power = 1e-12;

// Largest α with |v + α dv| <= s + α ds, for |v| < s. Infinity if there is none.
template <class Vector>
double step_to_cone(double s, const Vector& v, double ds, const Vector& dv) {
  const double norm = v.norm();
  const double c = (s - norm) * (s + norm);
  const double b = s * ds - v.dot(dv);
  const double dv_norm = dv.norm();
  const double a = (ds - dv_norm) * (ds + dv_norm);
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::numeric_limits<double>::infinity();
  const double denominator = -b + std::sqrt(discriminant);
  return denominator > 0 ? c / denominator : std::numeric_limits<double>::infinity();
}

// Coefficients left when dt, dz and dτ are eliminated at a point.
template <int Dim>
struct Elimination {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  double t, z, slope, pivot;  // slope = D''(t), pivot = K
  Vector g, stress, alpha;

  Elimination(double bound, double dual_bound, double law_slope, const Vector& gradient,
              const Vector& tau)
      : t(bound), z(dual_bound), slope(law_slope), g(gradient), stress(tau) {
    alpha = (z / t) * g + stress;
    const double norm = g.norm();
    pivot = slope * (t - norm) * (t + norm) / t + z + g.dot(stress) / t;
  }

  Eigen::Matrix<double, Dim, Dim> tangent() const {
    if constexpr (Dim == 1) {
      // The general expression below, expanded: every term is positive, nothing cancels in flow.
      const double excess = (z - std::abs(stress[0])) * (z + std::abs(stress[0]));
      return Eigen::Matrix<double, 1, 1>((slope * (z * t + g[0] * stress[0]) + excess) /
                                         (t * pivot));
    } else {
      // Symmetric on the central path; the symmetric part keeps one factorisation for all.
      const Eigen::Matrix<double, Dim, Dim> rank_one =
          (slope * g - stress) * alpha.transpose() / (t * pivot);
      return (z / t) * Eigen::Matrix<double, Dim, Dim>::Identity() +
             0.5 * (rank_one + rank_one.transpose());
    }
  }
};

}  // namespace

template <int Dim>
InteriorPoint<Dim>::InteriorPoint(Space& space, rheology::FrictionLaw law,
                                  const std::function<double(const Vector&)>& pressure,
                                  const std::function<double(const Vector&)>& body_force)
    : space_(space), law_(law), load_(space.load(body_force)) {
  for (const auto& point : space.points()) {
    const double p = pressure(point.position);
    pressure_.push_back(p);
    point_power_.push_back(law_.mu_s * p * law_.reference_shear_rate(p));
  }
  natural_power_ = integral(point_power_);
}

template <int Dim>
ConeState<Dim> InteriorPoint<Dim>::start() const {
  ConeState<Dim> state{solve::CompensatedVector(space_.node_count()), {}, {}, {}};
  for (const double p : pressure_) {
    state.bound.push_back(law_.reference_shear_rate(p));
    state.dual_bound.push_back(law_.stress(state.bound.back(), p));
  }
  state.stress.assign(pressure_.size(), Vector::Zero());
  return state;
}

template <int Dim>
ConeResidual<Dim> InteriorPoint<Dim>::residual(const ConeState<Dim>& state) const {
  std::vector<Vector> g;
  space_.gradients(state.velocity, g);
  ConeResidual<Dim> r{load_ - space_.internal_force(state.stress), {}, {}, {}};
  for (std::size_t k = 0; k < g.size(); ++k) {
    const double t = state.bound[k], z = state.dual_bound[k];
    r.law.push_back(law_.stress(t, pressure_[k]) - z);
    r.product.push_back(t * z - g[k].dot(state.stress[k]));
    r.alignment.push_back(z * g[k] - t * state.stress[k]);
  }
  return r;
}

template <int Dim>
ConeResidual<Dim> InteriorPoint<Dim>::linearised(const ConeState<Dim>& state,
                                                 const ConeStep<Dim>& step) const {
  std::vector<Vector> g;
  space_.gradients(state.velocity, g);
  ConeResidual<Dim> r{-space_.internal_force(step.stress), {}, {}, {}};
  for (std::size_t k = 0; k < g.size(); ++k) {
    const double t = state.bound[k], z = state.dual_bound[k];
    const double dt = step.bound[k], dz = step.dual_bound[k];
    r.law.push_back(law_.stress_slope(t, pressure_[k]) * dt - dz);
    r.product.push_back(t * dz + z * dt - g[k].dot(step.stress[k]) -
                        step.gradient[k].dot(state.stress[k]));
    r.alignment.push_back(z * step.gradient[k] + g[k] * dz - t * step.stress[k] -
                          state.stress[k] * dt);
  }
  return r;
}

template <int Dim>
void InteriorPoint<Dim>::assemble(const ConeState<Dim>& state) {
  std::vector<Vector> g;
  space_.gradients(state.velocity, g);
  std::vector<typename Space::Tangent> tangents(g.size());
  for (std::size_t k = 0; k < g.size(); ++k)
    tangents[k] = Elimination<Dim>(state.bound[k], state.dual_bound[k],
                                   law_.stress_slope(state.bound[k], pressure_[k]), g[k],
                                   state.stress[k])
                      .tangent();
  space_.assemble(tangents);
}

template <int Dim>
bool InteriorPoint<Dim>::newton_step(const ConeState<Dim>& state,
                                     const ConeResidual<Dim>& residual,
                                     ConeStep<Dim>& step) const {
  std::vector<Vector> g;
  space_.gradients(state.velocity, g);
  const std::size_t n = g.size();
  std::vector<double> constant(n);     // b:  dt = (α·dg + b)/K
  std::vector<Vector> stress_part(n);  // what dτ holds besides A dg
  for (std::size_t k = 0; k < n; ++k) {
    const Elimination<Dim> point(state.bound[k], state.dual_bound[k],
                                 law_.stress_slope(state.bound[k], pressure_[k]), g[k],
                                 state.stress[k]);
    const double law = residual.law[k];
    const Vector alignment = g[k] * law + residual.alignment[k];
    constant[k] = -residual.product[k] - point.t * law + g[k].dot(alignment) / point.t;
    stress_part[k] = (point.slope * g[k] - state.stress[k]) *
                         (constant[k] / (point.t * point.pivot)) +
                     alignment / point.t;
  }
  const Eigen::VectorXd right = residual.equilibrium - space_.internal_force(stress_part);
  if (!space_.solve(right, step.velocity)) return false;
  space_.gradients(step.velocity, step.gradient);
  step.bound.resize(n);
  step.dual_bound.resize(n);
  step.stress.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Elimination<Dim> point(state.bound[k], state.dual_bound[k],
                                 law_.stress_slope(state.bound[k], pressure_[k]), g[k],
                                 state.stress[k]);
    const double along = point.alpha.dot(step.gradient[k]);
    step.bound[k] = (along + constant[k]) / point.pivot;
    step.dual_bound[k] = point.slope * step.bound[k] + residual.law[k];
    step.stress[k] = point.tangent() * step.gradient[k] + stress_part[k];
  }
  return true;
}

template <int Dim>
ConeState<Dim> InteriorPoint<Dim>::moved(const ConeState<Dim>& state, double length,
                                         const ConeStep<Dim>& step) {
  ConeState<Dim> result = state;
  result.velocity = state.velocity.moved(length, step.velocity);
  for (std::size_t k = 0; k < step.bound.size(); ++k) {
    result.bound[k] += length * step.bound[k];
    result.dual_bound[k] += length * step.dual_bound[k];
    result.stress[k] += length * step.stress[k];
  }
  return result;
}

template <int Dim>
double InteriorPoint<Dim>::integral(const std::vector<double>& values) const {
  double sum = 0;
  for (std::size_t k = 0; k < values.size(); ++k) sum += space_.points()[k].weight * values[k];
  return sum;
}

template <int Dim>
double InteriorPoint<Dim>::longest_step(const ConeState<Dim>& state,
                                        const ConeStep<Dim>& step) const {
  std::vector<Vector> g;
  space_.gradients(state.velocity, g);
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < g.size(); ++k) {
    longest = std::min(longest,
                       step_to_cone(state.bound[k], g[k], step.bound[k], step.gradient[k]));
    longest = std::min(longest, step_to_cone(state.dual_bound[k], state.stress[k],
                                             step.dual_bound[k], step.stress[k]));
  }
  return longest;
}

template <int Dim>
double InteriorPoint<Dim>::predicted_gap(const ConeState<Dim>& state, double length,
                                         const ConeStep<Dim>& step) const {
  return integral(residual(moved(state, length, step)).product);
}

template <int Dim>
bool InteriorPoint<Dim>::is_within_yield(const ConeState<Dim>& state) const {
  for (std::size_t k = 0; k < pressure_.size(); ++k)
    if (state.stress[k].norm() > law_.mu_s * pressure_[k]) return false;
  return true;
}

template <int Dim>
InteriorPointIteration InteriorPoint<Dim>::measure(const ConeState<Dim>& state,
                                                   const ConeResidual<Dim>& r) const {
  InteriorPointIteration record;
  const double power =
      std::max(load_.dot(state.velocity.value()), smallest_power * natural_power_);
  double contributions = 0;
  for (std::size_t k = 0; k < r.product.size(); ++k) {
    const double bounds = state.bound[k] * state.dual_bound[k];
    contributions += space_.points()[k].weight * (bounds + std::abs(bounds - r.product[k]));
  }
  record.relative_gap = integral(r.product) / power;
  record.round_off = std::numeric_limits<double>::epsilon() * contributions / power;
  record.equilibrium = r.equilibrium.template lpNorm<Eigen::Infinity>() /
                       load_.template lpNorm<Eigen::Infinity>();
  return record;
}

template <int Dim>
bool InteriorPoint<Dim>::advance(ConeState<Dim>& state, ConeResidual<Dim>& r,
                                 InteriorPointIteration& record, double step_to_boundary) {
  ConeStep<Dim> step;
  assemble(state);
  if (!newton_step(state, r, step)) return false;
  const double gap = integral(r.product);
  const double predictor_length = std::min(1.0, longest_step(state, step));
  const double ratio = std::max(predicted_gap(state, predictor_length, step), 0.0) / gap;
  record.centring = std::min(1.0, ratio * ratio * ratio);

  // Corrector: the same factorisation, with the products of the predictor's increments.
  const double target = record.centring * gap / natural_power_;  // σμ
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    r.product[k] += step.bound[k] * step.dual_bound[k] - step.gradient[k].dot(step.stress[k]) -
                    target * point_power_[k];
    r.alignment[k] += step.dual_bound[k] * step.gradient[k] - step.bound[k] * step.stress[k];
  }
  if (!newton_step(state, r, step)) return false;
  record.step = std::min(1.0, step_to_boundary * longest_step(state, step));
  state = moved(state, record.step, step);
  return true;
}

template <int Dim>
InteriorPointSummary InteriorPoint<Dim>::solve(ConeState<Dim>& state,
                                               const InteriorPointOptions& options) {
  constexpr double equilibrium_tolerance = 1e-9;
  constexpr double near_round_off = 100;  // gap over its round-off at which no progress is expected
  constexpr int patience = 3;             // iterations without a smaller gap, once in equilibrium
  InteriorPointSummary summary;
  ConeState<Dim> good = state;
  int since_good = 0;
  bool was_in_equilibrium = false;
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
    ConeResidual<Dim> r = residual(state);
    InteriorPointIteration now = measure(state, r);
    summary.history.push_back(now);
    const bool in_equilibrium = now.equilibrium <= equilibrium_tolerance;
    const bool is_finite = std::isfinite(now.relative_gap) && std::isfinite(now.equilibrium);
    const bool is_better =
        is_finite && now.relative_gap > 0 &&
        (!was_in_equilibrium ||
         (in_equilibrium && now.relative_gap < summary.last_good.relative_gap));
    if (is_better) {
      good = state;
      summary.last_good = now;
      was_in_equilibrium = in_equilibrium;
      since_good = 0;
    } else if (!is_finite || ++since_good >= patience) {
      return gave_up(is_finite ? solve::End::stagnated : solve::End::non_finite);
    }
    if (in_equilibrium && is_within_yield(state)) {
      // Rest is then the exact minimum of the discrete energy.
      state.velocity.set_zero();
      summary.at_rest = true;
      summary.last_good = now;
      summary.last_good.relative_gap = 0;
      return ended(solve::End::converged);
    }
    if (is_better && load_.dot(state.velocity.value()) > 0 && recession<Dim>(space_, law_, pressure_, load_, state.velocity) < 0)
      return ended(solve::End::no_steady_state);
    if (is_better && in_equilibrium && now.relative_gap <= options.tolerance)
      return ended(solve::End::converged);
    if (summary.factorisations() >= options.max_factorisations)
      return gave_up(solve::End::stagnated);
    if (!advance(state, r, summary.history.back(), options.step_to_boundary))
      return gave_up(solve::End::linear_solver_failed);
  }
}

template class InteriorPoint<1>;

}  // namespace talus::flow
