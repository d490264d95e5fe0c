// The optimality system of unidirectional flow without regularisation, and its Newton step.
//
// Unknowns (velocity; t, z and τ at the quadrature points), rows (equilibrium; law, product and
// alignment); dt, dz and dτ are eliminated point by point. See interior_point.hpp for the problem.
#pragma once

#include <functional>
#include <vector>

#include "common/rheology/friction_law.hpp"
#include "common/shear/cross_section.hpp"

namespace talus::shear {

/// Fields at the quadrature points: t >= |grad u|, its dual z >= |τ|, and the stress τ.
template <int Dim>
struct ConeState {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  solve::CompensatedVector velocity;
  std::vector<Vector> gradient;    ///< g = grad u
  std::vector<double> bound;       ///< t
  std::vector<double> dual_bound;  ///< z
  std::vector<Vector> stress;      ///< τ
};

/// An increment of a ConeState, with the gradient of its velocity part.
template <int Dim>
struct ConeStep {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  solve::CompensatedVector velocity;
  std::vector<Vector> gradient;
  std::vector<double> bound, dual_bound;
  std::vector<Vector> stress;
};

/// Residuals of the optimality system: equilibrium (nodes); z = D'(t) and both parts of the cone
/// product (quadrature points).
template <int Dim>
struct ConeResidual {
  Eigen::VectorXd equilibrium;                           ///< f - Σ w Gᵀτ
  std::vector<double> law;                               ///< D'(t) - z
  std::vector<double> product;                           ///< t z - g·τ
  std::vector<Eigen::Matrix<double, Dim, 1>> alignment;  ///< z g - t τ
};

template <int Dim>
class InteriorPointSystem {
 public:
  using Space = CrossSection<Dim>;
  using Vector = typename Space::Vector;

  /// `space` must outlive the problem; pressure must be positive at the quadrature points.
  InteriorPointSystem(Space& space, rheology::FrictionLaw law,
                      const std::function<double(const Vector&)>& pressure,
                      const std::function<double(const Vector&)>& body_force);

  /// Strictly inside both cones: no motion, no stress, t the natural shear rate.
  ConeState<Dim> start() const;
  /// About a velocity whose fixed values drive the flow: τ along its gradient, equally central at
  /// every point.
  ConeState<Dim> start(const solve::CompensatedVector& velocity) const;
  ConeResidual<Dim> residual(const ConeState<Dim>& state) const;
  /// Change of the residual to first order in `step`.
  ConeResidual<Dim> linearised(const ConeState<Dim>& state, const ConeStep<Dim>& step) const;
  /// Eliminates dt, dz and dτ about `state`, assembles and condenses the system for the velocity.
  void assemble(const ConeState<Dim>& state);
  /// The step that takes the linearised residual, about the state last assembled, from `residual`
  /// to zero; false if the system is singular.
  bool newton_step(const ConeResidual<Dim>& residual, ConeStep<Dim>& step) const;
  ConeState<Dim> moved(const ConeState<Dim>& state, double length, const ConeStep<Dim>& step) const;

 protected:
  /// Of the material, or of its slip along a wall.
  const rheology::FrictionLaw& law_at(std::size_t point) const {
    return space_.points()[point].on_wall ? wall_law_ : law_;
  }

  Space& space_;
  rheology::FrictionLaw law_, wall_law_;
  std::vector<double> pressure_;
  Eigen::VectorXd load_;

 private:
  // What is left of one quadrature point when dt, dz and dτ are eliminated.
  struct Eliminated {
    double t, slope, pivot;  // slope = D''(t), pivot = K
    Vector gradient, stress, alpha;
    typename Space::Tangent tangent;  // A
  };
  Eliminated eliminate(const ConeState<Dim>& state, std::size_t point) const;

  std::vector<Eliminated> eliminated_;
};

extern template class InteriorPointSystem<1>;
extern template class InteriorPointSystem<2>;

}  // namespace talus::shear
