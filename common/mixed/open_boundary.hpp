// The open boundary of velocity-pressure flow, eq. (8): the term -∫_Γ (ηγ - p 1) n·v of the weak
// form is kept, with the unknowns of the element inside. Few sides, so the loops are written
// plainly, one element at a time.
#pragma once

#include <functional>

#include "common/mixed/mixed_space.hpp"
#include "common/rheology/rheology.hpp"

namespace talus::mixed {

/// What one open side adds to its element: velocity i of local node a at Dim a + i, then pressures.
template <int Dim>
struct OpenSide {
  static constexpr int velocities = Dim * MixedSpace<Dim>::nodes_per_element;
  static constexpr int unknowns = velocities + MixedSpace<Dim>::pressures;
  Eigen::Matrix<double, velocities, 1> force = Eigen::Matrix<double, velocities, 1>::Zero();
  Eigen::Matrix<double, velocities, 1> magnitude = Eigen::Matrix<double, velocities, 1>::Zero();
  Eigen::Matrix<double, velocities, unknowns> tangent =
      Eigen::Matrix<double, velocities, unknowns>::Zero();
};

template <int Dim>
OpenSide<Dim> open_side(const MixedSpace<Dim>& space, const rheology::Rheology& rheology,
                        const std::function<double(const fem::Point<Dim>&)>& static_pressure,
                        const solve::CompensatedVector& state,
                        const typename MixedSpace<Dim>::OpenFace& face);

/// State indices of an element in the order of OpenSide.
template <int Dim>
std::array<Eigen::Index, OpenSide<Dim>::unknowns> element_unknowns(const MixedSpace<Dim>& space,
                                                                   std::size_t element);

}  // namespace talus::mixed
