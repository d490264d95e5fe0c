// Steady dense granular flow in velocity and pressure as a problem for Newton.
//
//   R_u = ∫ η γ : grad v - p div v + (u·grad u)·v - f·v - ∫_Γ t·v,   R_q = -∫ q (div u + λp p),
// eq. (3), (8) and (9)-(12) with η(|γ|, p_regu(p_static + p)). The sign of the penalty is the one
// that makes the operator definite; eq. (8) prints the other. By default the penalty is iterated:
// it regularises the tangent only, the residual holds div u itself.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/SparseCore>

#include "common/mixed/mixed_kernels.hpp"
#include "common/mixed/open_boundary.hpp"
#include "common/rheology/rheology.hpp"
#include "common/solve/factor_lag.hpp"
#include "common/solve/newton.hpp"

namespace talus::mixed {

enum class Penalty { iterated, plain };

/// What drives the flow, by position; stresses in φρgL.
template <int Dim>
struct MixedLoad {
  std::function<double(const fem::Point<Dim>&)> static_pressure;  ///< p_total = p_static + p
  std::function<fem::Point<Dim>(const fem::Point<Dim>&)>
      body_force;      ///< what p_static does not balance
  double inertia = 1;  ///< factor of the advective term; 0 leaves it out
};

/// λp of a plain penalty is that of eq. (8), a compliance. An iterated one only conditions the
/// linear solves; its λp is divided by the viscosity of each element, so that one value serves a
/// plug and a thin shear layer alike.
struct PenaltyOptions {
  Penalty kind = Penalty::iterated;
  double lambda_p = 1e-4;
};

/// How the system of a Newton step is solved: by factors of its own matrix, or by GMRES with those
/// of an earlier step for as long as that is cheaper. The second leaves an error of 1e-3 in a step
/// and no determinant: it is for Newton's method alone, not for paths.
enum class LinearSolver { direct, lagged };

/// A point of a flow: velocity, its gradient and pressure there, and what the law makes of them.
template <int Dim>
struct FlowPoint {
  typename MixedSpace<Dim>::Values values;
  rheology::LocalState law;
};

template <int Dim>
class MixedFlow {
 public:
  using Space = MixedSpace<Dim>;
  using State = typename Space::State;
  using Stress = std::vector<CarriedStress<Dim>>;

  /// `space` must outlive the problem.
  MixedFlow(const Space& space, rheology::Rheology rheology, const MixedLoad<Dim>& load,
            PenaltyOptions penalty = {});

  /// The same space, law, penalty, tangent and inertia (the load's own is ignored) under another
  /// load.
  MixedFlow under(MixedLoad<Dim> load) const {
    load.inertia = inertia_;
    MixedFlow other(space_, rheology_, load, penalty_);
    other.factors_ = factors_;
    return other;
  }

  const Space& space() const { return space_; }
  const rheology::Rheology& rheology() const { return rheology_; }
  void set_rheology(const rheology::Rheology& rheology) { rheology_ = rheology; }
  void set_lambda_r(double lambda_r) { rheology_.lambda_r = lambda_r; }
  double static_pressure(const fem::Point<Dim>& position) const {
    return static_pressure_(position);
  }
  FlowPoint<Dim> point_at(const solve::CompensatedVector& state, std::size_t element,
                          const fem::Point<Dim>& reference) const;
  /// The body force is multiplied by this factor; 1 at first.
  double load_factor() const { return load_factor_; }
  void set_load_factor(double factor) { load_factor_ = factor; }
  void set_tangent_factors(const TangentFactors& factors) { factors_ = factors; }
  /// Whether the tangent is that of the primal-dual form (see TangentTerm in shear_flow.hpp) about
  /// the stress of the state, and directions carry a stress: another way to the same solution, with
  /// fewer steps where η saturates. Not for arclength: one step, one solve.
  void set_primal_dual(bool is_primal_dual) { is_primal_dual_ = is_primal_dual; }
  bool is_primal_dual() const { return is_primal_dual_; }
  /// A stress by position, to set out from.
  using StressField = std::function<Eigen::Matrix<double, Dim, Dim>(const fem::Point<Dim>&)>;
  Stress stress_of(const StressField& field) const;
  /// A stress from its numbers. Throws std::invalid_argument if there are too many or too few: they
  /// are of another mesh, or of a machine with other vectors.
  Stress stress_of(std::span<const double> numbers) const;
  LinearSolver linear_solver() const { return linear_solver_; }
  /// Factors made before are not used again.
  void set_linear_solver(LinearSolver solver) {
    linear_solver_ = solver;
    lag_ = {};
  }

  /// Residual with its magnitude and computed round-off; keeps what the tangent needs.
  const solve::Residual& evaluate(const State& state);
  /// Solves J x = right_hand_side about the state last evaluated, refined with the uncondensed
  /// matrix. The factors are kept until the next evaluation.
  bool linear_solve(const Eigen::VectorXd& right_hand_side, State& x);
  /// J x, uncondensed; zero at fixed velocities.
  Eigen::VectorXd tangent_product(const solve::CompensatedVector& x) const;
  /// The matrix that is factored, before it is condensed, from the same element tangents; without
  /// the penalty that only the linear solves have it is J. Fixed velocities have no entries.
  enum class TangentPenalty { of_residual, of_solves };
  Eigen::SparseMatrix<double> tangent_matrix(TangentPenalty penalty) const;
  /// dR/d(load factor) and, by a central difference, dR/d(ln λr) at a state; the tangent stays.
  Eigen::VectorXd load_derivative() const;
  Eigen::VectorXd log_lambda_r_derivative(const solve::CompensatedVector& state) const;
  /// Sign of det J of the matrix last factored.
  int determinant_sign() const { return system_.determinant_sign(); }

  /// Momentum residual with the rows of fixed velocities kept: the force that the constraint exerts
  /// on the material (consistent nodal reaction), at the state last evaluated.
  const Eigen::VectorXd& reactions() const { return reactions_; }
  const CondensedSystem<Dim>& system() const { return system_; }
  int factorisations() const { return factorisations_; }
  /// Tangents solved with, by their own factors or by older ones: a Newton iteration each.
  int iterations() const { return factorisations_ + lagged_solves_; }
  /// Iterations of GMRES with lagged factors, those in vain included.
  int krylov_iterations() const { return krylov_iterations_; }

 private:
  using States = std::array<PointState<Dim>, Space::points_per_element>;
  struct PointLoad {
    Pack static_pressure;
    PackVector<Dim> body_force;
  };
  template <class Regularisation>
  void assemble(const Regularisation& regularisation, const rheology::Rheology& rheology,
                const solve::CompensatedVector& state, solve::Residual& residual,
                std::vector<States>* states) const;
  /// Residual at a state under a law; keeps the point states if there is a place for them.
  void assemble_with(const rheology::Rheology& rheology, const solve::CompensatedVector& state,
                     solve::Residual& residual, std::vector<States>* states) const;
  void add_open_sides(const rheology::Rheology& rheology, const solve::CompensatedVector& state,
                      solve::Residual& residual) const;
  void add_open_sides(std::size_t batch, BatchTangent<Dim>& tangent) const;
  void add_open_sides(const solve::CompensatedVector& x, Eigen::VectorXd& product) const;
  bool solve_linearised(const Eigen::VectorXd& right_hand_side, solve::CompensatedVector& x);
  bool factor();
  void element_tangents(std::size_t batch, const Pack& penalty, BatchTangent<Dim>& tangent) const;
  const CarriedStress<Dim>* carried_in(std::size_t batch) const {
    return is_primal_dual_ && !evaluated_.stress.empty() ? &evaluated_.stress[batch] : nullptr;
  }
  Stress stress_after(const solve::CompensatedVector& step) const;
  fem::Point<Dim> position_of(std::size_t batch, std::size_t point, std::size_t lane) const;
  bool iterate(const Eigen::VectorXd& right_hand_side, solve::CompensatedVector& x);
  Pack tangent_penalty(std::size_t batch) const;
  double residual_penalty() const {
    return penalty_.kind == Penalty::plain ? penalty_.lambda_p : 0;
  }

  const Space& space_;
  rheology::Rheology rheology_;
  PenaltyOptions penalty_;
  std::function<double(const fem::Point<Dim>&)> static_pressure_;
  double inertia_, load_factor_ = 1;
  TangentFactors factors_;
  CondensedSystem<Dim> system_;
  std::vector<std::array<PointLoad, Space::points_per_element>> loads_;
  std::vector<States> states_;
  bool is_primal_dual_ = false;
  State evaluated_;  // the state last evaluated
  solve::Residual residual_;
  Eigen::VectorXd reactions_;
  bool is_factored_ = false;
  LinearSolver linear_solver_ = LinearSolver::direct;
  solve::FactorLag lag_;
  int factorisations_ = 0, lagged_solves_ = 0, krylov_iterations_ = 0;
};

/// The numbers of a stress, for a checkpoint.
template <int Dim>
std::vector<double> numbers_of(const std::vector<CarriedStress<Dim>>& stress);

extern template class MixedFlow<2>;
extern template class MixedFlow<3>;

}  // namespace talus::mixed
