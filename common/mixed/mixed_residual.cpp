// The residual of velocity-pressure flow, with the size of its contributions and a bound on its
// rounding.
#include <limits>

#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double operations = 8;  // roundings that reach a contribution

// η and its slopes at every lane; |γ| and the total pressure vary from lane to lane.
template <class Regularisation>
void evaluate_viscosity(const Regularisation& regularisation, const rheology::Rheology& rheology,
                        const Pack& shear_rate, const Pack& total_pressure, Pack& viscosity,
                        Pack& shear_rate_slope, Pack& pressure_slope) {
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const rheology::Viscosity v = rheology.evaluate(
        regularisation, shear_rate[lane], rheology.regularised_pressure(total_pressure[lane]));
    viscosity[lane] = v.eta;
    // At rest the slope only ever meets factors γ = 0.
    shear_rate_slope[lane] = shear_rate[lane] > 0 ? v.d_eta_d_shear_rate / shear_rate[lane] : 0;
    pressure_slope[lane] = v.d_eta_d_pressure;
  }
}

// The integrand of the residual at a point, what its contributions sum up to in absolute value, and
// how far rounding may have moved them.
template <int Dim>
struct BoundedIntegrand {
  Integrand<Dim> value, size, error;
};

// How far the velocities of a batch relative to its interior nodes may be off.
template <int Dim>
using Uncertainty = std::array<PackVector<Dim>, BatchState<Dim>::nodes>;

template <int Dim>
Uncertainty<Dim> uncertainty_of(const BatchState<Dim>& local, double resolution) {
  using std::experimental::abs;
  Uncertainty<Dim> uncertainty;
  for (std::size_t a = 0; a < uncertainty.size(); ++a)
    for (std::size_t i = 0; i < Dim; ++i)
      uncertainty[a][i] = resolution * abs(local.relative[a][i] + local.centre[i]) +
                          2 * epsilon * abs(local.relative[a][i]);
  return uncertainty;
}

// σ = ηγ - p 1, g = (u·grad) u - f, div u. `spread` bounds the rounding of the gradient.
template <int Dim>
BoundedIntegrand<Dim> integrand_at(const PointState<Dim>& at, const Pack& pressure,
                                   const PackVector<Dim>& driving, double inertia,
                                   const PackTensor<Dim>& spread) {
  using std::experimental::abs;
  BoundedIntegrand<Dim> result;
  auto& [value, size, error] = result;
  const PackTensor<Dim> gamma = rate_of_strain<Dim>(at.gradient);
  PackTensor<Dim> gamma_size;
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j) gamma_size[i][j] = abs(gamma[i][j]);
  const Pack viscosity_error = abs(at.shear_rate_slope) * contract<Dim>(gamma_size, spread);
  for (std::size_t i = 0; i < Dim; ++i) {
    Pack advection = 0, advection_size = 0;
    for (std::size_t j = 0; j < Dim; ++j) {
      value.stress[i][j] = at.viscosity * gamma[i][j];
      size.stress[i][j] = abs(value.stress[i][j]);
      error.stress[i][j] = operations * epsilon * size.stress[i][j] +
                           at.viscosity * (spread[i][j] + spread[j][i]) +
                           viscosity_error * gamma_size[i][j];
      advection += at.velocity[j] * at.gradient[i][j];
      advection_size += abs(at.velocity[j] * at.gradient[i][j]);
    }
    value.stress[i][i] -= pressure;
    size.stress[i][i] += abs(pressure);
    error.stress[i][i] += operations * epsilon * abs(pressure);
    value.body[i] = inertia * advection - driving[i];
    size.body[i] = inertia * advection_size + abs(driving[i]);
    error.body[i] = operations * epsilon * size.body[i];
    value.divergence += at.gradient[i][i];
    error.divergence += spread[i][i];
  }
  return result;
}

}  // namespace

template <int Dim>
void MixedFlow<Dim>::assemble_with(const rheology::Rheology& rheology,
                                   const solve::CompensatedVector& state, solve::Residual& residual,
                                   std::vector<States>* states) const {
  std::visit([&](const auto& kind) { assemble(kind, rheology, state, residual, states); },
             rheology.regularisation);
  if (!space_.open_faces().empty()) add_open_sides(rheology, state, residual);
  space_.clear_fixed(residual.magnitude);
  space_.clear_fixed(residual.round_off);
}

template <int Dim>
template <class Regularisation>
void MixedFlow<Dim>::assemble(const Regularisation& regularisation,
                              const rheology::Rheology& rheology,
                              const solve::CompensatedVector& state, solve::Residual& residual,
                              std::vector<States>* states) const {
  using std::experimental::abs;
  using std::experimental::sqrt;
  residual.value = Eigen::VectorXd::Zero(space_.size());
  residual.value.head(space_.velocity_count()) = -space_.traction_load();
  residual.magnitude = residual.value.cwiseAbs();
  residual.round_off = epsilon * residual.magnitude;
  residual.block_ends = {space_.velocity_count(), space_.size()};
  residual.rest_size = rheology.lambda_r;  // over a unit length
  space_.for_each_batch([&](std::size_t b) {
    const auto& batch = space_.batches()[b];
    const BatchState<Dim> local(space_, batch, state);
    const Uncertainty<Dim> uncertainty = uncertainty_of(local, state.resolution());
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
      evaluate_viscosity(regularisation, rheology, sqrt(0.5 * contract<Dim>(gamma, gamma)),
                         pressure + loads_[b][q].static_pressure, at.viscosity, at.shear_rate_slope,
                         at.pressure_slope);

      PackTensor<Dim> spread{};
      Pack divergence_size = 0;
      PackVector<Dim> driving;
      for (std::size_t i = 0; i < Dim; ++i) {
        driving[i] = load_factor_ * loads_[b][q].body_force[i];
        for (std::size_t a = 0; a < uncertainty.size(); ++a) {
          divergence_size += abs(gradients[a][i] * local.relative[a][i]);
          for (std::size_t j = 0; j < Dim; ++j)
            spread[i][j] += abs(gradients[a][j]) * uncertainty[a][i];
        }
      }
      BoundedIntegrand<Dim> integrand = integrand_at<Dim>(at, pressure, driving, inertia_, spread);
      integrand.value.divergence += residual_penalty() * pressure;
      integrand.size.divergence = divergence_size;
      integrand.error.divergence += operations * epsilon * divergence_size;
      force.add(point, basis, gradients, integrand.value);
      magnitude.add_bound(point, basis, gradients, integrand.size);
      round_off.add_bound(point, basis, gradients, integrand.error);
      if (states) (*states)[b][q] = at;
    }
    force.scatter(space_, batch, residual.value);
    magnitude.scatter(space_, batch, residual.magnitude);
    round_off.scatter(space_, batch, residual.round_off);
  });
}

template <int Dim>
void MixedFlow<Dim>::add_open_sides(const rheology::Rheology& rheology,
                                    const solve::CompensatedVector& state,
                                    solve::Residual& residual) const {
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

// The class is instantiated in mixed_flow.cpp, which does not see what is defined here.
template void MixedFlow<2>::assemble_with(const rheology::Rheology&,
                                          const solve::CompensatedVector&, solve::Residual&,
                                          std::vector<States>*) const;
template void MixedFlow<3>::assemble_with(const rheology::Rheology&,
                                          const solve::CompensatedVector&, solve::Residual&,
                                          std::vector<States>*) const;
template void MixedFlow<2>::add_open_sides(const rheology::Rheology&,
                                           const solve::CompensatedVector&, solve::Residual&) const;
template void MixedFlow<3>::add_open_sides(const rheology::Rheology&,
                                           const solve::CompensatedVector&, solve::Residual&) const;

}  // namespace talus::mixed
