// The shear zone of a split-bottom cell in the limit of slow rotation: the curve r(z) from the
// split to the surface of least resistance, min ∫ r² (H - z) ds (Unger, Török, Kertész & Wolf
// 2004). Lengths in the radius of the split.
#pragma once

#include <vector>

namespace talus::twod {

struct ZoneCurve {
  std::vector<double> depth, radius;  ///< from the surface down to the split
  double surface_radius = 0;          ///< Rc
  double integral = 0;                ///< ∫ r² (H - z) ds, the torque over 2π μs φρg
};

/// The open zone, by shooting from the surface, where the curve is upright, for r = 1 at the
/// bottom. It is the least there is for heights up to 0.7256; beyond, a closed dome over the disc
/// has less. Throws std::domain_error where no such curve is found (heights from about 0.9 on).
ZoneCurve least_resistance(double height);

}  // namespace talus::twod
