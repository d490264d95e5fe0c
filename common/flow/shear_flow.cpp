#include "common/flow/shear_flow.hpp"

#include <limits>

#include "common/flow/load_capacity.hpp"

namespace talus::flow {

template <int Dim>
ShearFlow<Dim>::ShearFlow(Space& space, rheology::Rheology rheology,
                          const std::function<double(const Vector&)>& total_pressure,
                          const std::function<double(const Vector&)>& body_force)
    : space_(space),
      rheology_(std::move(rheology)),
      load_(space.load(body_force)),
      tangents_(space.points().size()) {
  for (const auto& point : space.points())
    total_pressure_.push_back(total_pressure(point.position));
  set_lambda_r(rheology_.lambda_r);
}

template <int Dim>
void ShearFlow<Dim>::set_lambda_r(double lambda_r) {
  rheology_.lambda_r = lambda_r;
  regularised_pressure_.clear();
  for (const double p : total_pressure_)
    regularised_pressure_.push_back(rheology::regularise_pressure(p, lambda_r).value);
}

template <int Dim>
const solve::Residual& ShearFlow<Dim>::evaluate(const State& w) {
  std::visit([&](const auto& kind) { evaluate_with(kind, w); }, rheology_.regularisation);
  return residual_;
}

template <int Dim>
template <class Regularisation>
void ShearFlow<Dim>::evaluate_with(const Regularisation& regularisation, const State& w) {
  using Values = typename Space::NodalValues;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr long double extended_epsilon = std::numeric_limits<long double>::epsilon();
  constexpr double operations = 4;  // roundings that reach a contribution, beyond the gradient's
  const double sign = tangent_term_ == TangentTerm::full     ? 1
                      : tangent_term_ == TangentTerm::frozen ? 0
                                                             : -1;
  residual_.value = -load_;
  residual_.magnitude = load_.cwiseAbs();
  residual_.round_off = epsilon * residual_.magnitude;
  const std::size_t per_element = space_.points_per_element();
  for (std::size_t e = 0, k = 0; e < space_.element_count(); ++e) {
    const auto& nodes = space_.mesh().elements[e];
    const typename Space::LongNodalValues relative = space_.relative_velocities(w, e);
    Values uncertainty;  // of the relative velocities
    for (int a = 0; a < Space::nodes_per_element; ++a)
      uncertainty[a] = w.resolution() * std::abs(w.value()[nodes[static_cast<std::size_t>(a)]]) +
                       static_cast<double>(extended_epsilon * std::abs(relative[a]));
    Values force = Values::Zero(), magnitude = Values::Zero(), round_off = Values::Zero();
    for (std::size_t q = 0; q < per_element; ++q, ++k) {
      const auto& point = space_.points()[k];
      const Vector g = point.gradient(relative);
      const double shear_rate = g.norm();
      const rheology::Viscosity v = regularisation.evaluate(rheology_.law, rheology_.lambda_r,
                                                            shear_rate, regularised_pressure_[k]);
      const Vector stress = v.eta * g;
      tangents_[k] = v.eta * Space::Tangent::Identity();
      if (shear_rate > 0)
        tangents_[k] += (sign * v.d_eta_d_shear_rate / shear_rate) * (g * g.transpose());
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
  return space_.solve(right_hand_side, x);
}

template <int Dim>
bool ShearFlow<Dim>::exceeds_capacity(const State& w) const {
  return recession<Dim>(space_, rheology_.law, regularised_pressure_, load_, w) < 0;
}

template class ShearFlow<1>;
template class ShearFlow<2>;

}  // namespace talus::flow
