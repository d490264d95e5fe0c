#include "common/flow/dense_kernels.hpp"

namespace talus::flow {
namespace {

// What the columns of the tangent need at one quadrature point.
template <int Dim>
struct ColumnTerms {
  PackVector<Dim> gradient;  // G_b
  PackVector<Dim> strain;    // b_b = γ·G_b
  PackVector<Dim> carried;   // c_b = (τ/η)·G_b
  Pack advection;            // u·G_b
};

}  // namespace

template <int Dim>
void batch_tangent(const DenseSpace<Dim>& space, const typename DenseSpace<Dim>::Batch& batch,
                   const std::array<PointState<Dim>, DenseSpace<Dim>::points_per_element>& states,
                   const Pack& penalty, double inertia, const TangentFactors& factors,
                   BatchTangent<Dim>& tangent) {
  constexpr std::size_t nodes = DenseSpace<Dim>::nodes_per_element;
  constexpr std::size_t points = DenseSpace<Dim>::points_per_element;
  constexpr std::size_t pressures = DenseSpace<Dim>::pressures;
  const auto& bases = space.bases();
  const auto value = [&](std::size_t q, std::size_t a) {
    return bases[q].values[static_cast<Eigen::Index>(a)];
  };
  const double advection = inertia * factors.inertia;

  std::array<std::array<ColumnTerms<Dim>, points>, nodes> columns;
  tangent.pressure_pressure = {};
  for (std::size_t q = 0; q < points; ++q) {
    const auto& point = batch.points[q];
    PackGradients<Dim> gradients;
    physical_gradients<Dim>(point, bases[q], gradients);
    const PackTensor<Dim> gamma = rate_of_strain<Dim>(states[q].gradient);
    for (std::size_t b = 0; b < nodes; ++b) {
      ColumnTerms<Dim>& column = columns[b][q];
      column.gradient = gradients[b];
      column.advection = 0;
      for (std::size_t i = 0; i < Dim; ++i) {
        column.strain[i] = column.carried[i] = 0;
        for (std::size_t j = 0; j < Dim; ++j) {
          column.strain[i] += gamma[i][j] * gradients[b][j];
          column.carried[i] += states[q].carried[i][j] * gradients[b][j];
        }
        column.advection += states[q].velocity[i] * gradients[b][i];
      }
    }
    std::array<Pack, pressures> psi;
    psi[0] = 1;
    for (std::size_t k = 0; k < Dim; ++k) psi[k + 1] = point.pressure_basis[k];
    for (std::size_t k = 0; k < pressures; ++k)
      for (std::size_t l = 0; l < pressures; ++l)
        tangent.pressure_pressure[k][l] -= penalty * point.weight * psi[k] * psi[l];
  }

  struct RowTerms {
    PackVector<Dim> viscous, slope;  // w η G_a, w (η'/|γ|) c_a
    Pack inertia;                    // w N_a
    PackTensor<Dim> shear;           // w N_a grad u
  };
  std::array<RowTerms, points> rows;
  for (std::size_t a = 0; a < nodes; ++a) {
    std::array<std::array<Pack, pressures>, Dim> to_pressure{}, from_pressure{};
    for (std::size_t q = 0; q < points; ++q) {
      const auto& point = batch.points[q];
      const ColumnTerms<Dim>& own = columns[a][q];
      RowTerms& row = rows[q];
      const Pack viscous = point.weight * states[q].viscosity;
      const Pack slope = factors.shear_rate * point.weight * states[q].shear_rate_slope;
      row.inertia = advection * value(q, a) * point.weight;
      for (std::size_t i = 0; i < Dim; ++i) {
        row.viscous[i] = viscous * own.gradient[i];
        row.slope[i] = slope * own.carried[i];
        for (std::size_t j = 0; j < Dim; ++j)
          row.shear[i][j] = row.inertia * states[q].gradient[i][j];
        const Pack divergence = point.weight * own.gradient[i];
        const Pack stress =
            factors.pressure * point.weight * states[q].pressure_slope * own.carried[i];
        for (std::size_t k = 0; k < pressures; ++k) {
          const Pack psi = k == 0 ? Pack(1) : point.pressure_basis[k - 1];
          to_pressure[i][k] += psi * (stress - divergence);
          from_pressure[i][k] -= psi * divergence;
        }
      }
    }
    for (std::size_t i = 0; i < Dim; ++i)
      for (std::size_t k = 0; k < pressures; ++k) {
        tangent.velocity_pressure[Dim * a + i][k] = to_pressure[i][k];
        tangent.pressure_velocity[k][Dim * a + i] = from_pressure[i][k];
      }
    for (std::size_t b = 0; b < nodes; ++b) {
      PackTensor<Dim> block{};
      Pack diagonal = 0;
      for (std::size_t q = 0; q < points; ++q) {
        const RowTerms& row = rows[q];
        const ColumnTerms<Dim>& column = columns[b][q];
        for (std::size_t i = 0; i < Dim; ++i) {
          diagonal += row.viscous[i] * column.gradient[i];
          for (std::size_t j = 0; j < Dim; ++j)
            block[i][j] += row.viscous[j] * column.gradient[i] + row.slope[i] * column.strain[j];
        }
      }
      if (advection != 0)
        for (std::size_t q = 0; q < points; ++q) {
          diagonal += rows[q].inertia * columns[b][q].advection;
          for (std::size_t i = 0; i < Dim; ++i)
            for (std::size_t j = 0; j < Dim; ++j) block[i][j] += rows[q].shear[i][j] * value(q, b);
        }
      for (std::size_t i = 0; i < Dim; ++i) {
        block[i][i] += diagonal;
        for (std::size_t j = 0; j < Dim; ++j)
          tangent.velocity_velocity[Dim * a + i][Dim * b + j] = block[i][j];
      }
    }
  }
}

template void batch_tangent(const DenseSpace<2>&, const DenseSpace<2>::Batch&,
                            const std::array<PointState<2>, 9>&, const Pack&, double,
                            const TangentFactors&, BatchTangent<2>&);
template void batch_tangent(const DenseSpace<3>&, const DenseSpace<3>::Batch&,
                            const std::array<PointState<3>, 27>&, const Pack&, double,
                            const TangentFactors&, BatchTangent<3>&);

}  // namespace talus::flow
