// Granular flow down a channel past a cylinder, in velocity and pressure.
//
// Scaled by the confining pressure: lengths in D, stress in p_ext, velocity in sqrt(p_ext/(φρ)).
// Then p_total = 1 + p, the body force is -F e_z with F = φρgD/p_ext, and the solution depends on
// the loading F alone. The channel without the cylinder flows from F = μs/half_width on.
#pragma once

#include <functional>
#include <string>

#include "common/mixed/creep.hpp"
#include "common/mixed/mixed_path.hpp"
#include "common/mixed/mixed_tangent.hpp"
#include "common/solve/arclength.hpp"
#include "twod/cylinder_mesh.hpp"

namespace talus::twod {

struct Cylinder {
  CylinderMeshOptions mesh;
  rheology::FrictionLaw law = {.mu_s = 0.4, .delta_mu = 0.25, .I0 = 0.3, .grain_size = 0.1};
  rheology::Regularisation regularisation = rheology::ChauchatMedale{};
  double lambda_r = 1e-6;
  double pressure_floor = 0;         ///< of eq. (16), in p_ext, if larger than λr
  bool regularises_pressure = true;  ///< eq. (16); else p_regu = max(p, 0)
  mixed::PenaltyOptions penalty;
  bool inertia = true;
  mixed::Open open_outlet = mixed::Open::no;  ///< the paper's open boundary below, eq. (8)
  /// Of creep, starts and primal-dual paths; one that is dropped or broken is of every step.
  shear::TangentTerm tangent = shear::TangentTerm::primal_dual;
};

/// The discrete problem of a scene.
class CylinderFlow {
 public:
  using State = mixed::MixedFlow<2>::State;
  explicit CylinderFlow(const Cylinder& scene);
  CylinderFlow(const CylinderFlow&) = delete;  // flow_ refers to space_
  CylinderFlow& operator=(const CylinderFlow&) = delete;

  const Cylinder& scene() const { return scene_; }
  const mixed::MixedSpace<2>& space() const { return space_; }
  mixed::MixedFlow<2>& flow() { return flow_; }
  const mixed::MixedFlow<2>& flow() const { return flow_; }

 private:
  Cylinder scene_;
  mixed::MixedSpace<2> space_;
  mixed::MixedFlow<2> flow_;
};

/// What is measured of a solution; forces per unit thickness on the whole cylinder and both walls.
struct CylinderMeasures {
  double loading = 0, lambda_r = 0;
  double mean_velocity = 0;  ///< U, flux through the inlet over its width
  double drag = 0;           ///< F_D/(p_ext D) from the consistent nodal reactions
  double drag_traction = 0;  ///< the same from the integral of the traction
  double wall_force = 0;     ///< friction of the side walls
  double weight = 0;         ///< F times area, both halves
  double momentum_flux = 0;  ///< ∫ (u·grad) u_z: what the flow carries off
  double min_pressure = 0;   ///< smallest total pressure at the quadrature points
  double max_pressure = 0;
  double largest_velocity = 0;
  double divergence = 0;            ///< ‖div u‖ in L2 over ‖grad u‖
  double projected_divergence = 0;  ///< the same projected onto the pressures: what p can control
  double yielded_share = 0;         ///< area where the stress exceeds μs p_regu
  double ill_posed_share = 0;       ///< area that flows (yields) where C > 0
  double negative_share = 0;        ///< area of negative total pressure

  /// (drag + walls + momentum - weight)/weight: 0 in equilibrium, to round-off.
  double imbalance() const { return (drag + wall_force + momentum_flux - weight) / weight; }
  /// F_D/(½ φρ U² D).
  double drag_coefficient() const { return 2 * drag / (mean_velocity * mean_velocity); }
  /// U/sqrt(gD) with p_ext in φρgD.
  double froude(double confining_pressure) const {
    return mean_velocity * std::sqrt(confining_pressure);
  }
  /// U/sqrt(g(D+d)); d* = d/D is that of the scene.
  double effective_froude(double confining_pressure) const;
};

/// Measures a state at the flow's own loading and λr; evaluates the flow there.
CylinderMeasures measure(CylinderFlow& cylinder, const CylinderFlow::State& state);

/// How a path is followed: round its folds; with the parameter stepped and Newton's own tangent;
/// with the parameter stepped, in decades of λr, and the primal-dual tangent.
enum class Continuation { arclength, natural, primal_dual };
std::string name_of(Continuation continuation);

/// Sees every accepted point of a path, of λr or of the loading, as where it goes on from; false
/// stops it.
using CylinderObserver = std::function<bool(const solve::PathStart<CylinderFlow::State>&,
                                            const CylinderMeasures&, solve::PathPoint&)>;

/// A path of solutions; `end` tells whether it reached its target.
using CylinderPath = solve::Path<CylinderFlow::State>;

/// A loading that the cylinder and the walls hold: a little above the onset in the empty channel.
double held_loading(const Cylinder& scene);

/// Whether it makes sense to look for creep: a law with a yield stress, a loading that walls and
/// cylinder hold between them, or nearly so, no plain penalty that gives way before friction, and
/// no open outlet, with which there are several flows.
bool may_creep(const Cylinder& scene, double loading);

/// Options with which paths of this scene are followed.
solve::PathOptions cylinder_path_options();

/// Solves a loading from nothing: Newton from rest at λr = 0.1 (in primal-dual form at 0.01, under
/// a floor in eq. (16) that goes, else without), where that fails along the loading at 0.03 (0.01,
/// then 0.03); then a path in log10 λr down to the scene's, in primal-dual form roughly. The flow
/// is left at that loading and the last λr.
CylinderPath solve_from_rest(CylinderFlow& cylinder, double loading,
                             Continuation continuation = Continuation::primal_dual,
                             const solve::PathOptions& options = cylinder_path_options(),
                             const CylinderObserver& observe = {});

/// Solves a loading that the cylinder holds, where velocities go with λr, without a path
/// (common/mixed/creep.hpp): from rest, or from the state, which creeps under `loading_before`. If
/// it fails the state is as it was.
mixed::CreepSummary creep_to(CylinderFlow& cylinder, double loading, double loading_before,
                             CylinderFlow::State& state,
                             const solve::NewtonOptions& options = mixed::creep_options());
/// From rest.
solve::NewtonSummary solve_creep(CylinderFlow& cylinder, double loading,
                                 CylinderFlow::State& state);

/// Follows log10 λr from a point of such a path.
CylinderPath follow_lambda_r(CylinderFlow& cylinder, double loading,
                             solve::PathStart<CylinderFlow::State> start, Continuation continuation,
                             solve::PathOptions options, const CylinderObserver& observe = {});

/// Follows the loading at the scene's λr from `start` (its parameter is the loading) to `target`.
CylinderPath follow_loading(CylinderFlow& cylinder, solve::PathStart<CylinderFlow::State> start,
                            double target, Continuation continuation = Continuation::primal_dual,
                            const solve::PathOptions& options = cylinder_path_options(),
                            const CylinderObserver& observe = {});

}  // namespace talus::twod
