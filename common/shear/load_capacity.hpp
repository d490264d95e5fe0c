// Certificates of what a load does to the material on a mesh: rest, or more than it can carry.
#pragma once

#include <span>

#include "common/rheology/friction_law.hpp"
#include "common/shear/cross_section.hpp"

namespace talus::shear {

/// Σ w μ2 p|grad u| - f·u: the rate at which the energy grows along u, to infinity. Negative for
/// some u: the energy falls without bound, and the discrete problem has no solution. `pressure` at
/// the quadrature points, `load` at the nodes.
template <int Dim>
double recession(const CrossSection<Dim>& space, const rheology::FrictionLaw& law,
                 std::span<const double> pressure, const Eigen::VectorXd& load,
                 const solve::CompensatedVector& u) {
  std::vector<typename CrossSection<Dim>::Vector> g;
  space.gradients(u, g);
  double sum = -load.dot(u.value());
  for (std::size_t k = 0; k < g.size(); ++k)
    sum += space.points()[k].weight * law.mu_2() * pressure[k] * g[k].norm();
  return sum;
}

/// Whether |τ| <= μs p at every quadrature point, <= μ2 p on a wall; with τ in equilibrium, a
/// certificate of rest.
template <int Dim>
bool is_within_yield(const CrossSection<Dim>& space, const rheology::FrictionLaw& law,
                     std::span<const double> pressure,
                     std::span<const Eigen::Matrix<double, Dim, 1>> stress) {
  for (std::size_t k = 0; k < pressure.size(); ++k)
    if (stress[k].norm() > (space.points()[k].on_wall ? law.mu_2() : law.mu_s) * pressure[k])
      return false;
  return true;
}

}  // namespace talus::shear
