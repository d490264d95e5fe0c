// The heap on a line: its cross-section averaged over the width, with the friction at the side
// walls as a force on the material (Taberlet et al. 2003, Jop, Forterre & Pouliquen 2005). A model
// with an error of its own, which the mesh does not take away.
//
// z in [0, H], no slip at the bottom 0, free surface at H; p = (H - z) cos α. Walls take μw p each:
//   sin α - 2 μw p/W + ∂τ/∂z = 0,  so  τ/p = tan α - μw (H - z)/W,
// down to where that vanishes; below, they carry the weight with less than all their friction.
#pragma once

#include "oned/shear_scene.hpp"
#include "oned/solver.hpp"

namespace talus::oned {

struct HeapLine {
  double angle = 0.41;         ///< α, radians
  double width = 140;          ///< W, the whole channel, in d
  double height = 50;          ///< H, in d
  double wall_friction = 0.5;  ///< μw; between μs and μ2 where the material slips along the wall
  rheology::FrictionLaw law = {};
  rheology::Regularisation regularisation = rheology::ChauchatMedale{};  ///< whose limit is exact
};

/// The scene with its exact solution, I(τ/p) and one quadrature. At rest for α <= arctan μs if the
/// law has a yield stress, no steady flow for α >= arctan μ2.
ShearScene scene_of(const HeapLine& heap);

/// The exact Q* = ∫ u dz per width, in d sqrt(gd).
double exact_flow_rate(const HeapLine& heap);

/// As of a section (twod::SurfaceProfile) in its middle, in the scaling of the scene.
struct LayerMeasures {
  double flow_rate = 0;  ///< ∫ u dz
  double surface_velocity = 0;
  /// Where the velocity falls to 1% and 5% of that at the surface, and |τ| to μs p.
  double depth_1 = 0, depth_5 = 0, depth_yield = 0;
  double yielded_share = 0;  ///< of the height
};
LayerMeasures measures(const Solution& solution, const ShearScene& scene);

}  // namespace talus::oned
