// The open boundary of velocity-pressure flow, eq. (8): the term -∫_Γ (ηγ - p 1) n·v of the weak
// form is kept, with the unknowns of the element inside. Few sides, so the loops are written
// plainly, one element at a time.
#pragma once

#include <functional>

#include "common/flow/dense_space.hpp"
#include "common/rheology/rheology.hpp"

namespace talus::flow {

/// What one open side adds to its element: velocity i of local node a at Dim a + i, then pressures.
template <int Dim>
struct OpenSide {
  static constexpr int velocities = Dim * DenseSpace<Dim>::nodes_per_element;
  static constexpr int unknowns = velocities + DenseSpace<Dim>::pressures;
  Eigen::Matrix<double, velocities, 1> force = Eigen::Matrix<double, velocities, 1>::Zero();
  Eigen::Matrix<double, velocities, 1> magnitude = Eigen::Matrix<double, velocities, 1>::Zero();
  Eigen::Matrix<double, velocities, unknowns> tangent =
      Eigen::Matrix<double, velocities, unknowns>::Zero();
};

template <int Dim>
OpenSide<Dim> open_side(const DenseSpace<Dim>& space, const rheology::Rheology& rheology,
                        const std::function<double(const Point<Dim>&)>& static_pressure,
                        const solve::CompensatedVector& state,
                        const typename DenseSpace<Dim>::OpenFace& face);

/// State indices of an element in the order of OpenSide.
template <int Dim>
std::array<Eigen::Index, OpenSide<Dim>::unknowns> element_unknowns(const DenseSpace<Dim>& space,
                                                                   std::size_t element);

}  // namespace talus::flow
