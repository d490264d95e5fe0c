#include "common/mixed/mixed_kernels.hpp"

#include <limits>

namespace talus::mixed {
namespace {

// What the tangent needs of a node at one quadrature point.
template <int Dim>
struct NodeTerms {
  PackVector<Dim> gradient;  // G_a
  PackVector<Dim> strain;    // b_a = γ·G_a
};
template <int Dim>
using ElementTerms = std::array<std::array<NodeTerms<Dim>, MixedSpace<Dim>::points_per_element>,
                                MixedSpace<Dim>::nodes_per_element>;
template <int Dim>
using States = std::array<PointState<Dim>, MixedSpace<Dim>::points_per_element>;

template <int Dim>
void fill(const MixedSpace<Dim>& space, const typename MixedSpace<Dim>::Batch& batch,
          const States<Dim>& states, ElementTerms<Dim>& terms) {
  for (std::size_t q = 0; q < batch.points.size(); ++q) {
    PackGradients<Dim> gradients;
    physical_gradients<Dim>(batch.points[q], space.bases()[q], gradients);
    const PackTensor<Dim> gamma = rate_of_strain<Dim>(states[q].gradient);
    for (std::size_t a = 0; a < gradients.size(); ++a) {
      NodeTerms<Dim>& at = terms[a][q];
      at.gradient = gradients[a];
      for (std::size_t i = 0; i < Dim; ++i) {
        at.strain[i] = 0;
        for (std::size_t j = 0; j < Dim; ++j) at.strain[i] += gamma[i][j] * gradients[a][j];
      }
    }
  }
}

template <int Dim>
void set_pressure_blocks(const typename MixedSpace<Dim>::Batch& batch, const States<Dim>& states,
                         const ElementTerms<Dim>& terms, const Pack& penalty, double factor,
                         BatchTangent<Dim>& tangent) {
  constexpr std::size_t pressures = MixedSpace<Dim>::pressures;
  std::array<std::array<Pack, pressures>, MixedSpace<Dim>::points_per_element> psi;  // w ψ_k
  tangent.pressure_pressure = {};
  for (std::size_t q = 0; q < psi.size(); ++q) {
    const auto& point = batch.points[q];
    psi[q][0] = point.weight;
    for (std::size_t k = 1; k < pressures; ++k)
      psi[q][k] = point.weight * point.pressure_basis[k - 1];
    for (std::size_t k = 0; k < pressures; ++k)
      for (std::size_t l = 0; l < pressures; ++l)
        tangent.pressure_pressure[k][l] -=
            penalty * psi[q][k] * (l == 0 ? Pack(1) : point.pressure_basis[l - 1]);
  }
  for (std::size_t a = 0; a < terms.size(); ++a)
    for (std::size_t i = 0; i < Dim; ++i) {
      std::array<Pack, pressures> column{}, row{};
      for (std::size_t q = 0; q < psi.size(); ++q) {
        const Pack divergence = terms[a][q].gradient[i];
        const Pack stress = factor * states[q].pressure_slope * terms[a][q].strain[i] - divergence;
        for (std::size_t k = 0; k < pressures; ++k) {
          column[k] += psi[q][k] * stress;
          row[k] -= psi[q][k] * divergence;
        }
      }
      for (std::size_t k = 0; k < pressures; ++k) {
        tangent.velocity_pressure[Dim * a + i][k] = column[k];
        tangent.pressure_velocity[k][Dim * a + i] = row[k];
      }
    }
}

// Without advection velocities see a symmetric block: half of it is computed.
template <int Dim>
void set_viscous_blocks(const typename MixedSpace<Dim>::Batch& batch, const States<Dim>& states,
                        const ElementTerms<Dim>& terms, double factor, BatchTangent<Dim>& tangent) {
  std::array<NodeTerms<Dim>, MixedSpace<Dim>::points_per_element> row;  // w η G_a, w (η'/|γ|) b_a
  for (std::size_t a = 0; a < terms.size(); ++a) {
    for (std::size_t q = 0; q < row.size(); ++q) {
      const Pack viscous = batch.points[q].weight * states[q].viscosity;
      const Pack slope = factor * batch.points[q].weight * states[q].shear_rate_slope;
      for (std::size_t i = 0; i < Dim; ++i) {
        row[q].gradient[i] = viscous * terms[a][q].gradient[i];
        row[q].strain[i] = slope * terms[a][q].strain[i];
      }
    }
    for (std::size_t b = a; b < terms.size(); ++b) {
      PackTensor<Dim> block{};
      Pack diagonal = 0;
      for (std::size_t q = 0; q < row.size(); ++q) {
        const NodeTerms<Dim>& column = terms[b][q];
        Pack product = row[q].gradient[0] * column.gradient[0];
        for (std::size_t i = 1; i < Dim; ++i) product += row[q].gradient[i] * column.gradient[i];
        diagonal += product;
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j)
            block[i][j] +=
                row[q].gradient[j] * column.gradient[i] + row[q].strain[i] * column.strain[j];
      }
      for (std::size_t i = 0; i < Dim; ++i) {
        block[i][i] += diagonal;
        for (std::size_t j = 0; j < Dim; ++j)
          tangent.velocity_velocity[Dim * a + i][Dim * b + j] =
              tangent.velocity_velocity[Dim * b + j][Dim * a + i] = block[i][j];
      }
    }
  }
}

// What ½ (b_a c_b + c_a b_b) exceeds b_a b_b by: ½ (b_a d_b + d_a b_b), d = c - b.
template <int Dim>
void add_carried_blocks(const typename MixedSpace<Dim>::Batch& batch, const States<Dim>& states,
                        const CarriedStress<Dim>& carried_stress, const ElementTerms<Dim>& terms,
                        double factor, BatchTangent<Dim>& tangent) {
  constexpr std::size_t points = MixedSpace<Dim>::points_per_element;
  std::array<std::array<PackVector<Dim>, points>, MixedSpace<Dim>::nodes_per_element> excess;
  for (std::size_t q = 0; q < points; ++q) {
    const PackTensor<Dim> strain = excess_strain<Dim>(states[q], carried_stress[q]);
    const Pack slope = 0.5 * factor * batch.points[q].weight * states[q].shear_rate_slope;
    for (std::size_t a = 0; a < excess.size(); ++a)
      for (std::size_t i = 0; i < Dim; ++i) {
        excess[a][q][i] = 0;
        for (std::size_t j = 0; j < Dim; ++j)
          excess[a][q][i] += slope * strain[i][j] * terms[a][q].gradient[j];
      }
  }
  for (std::size_t a = 0; a < excess.size(); ++a)
    for (std::size_t b = a; b < excess.size(); ++b)
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j) {
          Pack sum = 0;
          for (std::size_t q = 0; q < points; ++q)
            sum +=
                terms[a][q].strain[i] * excess[b][q][j] + excess[a][q][i] * terms[b][q].strain[j];
          tangent.velocity_velocity[Dim * a + i][Dim * b + j] += sum;
          if (a != b) tangent.velocity_velocity[Dim * b + j][Dim * a + i] += sum;
        }
}

// ∂_j u_i meets N_a N_b and is computed once for both nodes; u·G_b differs.
template <int Dim>
void add_advective_blocks(const MixedSpace<Dim>& space,
                          const typename MixedSpace<Dim>::Batch& batch, const States<Dim>& states,
                          const ElementTerms<Dim>& terms, double factor,
                          BatchTangent<Dim>& tangent) {
  constexpr std::size_t points = MixedSpace<Dim>::points_per_element;
  const auto value = [&](std::size_t q, std::size_t a) {
    return space.bases()[q].values[static_cast<Eigen::Index>(a)];
  };
  std::array<std::array<Pack, points>, MixedSpace<Dim>::nodes_per_element> along;  // w u·G_a
  for (std::size_t a = 0; a < along.size(); ++a)
    for (std::size_t q = 0; q < points; ++q) {
      Pack sum = 0;
      for (std::size_t i = 0; i < Dim; ++i) sum += states[q].velocity[i] * terms[a][q].gradient[i];
      along[a][q] = factor * batch.points[q].weight * sum;
    }
  std::array<PackTensor<Dim>, points> row;  // w N_a grad u
  for (std::size_t a = 0; a < along.size(); ++a) {
    for (std::size_t q = 0; q < points; ++q) {
      const Pack weight = factor * value(q, a) * batch.points[q].weight;
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j) row[q][i][j] = weight * states[q].gradient[i][j];
    }
    for (std::size_t b = a; b < along.size(); ++b) {
      PackTensor<Dim> block{};
      Pack above = 0, below = 0;
      for (std::size_t q = 0; q < points; ++q) {
        above += value(q, a) * along[b][q];
        below += value(q, b) * along[a][q];
        for (std::size_t i = 0; i < Dim; ++i)
          for (std::size_t j = 0; j < Dim; ++j) block[i][j] += row[q][i][j] * value(q, b);
      }
      for (std::size_t i = 0; i < Dim; ++i)
        for (std::size_t j = 0; j < Dim; ++j) {
          tangent.velocity_velocity[Dim * a + i][Dim * b + j] +=
              i == j ? block[i][j] + above : block[i][j];
          if (a != b)
            tangent.velocity_velocity[Dim * b + i][Dim * a + j] +=
                i == j ? block[i][j] + below : block[i][j];
        }
    }
  }
}

}  // namespace

template <int Dim>
PackTensor<Dim> excess_strain(const PointState<Dim>& at, const PackTensor<Dim>& stress) {
  using std::experimental::max;
  using std::experimental::min;
  using std::experimental::sqrt;
  const PackTensor<Dim> gamma = rate_of_strain<Dim>(at.gradient);
  const Pack square = 0.5 * contract<Dim>(gamma, gamma);
  // Where p_regu = 0 there is no viscosity, and τ/η is 0/0. As p_regu → 0, |τ/η| <= |γ|(1 + x/2)
  // stays bounded while the slope it is multiplied by goes to 0: whatever τ is, its part in the
  // tangent vanishes. An excess of 0 says so.
  const auto has_viscosity = at.viscosity > 0;
  Pack viscosity = at.viscosity;
  where(!has_viscosity, viscosity) = 1;
  const Pack x = 1 + at.shear_rate_slope * square / viscosity;
  const Pack limit = at.viscosity * sqrt(square) * (1 + 0.5 * x);
  const Pack size =
      max(sqrt(0.5 * contract<Dim>(stress, stress)), Pack(std::numeric_limits<double>::min()));
  const Pack share = min(limit / size, Pack(1)) / viscosity;
  PackTensor<Dim> excess;
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j) {
      excess[i][j] = share * stress[i][j] - gamma[i][j];
      where(!has_viscosity, excess[i][j]) = 0;
    }
  return excess;
}

template <int Dim>
PackTensor<Dim> stress_change(const PointState<Dim>& at, const PackTensor<Dim>* carried_stress,
                              const PackTensor<Dim>& gradient_change, const Pack& pressure_change,
                              const TangentFactors& factors) {
  const PackTensor<Dim> gamma = rate_of_strain<Dim>(at.gradient);
  const Pack slope = factors.shear_rate * at.shear_rate_slope;
  const Pack by_strain = slope * contract<Dim>(gamma, gradient_change);
  Pack along_strain = by_strain + factors.pressure * at.pressure_slope * pressure_change;
  PackTensor<Dim> excess{};
  if (carried_stress) {
    excess = excess_strain<Dim>(at, *carried_stress);
    along_strain += 0.5 * slope * contract<Dim>(excess, gradient_change);
  }
  PackTensor<Dim> change;
  for (std::size_t i = 0; i < Dim; ++i)
    for (std::size_t j = 0; j < Dim; ++j)
      change[i][j] = at.viscosity * (gradient_change[i][j] + gradient_change[j][i]) +
                     along_strain * gamma[i][j] + 0.5 * by_strain * excess[i][j];
  return change;
}

template <int Dim>
void batch_tangent(const MixedSpace<Dim>& space, const typename MixedSpace<Dim>::Batch& batch,
                   const std::array<PointState<Dim>, MixedSpace<Dim>::points_per_element>& states,
                   const CarriedStress<Dim>* carried_stress, const Pack& penalty, double inertia,
                   const TangentFactors& factors, BatchTangent<Dim>& tangent) {
  ElementTerms<Dim> terms;
  fill(space, batch, states, terms);
  set_pressure_blocks(batch, states, terms, penalty, factors.pressure, tangent);
  set_viscous_blocks(batch, states, terms, factors.shear_rate, tangent);
  if (carried_stress)
    add_carried_blocks<Dim>(batch, states, *carried_stress, terms, factors.shear_rate, tangent);
  const double advection = inertia * factors.inertia;
  if (advection != 0) add_advective_blocks(space, batch, states, terms, advection, tangent);
}

template PackTensor<2> excess_strain<2>(const PointState<2>&, const PackTensor<2>&);
template PackTensor<2> stress_change<2>(const PointState<2>&, const PackTensor<2>*,
                                        const PackTensor<2>&, const Pack&, const TangentFactors&);
template void batch_tangent<2>(const MixedSpace<2>&, const MixedSpace<2>::Batch&,
                               const std::array<PointState<2>, 9>&, const CarriedStress<2>*,
                               const Pack&, double, const TangentFactors&, BatchTangent<2>&);
template PackTensor<3> excess_strain<3>(const PointState<3>&, const PackTensor<3>&);
template PackTensor<3> stress_change<3>(const PointState<3>&, const PackTensor<3>*,
                                        const PackTensor<3>&, const Pack&, const TangentFactors&);
template void batch_tangent<3>(const MixedSpace<3>&, const MixedSpace<3>::Batch&,
                               const std::array<PointState<3>, 27>&, const CarriedStress<3>*,
                               const Pack&, double, const TangentFactors&, BatchTangent<3>&);

}  // namespace talus::mixed
