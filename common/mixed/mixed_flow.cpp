#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {
template <int Dim>
MixedFlow<Dim>::MixedFlow(const Space& space, rheology::Rheology rheology,
                          const MixedLoad<Dim>& load, PenaltyOptions penalty)
    : space_(space),
      rheology_(std::move(rheology)),
      penalty_(penalty),
      static_pressure_(load.static_pressure),
      inertia_(load.inertia),
      system_(space),
      loads_(space.batches().size()),
      states_(space.batches().size()) {
  for (std::size_t b = 0; b < loads_.size(); ++b)
    for (std::size_t q = 0; q < loads_[b].size(); ++q)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const fem::Point<Dim> position = position_of(b, q, lane);
        const fem::Point<Dim> force = load.body_force(position);
        loads_[b][q].static_pressure[lane] = load.static_pressure(position);
        for (std::size_t d = 0; d < Dim; ++d)
          loads_[b][q].body_force[d][lane] = force[static_cast<Eigen::Index>(d)];
      }
}

template <int Dim>
FlowPoint<Dim> MixedFlow<Dim>::point_at(const solve::CompensatedVector& state, std::size_t element,
                                        const fem::Point<Dim>& reference) const {
  const auto values = space_.values_at(state, element, reference);
  return {values, rheology_.local_state(values.shear_rate(),
                                        static_pressure_(values.position) + values.pressure)};
}

template <int Dim>
fem::Point<Dim> MixedFlow<Dim>::position_of(std::size_t batch, std::size_t point,
                                            std::size_t lane) const {
  fem::Point<Dim> position;
  for (std::size_t d = 0; d < Dim; ++d)
    position[static_cast<Eigen::Index>(d)] =
        space_.batches()[batch].points[point].position[d][lane];
  return position;
}

template <int Dim>
const solve::Residual& MixedFlow<Dim>::evaluate(const State& state) {
  assemble_with(rheology_, state, residual_, &states_);
  evaluated_ = state;
  is_factored_ = false;
  reactions_ = residual_.value.head(space_.velocity_count());
  space_.clear_fixed(residual_.value);
  return residual_;
}

template <int Dim>
Eigen::VectorXd MixedFlow<Dim>::tangent_product(const solve::CompensatedVector& x) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(space_.size());
  space_.for_each_batch([&](std::size_t b) {
    const auto& batch = space_.batches()[b];
    const BatchState<Dim> local(space_, batch, x);
    const CarriedStress<Dim>* carried = carried_in(b);
    BatchForce<Dim> force;
    for (std::size_t q = 0; q < batch.points.size(); ++q) {
      const auto& point = batch.points[q];
      const auto& basis = space_.bases()[q];
      const PointState<Dim>& at = states_[b][q];
      PackGradients<Dim> gradients;
      physical_gradients<Dim>(point, basis, gradients);
      const PackTensor<Dim> gradient = local.gradient(gradients);
      const PackVector<Dim> velocity = local.velocity(basis);
      const Pack pressure = local.pressure_at(point);
      Integrand<Dim> change;
      change.stress =
          stress_change<Dim>(at, carried ? &(*carried)[q] : nullptr, gradient, pressure, factors_);
      change.divergence = residual_penalty() * pressure;
      for (std::size_t i = 0; i < Dim; ++i) {
        for (std::size_t j = 0; j < Dim; ++j)
          change.body[i] += inertia_ * factors_.inertia *
                            (velocity[j] * at.gradient[i][j] + at.velocity[j] * gradient[i][j]);
        change.stress[i][i] -= pressure;
        change.divergence += gradient[i][i];
      }
      force.add(point, basis, gradients, change);
    }
    force.scatter(space_, batch, product);
  });
  if (!space_.open_faces().empty()) add_open_sides(x, product);
  space_.clear_fixed(product);
  return product;
}

template <int Dim>
Eigen::VectorXd MixedFlow<Dim>::load_derivative() const {
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(space_.size());
  for (std::size_t b = 0; b < loads_.size(); ++b) {
    const auto& batch = space_.batches()[b];
    BatchForce<Dim> force;
    for (std::size_t q = 0; q < batch.points.size(); ++q) {
      Integrand<Dim> driving;
      for (std::size_t i = 0; i < Dim; ++i) driving.body[i] = -loads_[b][q].body_force[i];
      force.add(batch.points[q], space_.bases()[q], PackGradients<Dim>{}, driving);
    }
    force.scatter(space_, batch, derivative);
  }
  space_.clear_fixed(derivative);
  return derivative;
}

template <int Dim>
Eigen::VectorXd MixedFlow<Dim>::log_lambda_r_derivative(
    const solve::CompensatedVector& state) const {
  constexpr double step = 1e-4;  // of ln λr: truncation and rounding are then both about 1e-9
  rheology::Rheology up = rheology_, down = rheology_;
  up.lambda_r *= std::exp(step);
  down.lambda_r *= std::exp(-step);
  solve::Residual above, below;
  assemble_with(up, state, above, nullptr);
  assemble_with(down, state, below, nullptr);
  Eigen::VectorXd derivative = (above.value - below.value) / (2 * step);
  space_.clear_fixed(derivative);
  return derivative;
}

template <int Dim>
void MixedFlow<Dim>::add_open_sides(const solve::CompensatedVector& x,
                                    Eigen::VectorXd& product) const {
  for (const auto& face : space_.open_faces()) {
    const auto side = open_side(space_, rheology_, static_pressure_, evaluated_, face);
    const auto unknowns = element_unknowns(space_, face.element);
    for (std::size_t v = 0; v < OpenSide<Dim>::velocities; ++v)
      for (std::size_t c = 0; c < OpenSide<Dim>::unknowns; ++c)
        product[unknowns[v]] +=
            side.tangent(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(c)) *
            x.value()[unknowns[c]];
  }
}

template class MixedFlow<2>;
template class MixedFlow<3>;

}  // namespace talus::mixed
