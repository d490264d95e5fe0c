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

#include "common/shear/interior_point_system.hpp"
#include "common/solve/end.hpp"

namespace talus::shear {

/// Weights s of the central path. `natural` is as accurate under a free surface as elsewhere;
/// `uniform` takes fewer, safer steps where the shape of the plug is not known (two dimensions).
enum class CentralPath { natural, uniform };

struct InteriorPointOptions {
  double tolerance = 1e-10;      ///< on the duality gap, relative; the velocity's is its root
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

template <int Dim>
class InteriorPoint : public InteriorPointSystem<Dim> {
 public:
  using System = InteriorPointSystem<Dim>;
  using typename System::Space;
  using typename System::Vector;

  /// `space` must outlive the problem; pressure must be positive at the quadrature points.
  InteriorPoint(Space& space, rheology::FrictionLaw law,
                const std::function<double(const Vector&)>& pressure,
                const std::function<double(const Vector&)>& body_force);

  /// Follows the central path from `state`. Where round-off stops it, `state` is the last good
  /// iterate, and the end is at_round_off_floor only if the computed round-off of the gap says so.
  InteriorPointSummary solve(ConeState<Dim>& state, const InteriorPointOptions& options = {});

 private:
  using System::law_, System::law_at, System::load_, System::pressure_, System::space_;

  double integral(const std::vector<double>& values) const;
  InteriorPointIteration measure(const ConeState<Dim>& state, const ConeResidual<Dim>& r) const;
  /// Predictor, corrector and step; false if the system is singular.
  bool advance(ConeState<Dim>& state, ConeResidual<Dim>& r, InteriorPointIteration& record,
               const InteriorPointOptions& options);
  double predicted_gap(const ConeState<Dim>& state, double length, const ConeStep<Dim>& step) const;

  std::vector<double> point_power_;  // μs p c
  double natural_power_ = 0;         // Σ w μs p c: scale of the gap where nothing moves
};

extern template class InteriorPoint<1>;
extern template class InteriorPoint<2>;

}  // namespace talus::shear
