// Boundary conditions of velocity-pressure flow, by the name of the boundary.
//
// Where boundaries meet, a node has the conditions of all of them, component by component: those
// that agree are one; of those that do not the one of higher precedence holds, such as a velocity
// that is given by position over the zero of a wall; a contradiction of equals is refused. Names
// decide nothing.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Core>

namespace talus::mixed {

/// An open boundary takes its traction from the flow inside, eq. (8): all of it, or only the
/// viscous part, with no dynamic pressure outside. The first leaves the level of the pressure open
/// as well: a column in a channel then simply rests on its outlet.
enum class Open { no, viscous, all };

/// What holds on one boundary. Velocity components are prescribed or carry a traction of the
/// dynamic stress ηγ - p_dyn 1 (in φρgL, zero if nothing is said).
template <int Dim>
struct BoundaryCondition {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  std::array<bool, Dim> fixed{};
  std::function<Vector(const Vector& position)> velocity = {};  ///< of fixed components; or zero
  std::function<Vector(const Vector& position, const Vector& normal)> traction = {};
  Open open = Open::no;
  int precedence = 0;  ///< where another boundary prescribes another velocity
};

template <int Dim>
using BoundaryConditions = std::map<std::string, BoundaryCondition<Dim>>;

/// A velocity by position; it goes before the zeros of other conditions.
template <int Dim>
BoundaryCondition<Dim> prescribed_velocity(
    std::function<Eigen::Matrix<double, Dim, 1>(const Eigen::Matrix<double, Dim, 1>&)> velocity,
    int precedence = 1) {
  BoundaryCondition<Dim> condition;
  condition.precedence = precedence;
  condition.fixed.fill(true);
  condition.velocity = std::move(velocity);
  return condition;
}

template <int Dim>
BoundaryCondition<Dim> no_slip() {
  BoundaryCondition<Dim> condition;
  condition.fixed.fill(true);
  return condition;
}

/// No flow through a plane normal to `axis`, no friction along it.
template <int Dim>
BoundaryCondition<Dim> symmetry(std::size_t axis) {
  BoundaryCondition<Dim> condition;
  condition.fixed[axis] = true;
  return condition;
}

/// In- or outflow through a plane normal to `axis`: velocity along it, no dynamic normal traction.
template <int Dim>
BoundaryCondition<Dim> fully_developed(std::size_t axis) {
  BoundaryCondition<Dim> condition;
  condition.fixed.fill(true);
  condition.fixed[axis] = false;
  return condition;
}

template <int Dim>
BoundaryCondition<Dim> prescribed_traction(
    std::function<Eigen::Matrix<double, Dim, 1>(const Eigen::Matrix<double, Dim, 1>& position,
                                                const Eigen::Matrix<double, Dim, 1>& normal)>
        traction) {
  BoundaryCondition<Dim> condition;
  condition.traction = std::move(traction);
  return condition;
}

/// The paper's outflow: the boundary term of the weak form stays, with the unknowns in it.
template <int Dim>
BoundaryCondition<Dim> open_boundary(Open kind = Open::all) {
  BoundaryCondition<Dim> condition;
  condition.open = kind;
  return condition;
}

}  // namespace talus::mixed
