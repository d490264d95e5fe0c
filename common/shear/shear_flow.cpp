#include "common/shear/shear_flow.hpp"

#include <algorithm>
#include <limits>

#include "common/shear/load_capacity.hpp"
#include "common/shear/wall_law.hpp"

namespace talus::shear {

template <int Dim>
ShearFlow<Dim>::ShearFlow(Space& space, rheology::Rheology rheology,
                          const std::function<double(const Vector&)>& total_pressure,
                          const std::function<double(const Vector&)>& body_force)
    : space_(space),
      rheology_(std::move(rheology)),
      wall_(wall_rheology(rheology_)),
      load_(space.load(body_force)),
      tangents_(space.points().size()),
      stress_(space.points().size()) {
  for (const auto& point : space.points())
    total_pressure_.push_back(total_pressure(point.position));
  set_lambda_r(rheology_.lambda_r);
}

template <int Dim>
void ShearFlow<Dim>::set_lambda_r(double lambda_r) {
  rheology_.lambda_r = wall_.lambda_r = lambda_r;
  regularised_pressure_.clear();
  for (const double p : total_pressure_)
    regularised_pressure_.push_back(rheology_.regularised_pressure(p));
}

template <int Dim>
const solve::Residual& ShearFlow<Dim>::evaluate(const State& w) {
  std::visit([&](const auto& kind) { evaluate_with(kind, w); }, rheology_.regularisation);
  return residual_;
}

template <int Dim>
auto ShearFlow<Dim>::tangent(const rheology::Viscosity& v, const Vector& g,
                             const Vector* carried) const -> typename Space::Tangent {
  const typename Space::Tangent isotropic = v.eta * Space::Tangent::Identity();
  const double shear_rate = g.norm();
  // Without a viscosity (p_regu = 0) there is no slope either, and nothing to divide τ by.
  if (shear_rate == 0 || v.eta == 0) return isotropic;
  const double factor = tangent_term_ == TangentTerm::frozen       ? 0
                        : tangent_term_ == TangentTerm::wrong_sign ? -slope_factor_
                                                                   : slope_factor_;
  const double slope = factor * v.d_eta_d_shear_rate;
  // course 8: point tangent
  if (!carried) return isotropic + slope / shear_rate * (g * g.transpose());
  // end of course 8
  // τ is cut to where the tangent stays positive definite, |τ| < σ/(1 - x), σ = η|g|,
  // x = d ln σ/d ln|g|: at σ(1 + x/2).
  const double stress = v.eta * shear_rate, size = carried->norm();
  const double x = 1 + v.d_eta_d_shear_rate * shear_rate / v.eta, limit = stress * (1 + 0.5 * x);
  const Vector strain = *carried * ((size > limit ? limit / size : 1) / v.eta);
  return isotropic + 0.5 * slope / shear_rate * (g * strain.transpose() + strain * g.transpose());
}

template <int Dim>
template <class Regularisation>
rheology::Viscosity ShearFlow<Dim>::viscosity(const Regularisation& regularisation,
                                              double shear_rate, std::size_t k) const {
  if (space_.points()[k].on_wall) return wall_.evaluate(shear_rate, total_pressure_[k]);
  return rheology_.evaluate(regularisation, shear_rate, regularised_pressure_[k]);
}

template <int Dim>
auto ShearFlow<Dim>::stress_of(const Stress& gradients) const -> Stress {
  Stress stress;
  std::visit(
      [&](const auto& kind) {
        for (const Vector& g : gradients)
          stress.push_back(viscosity(kind, g.norm(), stress.size()).eta * g);
      },
      rheology_.regularisation);
  return stress;
}

template <int Dim>
template <class Regularisation>
void ShearFlow<Dim>::evaluate_with(const Regularisation& regularisation, const State& w) {
  using Values = typename Space::NodalValues;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr long double extended_epsilon = std::numeric_limits<long double>::epsilon();
  constexpr double operations = 4;  // roundings that reach a contribution, beyond the gradient's
  residual_.value = -load_;
  residual_.magnitude = load_.cwiseAbs();
  residual_.round_off = epsilon * residual_.magnitude;
  residual_.rest_size = rheology_.lambda_r;  // over a unit length
  const bool carries = tangent_term_ == TangentTerm::primal_dual && !w.stress.empty();
  for (std::size_t e = 0; e < space_.element_count(); ++e) {
    const auto& nodes = space_.mesh().elements[e];
    const typename Space::LocalVelocities local = space_.local_velocities(w, e);
    Values uncertainty;  // of the relative velocities
    for (int a = 0; a < Space::nodes_per_element; ++a)
      uncertainty[a] = w.resolution() * std::abs(w.value()[nodes[static_cast<std::size_t>(a)]]) +
                       static_cast<double>(extended_epsilon * std::abs(local.relative[a]));
    Values force = Values::Zero(), magnitude = Values::Zero(), round_off = Values::Zero();
    for (const std::size_t k : space_.points_of(e)) {
      const auto& point = space_.points()[k];
      const Vector g = point.gradient(local);
      const rheology::Viscosity v = viscosity(regularisation, g.norm(), k);
      const Vector& stress = stress_[k] = v.eta * g;
      tangents_[k] = tangent(v, g, carries ? &w.stress[k] : nullptr);
      const Vector stress_size = stress.cwiseAbs();
      const Vector stress_round_off =
          operations * epsilon * stress_size +
          tangents_[k].cwiseAbs() * (point.gradients.cwiseAbs() * uncertainty);
      const auto transposed = point.gradients.transpose();
      force.noalias() += point.weight * (transposed * stress);
      magnitude.noalias() += point.weight * (transposed.cwiseAbs() * stress_size);
      round_off.noalias() += point.weight * (transposed.cwiseAbs() * stress_round_off);
    }
    for (int a = 0; a < Space::nodes_per_element; ++a) {
      const Eigen::Index node = nodes[static_cast<std::size_t>(a)];
      if (space_.mesh().fixed[static_cast<std::size_t>(node)]) continue;
      residual_.value[node] += force[a];
      residual_.magnitude[node] += magnitude[a];
      residual_.round_off[node] += round_off[a];
    }
  }
}

template <int Dim>
bool ShearFlow<Dim>::linear_solve(const Eigen::VectorXd& right_hand_side, State& x) {
  space_.assemble(tangents_);
  if (!space_.solve(right_hand_side, x)) return false;
  x.stress.clear();
  if (tangent_term_ == TangentTerm::primal_dual) {
    space_.gradients(x, x.stress);
    for (std::size_t k = 0; k < stress_.size(); ++k)
      x.stress[k] = stress_[k] + tangents_[k] * x.stress[k];
  }
  return true;
}

template <int Dim>
bool ShearFlow<Dim>::exceeds_capacity(const State& w) const {
  std::vector<double> pressure;
  for (const rheology::RegularisedPressure& p : regularised_pressure_) pressure.push_back(p.value);
  return recession<Dim>(space_, rheology_.law, pressure, load_, w) < 0;
}

template class ShearFlow<1>;
template class ShearFlow<2>;

}  // namespace talus::shear
