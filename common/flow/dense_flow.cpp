#include "common/flow/dense_flow.hpp"

#include <limits>

namespace talus::flow {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

// η and its slopes at every lane; |γ| and the total pressure vary from lane to lane.
template <class Regularisation>
void evaluate_viscosity(const Regularisation& regularisation, const rheology::Rheology& rheology,
                        const Pack& shear_rate, const Pack& total_pressure, Pack& viscosity,
                        Pack& shear_rate_slope, Pack& pressure_slope) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const auto p = rheology::regularise_pressure(total_pressure[lane], rheology.lambda_r);
    const rheology::Viscosity v =
        regularisation.evaluate(rheology.law, rheology.lambda_r, shear_rate[lane], p.value);
    viscosity[lane] = v.eta;
    // At rest the slope only ever meets factors γ = 0.
    shear_rate_slope[lane] = shear_rate[lane] > 0 ? v.d_eta_d_shear_rate / shear_rate[lane] : 0;
    pressure_slope[lane] = v.d_eta_d_pressure * p.derivative;
  }
}

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
        Point<Dim> position;
        for (std::size_t d = 0; d < Dim; ++d)
          position[static_cast<Eigen::Index>(d)] = space.batches()[b].points[q].position[d][lane];
        const Point<Dim> force = load.body_force(position);
        loads_[b][q].static_pressure[lane] = load.static_pressure(position);
        for (std::size_t d = 0; d < Dim; ++d)
          loads_[b][q].body_force[d][lane] = force[static_cast<Eigen::Index>(d)];
      }
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
void DenseFlow<Dim>::assemble_with(const rheology::Rheology& rheology, const State& state,
                                   solve::Residual& residual, std::vector<States>* states) const {
  std::visit([&](const auto& kind) { assemble(kind, rheology, state, residual, states); },
             rheology.regularisation);
  if (!space_.open_faces().empty()) add_open_sides(rheology, state, residual);
  space_.clear_fixed(residual.magnitude);
  space_.clear_fixed(residual.round_off);
}

template <int Dim>
template <class Regularisation>
void DenseFlow<Dim>::assemble(const Regularisation& regularisation,
                              const rheology::Rheology& rheology, const State& state,
                              solve::Residual& residual, std::vector<States>* states) const {
  using std::experimental::abs;
  using std::experimental::sqrt;
  constexpr double operations = 8;  // roundings that reach a contribution
  residual.value = Eigen::VectorXd::Zero(space_.size());
  residual.value.head(space_.velocity_count()) = -space_.traction_load();
  residual.magnitude = residual.value.cwiseAbs();
  residual.round_off = epsilon * residual.magnitude;
  residual.block_ends = {space_.velocity_count(), space_.size()};
  for (std::size_t b = 0; b < space_.batches().size(); ++b) {
    const auto& batch = space_.batches()[b];
    const BatchState<Dim> local(space_, batch, state);
    std::array<PackVector<Dim>, BatchState<Dim>::nodes> uncertainty;  // of relative velocities
    for (std::size_t a = 0; a < uncertainty.size(); ++a)
      for (std::size_t i = 0; i < Dim; ++i)
        uncertainty[a][i] = state.resolution() * abs(local.relative[a][i] + local.centre[i]) +
                            2 * epsilon * abs(local.relative[a][i]);
    BatchForce<Dim> force, magnitude, round_off;
    for (std::size_t q = 0; q < batch.points.size(); ++q) {
      const auto& point = batch.points[q];
      const auto& basis = space_.bases()[q];
      PackGradients<Dim> gradients;
      physical_gradients<Dim>(point, basis, gradients);
      PointState<Dim> at;
      at.velocity = local.velocity(basis);
      at.gradient = local.gradient(gradients);
      const Pack pressure = local.pressure_at(point);
      const PackTensor<Dim> gamma = rate_of_strain<Dim>(at.gradient);
      const Pack shear_rate = sqrt(0.5 * contract<Dim>(gamma, gamma));
      evaluate_viscosity(regularisation, rheology, shear_rate,
                         pressure + loads_[b][q].static_pressure, at.viscosity, at.shear_rate_slope,
                         at.pressure_slope);

      PackTensor<Dim> stress, size, error, spread{};  // spread: uncertainty of the gradient
      PackVector<Dim> body, body_size, body_error;
      Pack divergence = residual_penalty() * pressure, divergence_size = 0, divergence_error = 0;
      for (std::size_t a = 0; a < uncertainty.size(); ++a)
        for (std::size_t i = 0; i < Dim; ++i) {
          for (std::size_t j = 0; j < Dim; ++j)
            spread[i][j] += abs(gradients[a][j]) * uncertainty[a][i];
          divergence_size += abs(gradients[a][i] * local.relative[a][i]);
        }
      const Pack slope = 0.5 * abs(at.shear_rate_slope) * [&] {
        Pack sum = 0;
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j) sum += abs(gamma[i][j]) * 2 * spread[i][j];
        return sum;
      }();
      for (std::size_t i = 0; i < Dim; ++i) {
        Pack advection = 0, advection_size = 0;
        for (std::size_t j = 0; j < Dim; ++j) {
          stress[i][j] = at.viscosity * gamma[i][j];
          size[i][j] = abs(stress[i][j]);
          error[i][j] = operations * epsilon * size[i][j] +
                        at.viscosity * (spread[i][j] + spread[j][i]) + slope * abs(gamma[i][j]);
          advection += at.velocity[j] * at.gradient[i][j];
          advection_size += abs(at.velocity[j] * at.gradient[i][j]);
        }
        stress[i][i] -= pressure;
        size[i][i] += abs(pressure);
        error[i][i] += operations * epsilon * abs(pressure);
        const Pack driving = load_factor_ * loads_[b][q].body_force[i];
        body[i] = inertia_ * advection - driving;
        body_size[i] = inertia_ * advection_size + abs(driving);
        body_error[i] = operations * epsilon * body_size[i];
        divergence += at.gradient[i][i];
        divergence_error += spread[i][i];
      }
      divergence_error += operations * epsilon * divergence_size;
      force.add(point, basis, gradients, stress, body, divergence);
      magnitude.add_bound(point, basis, gradients, size, body_size, divergence_size);
      round_off.add_bound(point, basis, gradients, error, body_error, divergence_error);
      if (states) (*states)[b][q] = at;
    }
    force.scatter(space_, batch, residual.value);
    magnitude.scatter(space_, batch, residual.magnitude);
    round_off.scatter(space_, batch, residual.round_off);
  }
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
  return x.value().allFinite();
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
      PackTensor<Dim> stress;
      PackVector<Dim> body;
      Pack divergence = residual_penalty() * pressure;
      for (std::size_t i = 0; i < Dim; ++i) {
        body[i] = 0;
        for (std::size_t j = 0; j < Dim; ++j) {
          stress[i][j] =
              at.viscosity * (gradient[i][j] + gradient[j][i]) + viscosity_change * gamma[i][j];
          body[i] += inertia_ * factors_.inertia *
                     (velocity[j] * at.gradient[i][j] + at.velocity[j] * gradient[i][j]);
        }
        stress[i][i] -= pressure;
        divergence += gradient[i][i];
      }
      force.add(point, basis, gradients, stress, body, divergence);
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
      PackVector<Dim> body;
      for (std::size_t i = 0; i < Dim; ++i) body[i] = -loads_[b][q].body_force[i];
      force.add(batch.points[q], space_.bases()[q], PackGradients<Dim>{}, PackTensor<Dim>{}, body,
                0);
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
void DenseFlow<Dim>::add_open_sides(const rheology::Rheology& rheology, const State& state,
                                    solve::Residual& residual) const {
  constexpr double operations = 8;
  for (const auto& face : space_.open_faces()) {
    const auto side = open_side(space_, rheology, static_pressure_, state, face);
    const auto unknowns = element_unknowns(space_, face.element);
    for (std::size_t v = 0; v < OpenSide<Dim>::velocities; ++v) {
      const auto i = static_cast<Eigen::Index>(v);
      residual.value[unknowns[v]] += side.force[i];
      residual.magnitude[unknowns[v]] += side.magnitude[i];
      residual.round_off[unknowns[v]] += operations * epsilon * side.magnitude[i];
    }
  }
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
