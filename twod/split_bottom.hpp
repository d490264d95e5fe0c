// The split-bottom cell (Fenistein & van Hecke 2003; Unger et al. 2004): a layer in a cylinder, of
// whose bottom the disc r < Rs rests; the ring around it and the outer wall turn with Ω.
//
// The flow is u = r ω(r, z) around the axis, its shear rate r|grad ω|, the pressure H - z: the
// scalar problem of a cross-section once more, with rotation (shear::Symmetry). ω is given on the
// bottom and at the outer wall, nothing at the axis and at the surface. Lengths in Rs, stress in
// φρgRs; rates times d* = d/Rs in sqrt(g/Rs), which leaves no d in the law.
#pragma once

#include <vector>

#include "common/shear/shear_solver.hpp"

namespace talus::twod {

struct SplitBottom {
  double height = 0.5;        ///< H
  double outer_radius = 1.3;  ///< Ro
  double rate = 1e-8;         ///< d* Ω
  rheology::FrictionLaw law = {};
};

/// Elements along a radius of the split, everywhere else in proportion, and their grading towards
/// the split (1 = uniform).
struct SplitBottomMesh {
  int elements = 40;
  double grading = 1;
};

struct SplitBottomSolution : shear::ShearSolution {
  SplitBottom cell;
};

/// The interior point on its uniform path; Newton by way of λr from the rate down, to a hundred
/// thousandth of it.
shear::ShearOptions default_options(const SplitBottom& cell);

shear::CrossSection<2> space_of(const SplitBottom& cell, const SplitBottomMesh& mesh);
/// Pressure H - z, no force; walls that turn.
shear::ShearLoad<2> load_of(const SplitBottom& cell);

SplitBottomSolution solve(const SplitBottom& cell, shear::CrossSection<2>& space,
                          const shear::ShearOptions& options);

/// The shear zone by height: where ω = Ω/2, and the W of ω/Ω = ½ + ½ erf((r - R)/W), from where ω
/// is 16% and 84% of Ω. The outermost where there are several; NaN where the whole height turns or
/// rests.
struct Zone {
  std::vector<double> height, centre, width;
};
Zone zone_of(const SplitBottomSolution& solution, const shear::CrossSection<2>& space);

/// Over 2π μs φρg Rs⁴: the torque T, from the power it takes, and the energy ∫ D r dr dz over Ω.
/// Both tend to ∫ r² (H - z) ds of the curve of least resistance.
double torque_integral(const SplitBottomSolution& solution, const shear::CrossSection<2>& space);
double energy(const SplitBottomSolution& solution, const shear::CrossSection<2>& space);

}  // namespace talus::twod
