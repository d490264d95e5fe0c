#include "common/mixed/open_boundary.hpp"

namespace talus::mixed {

template <int Dim>
OpenSide<Dim> open_side(const MixedSpace<Dim>& space, const rheology::Rheology& rheology,
                        const std::function<double(const fem::Point<Dim>&)>& static_pressure,
                        const solve::CompensatedVector& state,
                        const typename MixedSpace<Dim>::OpenFace& face) {
  using Tensor = Eigen::Matrix<double, Dim, Dim>;
  OpenSide<Dim> side;
  for (const auto& point : fem::face_rule(space.mesh(), face)) {
    const fem::ElementPoint<Dim> at(space.mesh(), face.element, point.reference);
    const auto values = space.values_at(state, face.element, point.reference);
    const auto psi = space.pressure_basis(face.element, point.reference, at.position);
    const Tensor gamma = values.velocity_gradient + values.velocity_gradient.transpose();
    const double shear_rate = values.shear_rate();
    const rheology::Viscosity v =
        rheology.evaluate(shear_rate, values.pressure + static_pressure(at.position));
    const double slope = shear_rate > 0 ? v.d_eta_d_shear_rate / shear_rate : 0;
    const fem::Point<Dim> drag = gamma * point.normal;
    const double pressure = face.keeps_pressure ? values.pressure : 0;
    const fem::Point<Dim> traction = v.eta * drag - pressure * point.normal;
    for (int a = 0; a < MixedSpace<Dim>::nodes_per_element; ++a) {
      const double weight = point.weight * at.values[a];
      if (weight == 0) continue;  // not a node of this side
      side.force.template segment<Dim>(Dim * a) -= weight * traction;
      side.magnitude.template segment<Dim>(Dim * a) +=
          std::abs(weight) *
          (v.eta * drag.cwiseAbs() + std::abs(pressure) * point.normal.cwiseAbs());
      for (int b = 0; b < MixedSpace<Dim>::nodes_per_element; ++b) {
        const fem::Point<Dim> gradient = at.gradients.col(b);
        // η (grad δu + grad δuᵀ) n + δη γ n, by components of δu_b.
        const Tensor viscous = v.eta * (gradient.dot(point.normal) * Tensor::Identity() +
                                        gradient * point.normal.transpose()) +
                               slope * drag * (gamma * gradient).transpose();
        side.tangent.template block<Dim, Dim>(Dim * a, Dim * b) -= weight * viscous;
      }
      for (int k = 0; k < MixedSpace<Dim>::pressures; ++k)
        side.tangent.template block<Dim, 1>(Dim * a, OpenSide<Dim>::velocities + k) -=
            weight * psi[k] *
            (v.d_eta_d_pressure * drag - (face.keeps_pressure ? 1.0 : 0.0) * point.normal);
    }
  }
  return side;
}

template <int Dim>
std::array<Eigen::Index, OpenSide<Dim>::unknowns> element_unknowns(const MixedSpace<Dim>& space,
                                                                   std::size_t element) {
  std::array<Eigen::Index, OpenSide<Dim>::unknowns> unknowns;
  for (std::size_t v = 0; v < OpenSide<Dim>::velocities; ++v)
    unknowns[v] =
        space.velocity_index(space.mesh().elements[element][v / Dim], static_cast<int>(v % Dim));
  for (int k = 0; k < MixedSpace<Dim>::pressures; ++k)
    unknowns[OpenSide<Dim>::velocities + static_cast<std::size_t>(k)] =
        space.pressure_index(element, k);
  return unknowns;
}

template struct OpenSide<2>;
template struct OpenSide<3>;
template OpenSide<2> open_side(const MixedSpace<2>&, const rheology::Rheology&,
                               const std::function<double(const fem::Point<2>&)>&,
                               const solve::CompensatedVector&, const MixedSpace<2>::OpenFace&);
template OpenSide<3> open_side(const MixedSpace<3>&, const rheology::Rheology&,
                               const std::function<double(const fem::Point<3>&)>&,
                               const solve::CompensatedVector&, const MixedSpace<3>::OpenFace&);
template std::array<Eigen::Index, OpenSide<2>::unknowns> element_unknowns(const MixedSpace<2>&,
                                                                          std::size_t);
template std::array<Eigen::Index, OpenSide<3>::unknowns> element_unknowns(const MixedSpace<3>&,
                                                                          std::size_t);

}  // namespace talus::mixed
