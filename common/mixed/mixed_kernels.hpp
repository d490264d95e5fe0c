// What velocity-pressure flow computes inside elements, for as many elements at once as the
// machine's vectors hold: kinematics, forces from stresses, tangents.
#pragma once

#include "common/mixed/condensed_system.hpp"
#include "common/mixed/mixed_space.hpp"

namespace talus::mixed {

/// grad N_a at a quadrature point.
template <int Dim>
using PackGradients = std::array<PackVector<Dim>, MixedSpace<Dim>::nodes_per_element>;

/// Parts of the tangent scaled: 1 is right, 0 leaves one out, -1 has its sign wrong. Only 1
/// everywhere is Newton; the others exist to show that checks find them.
struct TangentFactors {
  double shear_rate = 1;  ///< of η'(|γ|)
  double pressure = 1;    ///< of η'(p)
  double inertia = 1;
};

/// What the tangent needs to know of the state at one quadrature point.
template <int Dim>
struct PointState {
  PackVector<Dim> velocity;
  PackTensor<Dim> gradient;  ///< gradient[i][j] = ∂_j u_i
  Pack viscosity;            ///< η
  Pack shear_rate_slope;     ///< η'(|γ|)/|γ|
  Pack pressure_slope;       ///< η'(p)
};

/// γ = grad u + grad uᵀ.
template <int Dim>
PackTensor<Dim> rate_of_strain(const PackTensor<Dim>& gradient) {
  PackTensor<Dim> gamma;
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j) gamma[i][j] = gradient[i][j] + gradient[j][i];
  return gamma;
}

template <int Dim>
Pack contract(const PackTensor<Dim>& a, const PackTensor<Dim>& b) {
  Pack sum = 0;
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j) sum += a[i][j] * b[i][j];
  return sum;
}

template <int Dim>
void physical_gradients(const typename MixedSpace<Dim>::BatchPoint& point,
                        const fem::QuadraticBasis<Dim>& basis, PackGradients<Dim>& gradients) {
  for (std::size_t a = 0; a < gradients.size(); ++a)
    for (std::size_t j = 0; j < Dim; ++j) {
      Pack sum = 0;
      for (std::size_t k = 0; k < Dim; ++k)
        sum += basis.gradients(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(a)) *
               point.inverse_jacobian[k][j];
      gradients[a][j] = sum;
    }
}

/// The unknowns of a batch: velocities relative to the interior node, which keeps differences
/// exact where a plug moves as one, and that node's own.
template <int Dim>
struct BatchState {
  static constexpr int nodes = MixedSpace<Dim>::nodes_per_element;
  std::array<PackVector<Dim>, nodes> relative;
  PackVector<Dim> centre;
  std::array<Pack, Dim + 1> pressure;

  BatchState(const MixedSpace<Dim>& space, const typename MixedSpace<Dim>::Batch& batch,
             const solve::CompensatedVector& state) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t e = batch.elements[lane];
      const auto& element = space.mesh().elements[e];
      for (int i = 0; i < Dim; ++i) {
        const auto d = static_cast<std::size_t>(i);
        const Eigen::Index origin = space.velocity_index(element[MixedSpace<Dim>::interior], i);
        centre[d][lane] = state.value()[origin];
        for (std::size_t a = 0; a < nodes; ++a)
          relative[a][d][lane] =
              state.short_difference(space.velocity_index(element[a], i), origin);
      }
      for (int k = 0; k <= Dim; ++k)
        pressure[static_cast<std::size_t>(k)][lane] = state.value()[space.pressure_index(e, k)];
    }
  }

  PackTensor<Dim> gradient(const PackGradients<Dim>& gradients) const {
    PackTensor<Dim> result{};
    for (std::size_t a = 0; a < nodes; ++a)
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j) result[i][j] += relative[a][i] * gradients[a][j];
    return result;
  }
  PackVector<Dim> velocity(const fem::QuadraticBasis<Dim>& basis) const {
    PackVector<Dim> result = centre;
    for (std::size_t a = 0; a < nodes; ++a)
      for (std::size_t i = 0; i < Dim; ++i)
        result[i] += relative[a][i] * basis.values[static_cast<Eigen::Index>(a)];
    return result;
  }
  Pack pressure_at(const typename MixedSpace<Dim>::BatchPoint& point) const {
    Pack result = pressure[0];
    for (std::size_t k = 0; k < Dim; ++k) result += pressure[k + 1] * point.pressure_basis[k];
    return result;
  }
};

/// τ/η - γ, which vanishes at a solution. As for a cross-section, τ is cut to where the viscous
/// part of the tangent stays definite, |τ| <= σ(1 + x/2), σ = η|γ|, x = d ln σ/d ln|γ|.
template <int Dim>
PackTensor<Dim> excess_strain(const PointState<Dim>& at, const PackTensor<Dim>& stress);

/// Change of ηγ with that of the velocity gradient and the pressure, as the tangent has it:
/// η δγ + (η'/|γ|) ½ ((γ:δγ/2) τ/η + (τ/η:δγ/2) γ) + η'(p) γ δp; without τ Newton's own.
template <int Dim>
PackTensor<Dim> stress_change(const PointState<Dim>& at, const PackTensor<Dim>* carried_stress,
                              const PackTensor<Dim>& gradient_change, const Pack& pressure_change,
                              const TangentFactors& factors);

/// What is integrated at a quadrature point: stress σ against grad N, body g against N, and the
/// divergence against the pressures.
template <int Dim>
struct Integrand {
  PackTensor<Dim> stress{};
  PackVector<Dim> body{};
  Pack divergence = 0;
};

/// Integrals over a batch: ∫ σ·grad N + g N for every velocity, -∫ ψ div for every pressure.
template <int Dim>
struct BatchForce {
  std::array<PackVector<Dim>, MixedSpace<Dim>::nodes_per_element> force{};
  std::array<Pack, Dim + 1> mass{};

  void add(const typename MixedSpace<Dim>::BatchPoint& point, const fem::QuadraticBasis<Dim>& basis,
           const PackGradients<Dim>& gradients, const Integrand<Dim>& at) {
    for (std::size_t a = 0; a < force.size(); ++a)
      for (std::size_t i = 0; i < Dim; ++i) {
        Pack sum = at.body[i] * basis.values[static_cast<Eigen::Index>(a)];
        for (std::size_t j = 0; j < Dim; ++j) sum += at.stress[i][j] * gradients[a][j];
        force[a][i] += point.weight * sum;
      }
    const Pack source = point.weight * at.divergence;
    mass[0] -= source;
    for (std::size_t k = 0; k < Dim; ++k) mass[k + 1] -= source * point.pressure_basis[k];
  }
  /// The same with absolute values of the bases: bounds instead of sums.
  void add_bound(const typename MixedSpace<Dim>::BatchPoint& point,
                 const fem::QuadraticBasis<Dim>& basis, const PackGradients<Dim>& gradients,
                 const Integrand<Dim>& at) {
    using std::experimental::abs;
    for (std::size_t a = 0; a < force.size(); ++a)
      for (std::size_t i = 0; i < Dim; ++i) {
        Pack sum = at.body[i] * std::abs(basis.values[static_cast<Eigen::Index>(a)]);
        for (std::size_t j = 0; j < Dim; ++j) sum += at.stress[i][j] * abs(gradients[a][j]);
        force[a][i] += point.weight * sum;
      }
    const Pack source = point.weight * at.divergence;
    mass[0] += source;
    for (std::size_t k = 0; k < Dim; ++k) mass[k + 1] += source * abs(point.pressure_basis[k]);
  }
  void scatter(const MixedSpace<Dim>& space, const typename MixedSpace<Dim>::Batch& batch,
               Eigen::VectorXd& result) const {
    for (std::size_t lane = 0; lane < batch.count; ++lane) {
      const std::size_t e = batch.elements[lane];
      for (std::size_t a = 0; a < force.size(); ++a)
        for (std::size_t i = 0; i < Dim; ++i)
          result[space.velocity_index(space.mesh().elements[e][a], static_cast<int>(i))] +=
              force[a][i][lane];
      for (std::size_t k = 0; k <= Dim; ++k)
        result[space.pressure_index(e, static_cast<int>(k))] += mass[k][lane];
    }
  }
};

/// The tangents of a batch, with the stress it carries or none (nullptr). With G_a = grad N_a, b_a
/// = γ·G_a and w the quadrature weight,
///   ∂R_ai/∂u_bj = Σ w { η (δ_ij G_a·G_b + G_aj G_bi) + (η'/|γ|) b_ai b_bj
///                       + N_a (δ_ij u·G_b + ∂_j u_i N_b) },
///   ∂R_ai/∂p_k = Σ w ψ_k (η'(p) b_ai - G_ai),  ∂R_k/∂u_bj = -Σ w ψ_k G_bj,
///   ∂R_k/∂p_l = -λp Σ w ψ_k ψ_l.
/// In the primal-dual form ½ (b_ai c_bj + c_ai b_bj), c_a = (τ/η)·G_a, stands for b_ai b_bj.
template <int Dim>
void batch_tangent(const MixedSpace<Dim>& space, const typename MixedSpace<Dim>::Batch& batch,
                   const std::array<PointState<Dim>, MixedSpace<Dim>::points_per_element>& states,
                   const CarriedStress<Dim>* carried_stress, const Pack& penalty, double inertia,
                   const TangentFactors& factors, BatchTangent<Dim>& tangent);

}  // namespace talus::mixed
