// Unidirectional flow without regularisation: a primal-dual interior-point method.
//
//   minimise Σ w D(t; p) - f·u   subject to |grad u| <= t at every quadrature point
//
// is a second-order cone programme. Its dual is a stress τ in equilibrium, Σ w Gᵀτ = f, with
// |τ| <= z = D'(t); at the optimum (t, g) ∘ (z, -τ) = 0, that is t z = g·τ and t τ = z g. Newton
// follows (t, g) ∘ (z, -τ) = (σμs, 0) as μ → 0 with Mehrotra's predictor and second-order
// corrector; s = μs p c, the natural power of the point, makes all points equally accurate as p → 0
// at a free surface (with s = 1 the surface velocity is the last thing to converge). The duality
// gap Σ w (t z - g·τ) bounds the distance to the discrete minimum: no λr anywhere. Related: Bleyer
// et al. (2015), yield-stress flows as second-order cone programmes.
#pragma once

#include <functional>
#include <vector>

#include "common/flow/cross_section.hpp"
#include "common/rheology/rheology.hpp"
#include "common/solve/end.hpp"

namespace talus::flow {

/// Weights s of the central path. `natural` is as accurate under a free surface as elsewhere;
/// `uniform` takes fewer, safer steps where the shape of the plug is not known (two dimensions).
enum class CentralPath { natural, uniform };

struct InteriorPointOptions {
  double tolerance = 1e-10;      ///< on the duality gap and on equilibrium, both relative
  int max_factorisations = 100;  ///< one factorisation an iteration
  double step_to_boundary = 0.95;
  CentralPath path = CentralPath::natural;
};

struct InteriorPointIteration {
  double relative_gap = 0;  ///< duality gap over the power of the load, before the step
  double round_off = 0;     ///< of the relative gap: ε Σ w (t z + |g·τ|) over the same power
  double equilibrium = 0;   ///< max|f - Σ w Gᵀτ| over max|f|, before the step
  double centring = 0;      ///< σ
  double step = 0;          ///< common step of all variables
};

struct InteriorPointSummary {
  solve::End end = solve::End::stagnated;
  bool at_rest = false;  ///< certified: a stress in equilibrium stays within the yield stress
  std::vector<InteriorPointIteration> history;  ///< one record for the start, one a factorisation
  InteriorPointIteration last_good;             ///< record of the state returned

  int factorisations() const { return static_cast<int>(history.size()) - 1; }
  double relative_gap() const { return last_good.relative_gap; }
};

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
class InteriorPoint {
 public:
  using Space = CrossSection<Dim>;
  using Vector = typename Space::Vector;

  /// `space` must outlive the problem; pressure must be positive at the quadrature points.
  InteriorPoint(Space& space, rheology::FrictionLaw law,
                const std::function<double(const Vector&)>& pressure,
                const std::function<double(const Vector&)>& body_force);

  /// Strictly inside both cones: no motion, no stress, t the natural shear rate.
  ConeState<Dim> start() const;
  /// Follows the central path from `state`. Where round-off stops it, `state` is the last good
  /// iterate, and the end is at_round_off_floor only if the computed round-off of the gap says so.
  InteriorPointSummary solve(ConeState<Dim>& state, const InteriorPointOptions& options = {});

  // The pieces, public for the Jacobian check and for students.
  ConeResidual<Dim> residual(const ConeState<Dim>& state) const;
  /// Change of the residual to first order in `step`.
  ConeResidual<Dim> linearised(const ConeState<Dim>& state, const ConeStep<Dim>& step) const;
  /// Eliminates dt, dz and dτ about `state`, assembles and condenses the system for the velocity.
  void assemble(const ConeState<Dim>& state);
  /// The step that takes the linearised residual, about the state last assembled, from `residual`
  /// to zero; false if the system is singular.
  bool newton_step(const ConeResidual<Dim>& residual, ConeStep<Dim>& step) const;
  ConeState<Dim> moved(const ConeState<Dim>& state, double length, const ConeStep<Dim>& step) const;

 private:
  // What is left of one quadrature point when dt, dz and dτ are eliminated.
  struct Eliminated {
    double t, slope, pivot;  // slope = D''(t), pivot = K
    Vector gradient, stress, alpha;
    typename Space::Tangent tangent;  // A
  };

  Eliminated eliminate(const ConeState<Dim>& state, std::size_t point) const;
  double integral(const std::vector<double>& values) const;
  InteriorPointIteration measure(const ConeState<Dim>& state, const ConeResidual<Dim>& r) const;
  /// Predictor, corrector and step; false if the system is singular.
  bool advance(ConeState<Dim>& state, ConeResidual<Dim>& r, InteriorPointIteration& record,
               const InteriorPointOptions& options);
  double predicted_gap(const ConeState<Dim>& state, double length, const ConeStep<Dim>& step) const;

  Space& space_;
  rheology::FrictionLaw law_;
  std::vector<double> pressure_;
  Eigen::VectorXd load_;
  std::vector<double> point_power_;  // μs p c
  double natural_power_ = 0;         // Σ w μs p c: scale of the gap where nothing moves
  std::vector<Eliminated> eliminated_;
};

extern template class InteriorPoint<1>;
extern template class InteriorPoint<2>;

}  // namespace talus::flow
