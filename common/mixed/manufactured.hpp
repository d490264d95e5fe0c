// Manufactured flows: smooth divergence-free velocities and positive pressures with the body force
// that makes them solutions, whatever the law. Derivatives come from automatic differentiation.
#pragma once

#include <string>
#include <vector>

#include "common/mixed/mixed_flow.hpp"

namespace talus::mixed {

/// Velocity and pressure with their derivatives at a point.
template <int Dim>
struct FlowDerivatives {
  fem::Point<Dim> velocity, pressure_gradient;
  Eigen::Matrix<double, Dim, Dim> gradient;                  ///< (i, j) = ∂_j u_i
  std::array<Eigen::Matrix<double, Dim, Dim>, Dim> hessian;  ///< [i](j, k) = ∂_j ∂_k u_i
  double pressure = 0;
};

template <int Dim>
struct ManufacturedFlow {
  std::string name;
  double lambda_r = 0;  ///< with which its viscosity is smooth on the scale of a coarse mesh
  std::function<FlowDerivatives<Dim>(const fem::Point<Dim>&)> at;

  /// f = (u·grad) u + grad p - div(ηγ), eq. (3), with p the total pressure.
  fem::Point<Dim> body_force(const fem::Point<Dim>& position, const rheology::Rheology& rheology,
                             double inertia) const;
  /// What makes it a solution of MixedFlow; no static pressure. The flow must outlive the load.
  MixedLoad<Dim> load(const rheology::Rheology& rheology, double inertia) const;
  /// Its traction (ηγ - p 1) n.
  fem::Point<Dim> traction(const fem::Point<Dim>& position, const fem::Point<Dim>& normal,
                           const rheology::Rheology& rheology) const;
};

/// The registry: one with |γ| far from zero and a tiny λr, one with little shear inside.
template <int Dim>
const std::vector<ManufacturedFlow<Dim>>& manufactured_flows();

/// The exact velocity at the nodes and pressure in the middle of the elements: a start for Newton.
template <int Dim>
typename MixedSpace<Dim>::State interpolate(const ManufacturedFlow<Dim>& exact,
                                            const MixedSpace<Dim>& space);

/// Errors of a discrete flow in the norms its orders are known in: 3, 2 and 2.
struct FlowErrors {
  double velocity = 0;    ///< ‖u - u_h‖ in L2
  double gradient = 0;    ///< ‖grad(u - u_h)‖ in L2
  double pressure = 0;    ///< ‖p - p_h‖ in L2
  double divergence = 0;  ///< ‖div u_h‖ in L2
};
template <int Dim>
FlowErrors errors_against(const ManufacturedFlow<Dim>& exact, const MixedSpace<Dim>& space,
                          const solve::CompensatedVector& state);

}  // namespace talus::mixed
