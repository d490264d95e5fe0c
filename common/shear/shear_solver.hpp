// Solving unidirectional flow on a cross-section of any dimension, by Newton on the regularised law
// or by the interior point on the law itself.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/shear/interior_point.hpp"
#include "common/shear/shear_flow.hpp"
#include "common/solve/continuation.hpp"
#include "common/solve/jacobian_check.hpp"

namespace talus::shear {

enum class Method { newton, interior_point };

/// When Newton comes down from a larger λr: never, where it fails at the target, or always from
/// rest.
enum class Continuation { never, on_failure, always };

struct ShearOptions {
  Method method = Method::newton;
  rheology::Regularisation regularisation = rheology::ChauchatMedale{};
  double lambda_r = 1e-6;
  solve::NewtonOptions newton;
  Continuation continuation = Continuation::on_failure;
  solve::ContinuationOptions path;
  solve::Precision precision = solve::Precision::compensated;
  TangentTerm tangent_term = TangentTerm::full;
  double slope_factor = 1;  ///< of η' in the tangent; see ShearFlow::set_slope_factor
  InteriorPointOptions interior_point;
  std::function<void(const solve::CompensatedVector&)> observe = {};  ///< Newton's iterates
};

/// What drives the flow: pressure, body force and, where fixed nodes move, their velocity, by
/// position.
template <int Dim>
struct ShearLoad {
  using Position = Eigen::Matrix<double, Dim, 1>;
  rheology::FrictionLaw law;
  std::function<double(const Position&)> pressure;
  std::function<double(const Position&)> body_force;
  std::function<double(const Position&)> wall_velocity = {};
};

struct ShearSolution {
  solve::CompensatedVector velocity;       ///< at the nodes
  std::vector<double> shear_rate, stress;  ///< magnitudes at the quadrature points
  solve::End end = solve::End::stagnated;
  solve::ContinuationSummary newton;    ///< of Newton
  InteriorPointSummary interior_point;  ///< of the interior point
  double seconds = 0;                   ///< CPU time of the solve

  bool is_of_newton() const { return interior_point.history.empty(); }
  /// Newton iterations in all, or factorisations of the interior point.
  int iterations() const {
    return is_of_newton() ? newton.total_iterations() : interior_point.factorisations();
  }
};

/// Where Newton sets out.
template <int Dim>
struct ShearStart {
  solve::CompensatedVector velocity;  ///< at the nodes
  /// Of the velocity at the quadrature points, or of the one that it was interpolated from: the
  /// primal-dual tangent carries their stress. None: that of the velocity.
  std::vector<Eigen::Matrix<double, Dim, 1>> gradients = {};
};

/// The problem Newton solves; `space` must outlive it.
template <int Dim>
ShearFlow<Dim> regularised_problem(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                   const ShearOptions& options);

/// The velocity of a fluid whose viscosity is the pressure, between walls that move: where both
/// methods start then. One factorisation. Throws std::runtime_error if that is singular.
template <int Dim>
solve::CompensatedVector driven_start(CrossSection<Dim>& space, const ShearLoad<Dim>& load);

/// Solves from rest, or from driven_start; Newton from `start` if it is given. The load limits are
/// the caller's business: a mesh may return numbers for a flow that does not exist.
template <int Dim>
ShearSolution solve_shear(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                          const ShearOptions& options, const ShearStart<Dim>* start = nullptr);

/// Checks the linearisation of the chosen method on this mesh, at states that need no solve: the
/// law alone, at rest, in plug, at yield and in flow; the interior point at its start, in plug and
/// in flow. The load only adds a constant and is left out.
template <int Dim>
std::vector<solve::NamedCheck> check_jacobian(CrossSection<Dim>& space, const ShearLoad<Dim>& load,
                                              const ShearOptions& options);

}  // namespace talus::shear
