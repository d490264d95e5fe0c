#include "common/shear/interior_point_system.hpp"

#include <cmath>

#include "common/shear/wall_law.hpp"

namespace talus::shear {

template <int Dim>
InteriorPointSystem<Dim>::InteriorPointSystem(
    Space& space, rheology::FrictionLaw law, const std::function<double(const Vector&)>& pressure,
    const std::function<double(const Vector&)>& body_force)
    : space_(space), law_(law), wall_law_(wall_law(law)), load_(space.load(body_force)) {
  for (const auto& point : space.points()) pressure_.push_back(pressure(point.position));
}

template <int Dim>
ConeState<Dim> InteriorPointSystem<Dim>::start() const {
  ConeState<Dim> state;
  state.velocity = solve::CompensatedVector(space_.node_count());
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    state.bound.push_back(law_.reference_shear_rate(pressure_[k]));
    state.dual_bound.push_back(law_at(k).stress(state.bound.back(), pressure_[k]));
  }
  state.gradient.assign(pressure_.size(), Vector::Zero());
  state.stress = state.gradient;
  return state;
}

template <int Dim>
ConeState<Dim> InteriorPointSystem<Dim>::start(const solve::CompensatedVector& velocity) const {
  ConeState<Dim> state = start();
  state.velocity = velocity;
  space_.gradients(velocity, state.gradient);
  // Of the start: rounder costs a factorisation more; sharper, the first steps are blocked
  // where velocities jump between small elements.
  constexpr double roundness = 2;
  double power = 0, area = 0;  // of yielding at that rate
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    const double weight = space_.points()[k].weight;
    power += weight * law_at(k).mu_s * pressure_[k] * state.gradient[k].norm();
    area += weight;
  }
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    // The larger root of z (t² - |g|²)/t = 2 roundness times that mean, with the z of yield.
    const double rate = state.gradient[k].norm();
    const double width = roundness * power / area / (law_at(k).mu_s * pressure_[k]);
    const double t = width + std::hypot(width, rate);
    state.bound[k] = t;
    state.dual_bound[k] = law_at(k).stress(t, pressure_[k]);
    state.stress[k] = state.dual_bound[k] / t * state.gradient[k];
  }
  return state;
}

template <int Dim>
ConeResidual<Dim> InteriorPointSystem<Dim>::residual(const ConeState<Dim>& state) const {
  ConeResidual<Dim> r{load_ - space_.internal_force(state.stress), {}, {}, {}};
  const std::size_t n = pressure_.size();
  r.law.resize(n);
  r.product.resize(n);
  r.alignment.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double t = state.bound[k], z = state.dual_bound[k];
    r.law[k] = law_at(k).stress(t, pressure_[k]) - z;
    r.product[k] = t * z - state.gradient[k].dot(state.stress[k]);
    r.alignment[k] = z * state.gradient[k] - t * state.stress[k];
  }
  return r;
}

template <int Dim>
ConeResidual<Dim> InteriorPointSystem<Dim>::linearised(const ConeState<Dim>& state,
                                                       const ConeStep<Dim>& step) const {
  ConeResidual<Dim> r{-space_.internal_force(step.stress), {}, {}, {}};
  for (std::size_t k = 0; k < pressure_.size(); ++k) {
    const double t = state.bound[k], z = state.dual_bound[k];
    const double dt = step.bound[k], dz = step.dual_bound[k];
    r.law.push_back(law_at(k).stress_slope(t, pressure_[k]) * dt - dz);
    r.product.push_back(t * dz + z * dt - state.gradient[k].dot(step.stress[k]) -
                        step.gradient[k].dot(state.stress[k]));
    r.alignment.push_back(z * step.gradient[k] + state.gradient[k] * dz - t * step.stress[k] -
                          state.stress[k] * dt);
  }
  return r;
}

template <int Dim>
auto InteriorPointSystem<Dim>::eliminate(const ConeState<Dim>& state, std::size_t k) const
    -> Eliminated {
  const double t = state.bound[k], z = state.dual_bound[k];
  const Vector &g = state.gradient[k], &stress = state.stress[k];
  const double norm = g.norm();
  Eliminated point{t, law_at(k).stress_slope(t, pressure_[k]), 0, g, stress, (z / t) * g + stress,
                   {}};
  point.pivot = point.slope * (t - norm) * (t + norm) / t + z + g.dot(stress) / t;
  if constexpr (Dim == 1) {
    // The general expression below, expanded: every term is positive, nothing cancels in flow.
    const double excess = (z - std::abs(stress[0])) * (z + std::abs(stress[0]));
    point.tangent(0, 0) = (point.slope * (z * t + g[0] * stress[0]) + excess) / (t * point.pivot);
  } else {
    // Symmetric on the central path; the symmetric part keeps one factorisation for all.
    const typename Space::Tangent rank_one =
        (point.slope * g - stress) * point.alpha.transpose() / (t * point.pivot);
    point.tangent = (z / t) * Space::Tangent::Identity() + 0.5 * (rank_one + rank_one.transpose());
  }
  return point;
}

template <int Dim>
void InteriorPointSystem<Dim>::assemble(const ConeState<Dim>& state) {
  std::vector<typename Space::Tangent> tangents(pressure_.size());
  eliminated_.resize(pressure_.size());
  for (std::size_t k = 0; k < tangents.size(); ++k) {
    eliminated_[k] = eliminate(state, k);
    tangents[k] = eliminated_[k].tangent;
  }
  space_.assemble(tangents);
}

template <int Dim>
bool InteriorPointSystem<Dim>::newton_step(const ConeResidual<Dim>& residual,
                                           ConeStep<Dim>& step) const {
  const std::size_t n = eliminated_.size();
  std::vector<double> constant(n);     // b:  dt = (α·dg + b)/K
  std::vector<Vector> stress_part(n);  // what dτ holds besides A dg
  for (std::size_t k = 0; k < n; ++k) {
    const Eliminated& point = eliminated_[k];
    const Vector alignment = point.gradient * residual.law[k] + residual.alignment[k];
    constant[k] =
        -residual.product[k] - point.t * residual.law[k] + point.gradient.dot(alignment) / point.t;
    stress_part[k] =
        (point.slope * point.gradient - point.stress) * (constant[k] / (point.t * point.pivot)) +
        alignment / point.t;
  }
  const Eigen::VectorXd right = residual.equilibrium - space_.internal_force(stress_part);
  if (!space_.solve(right, step.velocity)) return false;
  space_.gradients(step.velocity, step.gradient);
  step.bound.resize(n);
  step.dual_bound.resize(n);
  step.stress.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Eliminated& point = eliminated_[k];
    // course 15: interior-point step
    step.bound[k] = (point.alpha.dot(step.gradient[k]) + constant[k]) / point.pivot;
    step.dual_bound[k] = point.slope * step.bound[k] + residual.law[k];
    step.stress[k] = point.tangent * step.gradient[k] + stress_part[k];
    // end of course 15
  }
  return true;
}

template <int Dim>
ConeState<Dim> InteriorPointSystem<Dim>::moved(const ConeState<Dim>& state, double length,
                                               const ConeStep<Dim>& step) const {
  ConeState<Dim> result = state;
  result.velocity = state.velocity.moved(length, step.velocity);
  space_.gradients(result.velocity, result.gradient);
  for (std::size_t k = 0; k < step.bound.size(); ++k) {
    result.bound[k] += length * step.bound[k];
    result.dual_bound[k] += length * step.dual_bound[k];
    result.stress[k] += length * step.stress[k];
  }
  return result;
}

template class InteriorPointSystem<1>;
template class InteriorPointSystem<2>;

}  // namespace talus::shear
