#include "common/flow/dense_flow.hpp"

#include <limits>

namespace talus::flow {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace

template <int Dim>
DenseFlow<Dim>::DenseFlow(const Space& space, rheology::Rheology rheology,
                          const DenseLoad<Dim>& load, PenaltyOptions penalty)
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
        const Point<Dim> position = position_of(b, q, lane);
        const Point<Dim> force = load.body_force(position);
        loads_[b][q].static_pressure[lane] = load.static_pressure(position);
        for (std::size_t d = 0; d < Dim; ++d)
          loads_[b][q].body_force[d][lane] = force[static_cast<Eigen::Index>(d)];
      }
}

template <int Dim>
Point<Dim> DenseFlow<Dim>::position_of(std::size_t batch, std::size_t q, std::size_t lane) const {
  Point<Dim> position;
  for (std::size_t d = 0; d < Dim; ++d)
    position[static_cast<Eigen::Index>(d)] = space_.batches()[batch].points[q].position[d][lane];
  return position;
}

template <int Dim>
const solve::Residual& DenseFlow<Dim>::evaluate(const State& state) {
  assemble_with(rheology_, state, residual_, &states_);
  evaluated_ = state;
  is_factored_ = false;
  reactions_ = residual_.value.head(space_.velocity_count());
  space_.clear_fixed(residual_.value);
  return residual_;
}

template <int Dim>
Pack DenseFlow<Dim>::tangent_penalty(std::size_t batch) const {
  if (penalty_.kind == Penalty::plain) return penalty_.lambda_p;
  Pack viscosity = 0;
  for (const PointState<Dim>& at : states_[batch]) viscosity += at.viscosity;
  return penalty_.lambda_p * Space::points_per_element / viscosity;
}

template <int Dim>
bool DenseFlow<Dim>::linear_solve(const Eigen::VectorXd& right_hand_side, State& x) {
  if (!is_factored_) {
    auto tangent = std::make_unique<BatchTangent<Dim>>();
    system_.set_zero();
    for (std::size_t b = 0; b < states_.size(); ++b) {
      batch_tangent<Dim>(space_, space_.batches()[b], states_[b], tangent_penalty(b), inertia_,
                         factors_, *tangent);
      add_open_sides(b, *tangent);
      system_.add(b, *tangent);
    }
    ++factorisations_;
    is_factored_ = system_.factor();
    if (!is_factored_) return false;
  }
  // Refined until it no longer helps: this also takes the penalty out of the step.
  constexpr int most_refinements = 4;
  constexpr double worthwhile = 0.1;
  Eigen::VectorXd correction;
  if (!system_.solve(right_hand_side, correction)) return false;
  x = State(correction);
  double last = std::numeric_limits<double>::infinity();
  for (int refinement = 0; refinement < most_refinements; ++refinement) {
    const Eigen::VectorXd rest = right_hand_side - tangent_product(x);
    const double norm = rest.norm();
    if (norm > worthwhile * last || norm <= epsilon * right_hand_side.norm()) break;
    last = norm;
    if (!system_.solve(rest, correction)) return false;
    x = x.moved(1, State(correction));
  }
  if (carries_stress_) update_carried_stress(x);
  return x.value().allFinite();
}

template <int Dim>
void DenseFlow<Dim>::carry_stress(const StressField& stress) {
  carries_stress_ = true;
  carried_.clear();
  if (!stress) return;
  carried_.resize(loads_.size());
  for (std::size_t b = 0; b < carried_.size(); ++b)
    for (std::size_t q = 0; q < carried_[b].size(); ++q)
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto tau = stress(position_of(b, q, lane));
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j)
            carried_[b][q][i][j][lane] =
                tau(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
}

// τ after the step: η(γ + δγ) + (τ/η) (η'(|γ|) δ|γ| + η'(p) δp).
template <int Dim>
void DenseFlow<Dim>::update_carried_stress(const State& direction) {
  carried_.resize(loads_.size());
  for (std::size_t b = 0; b < states_.size(); ++b) {
    const auto& batch = space_.batches()[b];
    const BatchState<Dim> local(space_, batch, direction);
    for (std::size_t q = 0; q < batch.points.size(); ++q) {
      const PointState<Dim>& at = states_[b][q];
      PackGradients<Dim> gradients;
      physical_gradients<Dim>(batch.points[q], space_.bases()[q], gradients);
      const PackTensor<Dim> change = rate_of_strain<Dim>(local.gradient(gradients));
      const PackTensor<Dim> gamma = rate_of_strain<Dim>(at.gradient);
      const Pack viscosity_change = 0.5 * at.shear_rate_slope * contract<Dim>(gamma, change) +
                                    at.pressure_slope * local.pressure_at(batch.points[q]);
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j)
          carried_[b][q][i][j] =
              at.viscosity * (gamma[i][j] + change[i][j]) + viscosity_change * at.carried[i][j];
    }
  }
}

template <int Dim>
Eigen::VectorXd DenseFlow<Dim>::tangent_product(const State& x) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(space_.size());
  for (std::size_t b = 0; b < states_.size(); ++b) {
    const auto& batch = space_.batches()[b];
    const BatchState<Dim> local(space_, batch, x);
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
      const PackTensor<Dim> gamma = rate_of_strain<Dim>(at.gradient);
      const Pack viscosity_change =
          factors_.shear_rate * at.shear_rate_slope * contract<Dim>(gamma, gradient) +
          factors_.pressure * at.pressure_slope * pressure;
      Integrand<Dim> change;
      change.divergence = residual_penalty() * pressure;
      for (std::size_t i = 0; i < Dim; ++i) {
        for (std::size_t j = 0; j < Dim; ++j) {
          change.stress[i][j] = at.viscosity * (gradient[i][j] + gradient[j][i]) +
                                viscosity_change * at.carried[i][j];
          change.body[i] += inertia_ * factors_.inertia *
                            (velocity[j] * at.gradient[i][j] + at.velocity[j] * gradient[i][j]);
        }
        change.stress[i][i] -= pressure;
        change.divergence += gradient[i][i];
      }
      force.add(point, basis, gradients, change);
    }
    force.scatter(space_, batch, product);
  }
  if (!space_.open_faces().empty()) add_open_sides(x, product);
  space_.clear_fixed(product);
  return product;
}

template <int Dim>
Eigen::VectorXd DenseFlow<Dim>::load_derivative() const {
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
Eigen::VectorXd DenseFlow<Dim>::log_lambda_r_derivative(const State& state) const {
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
void DenseFlow<Dim>::add_open_sides(std::size_t number, BatchTangent<Dim>& tangent) const {
  const auto& batch = space_.batches()[number];
  for (const auto& face : space_.open_faces())
    for (std::size_t lane = 0; lane < batch.count; ++lane) {
      if (batch.elements[lane] != face.element) continue;
      const auto side = open_side(space_, rheology_, static_pressure_, evaluated_, face);
      for (std::size_t v = 0; v < OpenSide<Dim>::velocities; ++v) {
        const auto row = side.tangent.row(static_cast<Eigen::Index>(v));
        for (std::size_t c = 0; c < OpenSide<Dim>::unknowns; ++c) {
          Pack& entry = c < OpenSide<Dim>::velocities
                            ? tangent.velocity_velocity[v][c]
                            : tangent.velocity_pressure[v][c - OpenSide<Dim>::velocities];
          entry[lane] += row[static_cast<Eigen::Index>(c)];
        }
      }
    }
}

template <int Dim>
void DenseFlow<Dim>::add_open_sides(const State& x, Eigen::VectorXd& product) const {
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

template class DenseFlow<2>;
template class DenseFlow<3>;

}  // namespace talus::flow
