// Regularised unidirectional flow as a problem for Newton.
//
// Find w minimising ∫ D(|grad w|, p) - f w, D = ∫₀^|γ| η s ds: a convex energy whose gradient is
// the residual R = ∫ η grad w · grad v - ∫ f v. Pressure is known, so it only enters as data. On a
// wall with friction the slip stands for the gradient, with the law of shear::wall_law.
#pragma once

#include <functional>
#include <vector>

#include "common/rheology/rheology.hpp"
#include "common/shear/cross_section.hpp"
#include "common/solve/carried_stress.hpp"
#include "common/solve/newton.hpp"

namespace talus::shear {

/// The term η'(|γ|) of the tangent: in its primal-dual form, as it is, dropped (frozen viscosity:
/// Picard), or with the wrong sign. The last two exist to be looked at.
///
/// Primal-dual: the stress τ that the state carries (solve::WithStress), eliminated, leaves the
/// usual residual and the tangent η 1 + η'/|g| sym(g ⊗ τ/η); without one yet, the full tangent.
enum class TangentTerm { primal_dual, full, frozen, wrong_sign };

template <int Dim>
class ShearFlow {
 public:
  using Space = CrossSection<Dim>;
  using Vector = typename Space::Vector;
  using Stress = std::vector<Vector>;  ///< at the quadrature points
  using State = solve::WithStress<Stress>;

  /// `space` must outlive the problem; body force in units of φρg.
  ShearFlow(Space& space, rheology::Rheology rheology,
            const std::function<double(const Vector&)>& total_pressure,
            const std::function<double(const Vector&)>& body_force);

  const rheology::Rheology& rheology() const { return rheology_; }
  void set_lambda_r(double lambda_r);
  void set_tangent_term(TangentTerm term) { tangent_term_ = term; }
  /// Multiplies η' in the tangent: 1 is right; the others exist to show that checks find them.
  void set_slope_factor(double factor) { slope_factor_ = factor; }
  /// The stress of these gradients at the quadrature points.
  Stress stress_of(const Stress& gradients) const;
  const Eigen::VectorXd& load() const { return load_; }

  /// Residual, its magnitude and its computed round-off at every node; keeps the point tangents.
  const solve::Residual& evaluate(const State& w);
  /// Solves K x = right_hand_side, K the tangent at the state last evaluated. The direction carries
  /// a stress if the tangent is primal-dual.
  bool linear_solve(const Eigen::VectorXd& right_hand_side, State& x);
  /// Certificate that the discrete problem has no solution: shear::recession(w) < 0.
  bool exceeds_capacity(const State& w) const;
  /// K x, uncondensed: what the Jacobian check compares with differences of the residual.
  Eigen::VectorXd tangent_product(const solve::CompensatedVector& x) const {
    return space_.product(tangents_, x);
  }
  /// η grad w at every quadrature point, at the state last evaluated.
  const Stress& stress() const { return stress_; }

 private:
  template <class Regularisation>
  void evaluate_with(const Regularisation& regularisation, const State& w);
  template <class Regularisation>
  rheology::Viscosity viscosity(const Regularisation& regularisation, double shear_rate,
                                std::size_t point) const;
  typename Space::Tangent tangent(const rheology::Viscosity& v, const Vector& g,
                                  const Vector* carried) const;

  Space& space_;
  rheology::Rheology rheology_, wall_;
  TangentTerm tangent_term_ = TangentTerm::full;
  double slope_factor_ = 1;
  std::vector<double> total_pressure_;
  std::vector<rheology::RegularisedPressure> regularised_pressure_;
  Eigen::VectorXd load_;
  std::vector<typename Space::Tangent> tangents_;
  Stress stress_;
  solve::Residual residual_;
};

extern template class ShearFlow<1>;
extern template class ShearFlow<2>;

}  // namespace talus::shear
