// Steady dense granular flow in velocity and pressure as a problem for Newton.
//
//   R_u = ∫ η γ : grad v - p div v + (u·grad u)·v - f·v - ∫_Γ t·v,   R_q = -∫ q (div u + λp p),
// eq. (3), (8) and (9)-(12) with η(|γ|, p_regu(p_static + p)). The sign of the penalty is the one
// that makes the operator definite; eq. (8) prints the other. By default the penalty is iterated:
// it regularises the tangent only, the residual holds div u itself.
#pragma once

#include <functional>
#include <vector>

#include "common/flow/dense_kernels.hpp"
#include "common/flow/open_boundary.hpp"
#include "common/rheology/rheology.hpp"
#include "common/solve/newton.hpp"

namespace talus::flow {

enum class Penalty { iterated, plain };

/// What drives the flow, by position; stresses in φρgL.
template <int Dim>
struct DenseLoad {
  std::function<double(const Point<Dim>&)> static_pressure;  ///< p_total = p_static + p
  std::function<Point<Dim>(const Point<Dim>&)> body_force;   ///< what p_static does not balance
  double inertia = 1;  ///< factor of the advective term; 0 leaves it out
};

/// λp of a plain penalty is that of eq. (8), a compliance. An iterated one only conditions the
/// linear solves; its λp is divided by the viscosity of each element, so that one value serves a
/// plug and a thin shear layer alike.
struct PenaltyOptions {
  Penalty kind = Penalty::iterated;
  double lambda_p = 1e-4;
};

template <int Dim>
class DenseFlow {
 public:
  using Space = DenseSpace<Dim>;
  using State = solve::CompensatedVector;

  /// `space` must outlive the problem.
  DenseFlow(const Space& space, rheology::Rheology rheology, const DenseLoad<Dim>& load,
            PenaltyOptions penalty = {});

  const Space& space() const { return space_; }
  const rheology::Rheology& rheology() const { return rheology_; }
  void set_rheology(const rheology::Rheology& rheology) { rheology_ = rheology; }
  void set_lambda_r(double lambda_r) { rheology_.lambda_r = lambda_r; }
  /// The body force is multiplied by this factor; 1 at first.
  double load_factor() const { return load_factor_; }
  void set_load_factor(double factor) { load_factor_ = factor; }
  void set_tangent_factors(const TangentFactors& factors) { factors_ = factors; }

  /// Residual with its magnitude and computed round-off; keeps what the tangent needs.
  const solve::Residual& evaluate(const State& state);
  /// Solves J x = right_hand_side about the state last evaluated, refined with the uncondensed
  /// matrix. The factors are kept until the next evaluation.
  bool linear_solve(const Eigen::VectorXd& right_hand_side, State& x);
  /// J x, uncondensed; zero at fixed velocities.
  Eigen::VectorXd tangent_product(const State& x) const;
  /// dR/d(load factor) and, by a central difference, dR/d(ln λr) at a state; the tangent stays.
  Eigen::VectorXd load_derivative() const;
  Eigen::VectorXd log_lambda_r_derivative(const State& state) const;
  /// From now on every linear solve is taken as a Newton step of τ/η(|γ|, p) = γ, with a stress τ
  /// carried beside the state (the primal-dual form, as ShearFlow's): another way to the same
  /// solution, with fewer steps where η saturates. τ starts from `stress`, ηγ by position, or
  /// without one from the first step.
  using StressField = std::function<Eigen::Matrix<double, Dim, Dim>(const Point<Dim>&)>;
  void carry_stress(const StressField& stress = {});
  /// Sign of det J of the matrix last factored.
  int determinant_sign() const { return system_.determinant_sign(); }

  /// Momentum residual with the rows of fixed velocities kept: the force that the constraint exerts
  /// on the material (consistent nodal reaction), at the state last evaluated.
  const Eigen::VectorXd& reactions() const { return reactions_; }
  const CondensedSystem<Dim>& system() const { return system_; }
  int factorisations() const { return factorisations_; }

 private:
  using States = std::array<PointState<Dim>, Space::points_per_element>;
  struct PointLoad {
    Pack static_pressure;
    PackVector<Dim> body_force;
  };
  Point<Dim> position_of(std::size_t batch, std::size_t q, std::size_t lane) const;
  template <class Regularisation>
  void assemble(const Regularisation& regularisation, const rheology::Rheology& rheology,
                const State& state, solve::Residual& residual, std::vector<States>* states) const;
  /// Residual at a state under a law; keeps the point states if there is a place for them.
  void assemble_with(const rheology::Rheology& rheology, const State& state,
                     solve::Residual& residual, std::vector<States>* states) const;
  void add_open_sides(const rheology::Rheology& rheology, const State& state,
                      solve::Residual& residual) const;
  void add_open_sides(std::size_t batch, BatchTangent<Dim>& tangent) const;
  void add_open_sides(const State& x, Eigen::VectorXd& product) const;
  void update_carried_stress(const State& direction);
  Pack tangent_penalty(std::size_t batch) const;
  double residual_penalty() const {
    return penalty_.kind == Penalty::plain ? penalty_.lambda_p : 0;
  }

  const Space& space_;
  rheology::Rheology rheology_;
  PenaltyOptions penalty_;
  std::function<double(const Point<Dim>&)> static_pressure_;
  double inertia_, load_factor_ = 1;
  TangentFactors factors_;
  CondensedSystem<Dim> system_;
  std::vector<std::array<PointLoad, Space::points_per_element>> loads_;
  std::vector<States> states_;
  bool carries_stress_ = false;
  std::vector<std::array<PackTensor<Dim>, Space::points_per_element>> carried_;  // empty: ηγ
  State evaluated_;  // the state last evaluated
  solve::Residual residual_;
  Eigen::VectorXd reactions_;
  bool is_factored_ = false;
  int factorisations_ = 0;
};

extern template class DenseFlow<2>;
extern template class DenseFlow<3>;

}  // namespace talus::flow
