// Distance of a computed flow across a line from the exact one.
#pragma once

#include <functional>

#include "oned/solver.hpp"

namespace talus::oned {

/// Of a field at the quadrature points; NaN where a solution holds none.
struct PointNorms {
  double l2 = 0, max = 0;
};

/// All absolute: velocities in sqrt(gL), shear rates in sqrt(g/L), stresses in φρgL; L2 also times
/// sqrt(L).
struct Errors {
  double l2 = 0;         ///< (∫ (w - w_exact)² dx)^½
  double max = 0;        ///< over the whole line
  double nodal_max = 0;  ///< over the nodes
  double paper_rms = 0;  ///< (1/N) (Σ over N nodes)^½, the paper's "RMS": ½ too high in the order
  PointNorms shear_rate, stress;
};

/// Velocity anywhere: the finite-element function. x must lie on the line.
double velocity_at(const Solution& solution, double x);

/// Against the scene's exact profiles.
Errors errors(const Solution& solution, const ShearScene& scene);

/// Between two solutions on the same mesh, in the same norms.
Errors distance(const Solution& a, const Solution& b);

}  // namespace talus::oned
