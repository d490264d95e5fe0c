// The heap's cross-section: steady flow down a channel on a heap, section 4.1 of the paper, as one
// scalar problem.
//
// Half of the channel, y in [0, W/2] (symmetry at 0, rough side wall at W/2), z in [0, H] (rough
// bottom at 0, free flat surface at H); p = (H - z) cos α exactly, driven by sin α. Dimensionless
// as in the paper: lengths in d, velocity in sqrt(gd).
#pragma once

#include <vector>

#include "common/shear/shear_solver.hpp"

namespace talus::twod {

/// The side wall: without slip, or relaxed to the wall term μ2 p|u| (flow/wall_law.hpp).
enum class Wall { no_slip, friction };

struct Section {
  double angle = 0.41;  ///< α, radians
  double width = 140;   ///< W, the whole channel
  double height = 50;   ///< H
  Wall wall = Wall::no_slip;
  rheology::FrictionLaw law = {};
};

/// Elements across and up, graded towards the side wall and the free surface (1 = uniform).
struct SectionMesh {
  int across = 70, up = 100;
  double grading_to_wall = 1, grading_to_surface = 1;
};

/// What one mesh took.
struct MeshCost {
  SectionMesh mesh;
  solve::End end = solve::End::stagnated;
  int iterations = 0;
  double seconds = 0;  ///< CPU time
};

struct SectionSolution : shear::ShearSolution {
  Section section;
  std::vector<MeshCost> meshes = {};  ///< if there were several, the finest last
};

/// What suits the section: the interior point along the uniform path, to a relative gap of 1e-8;
/// Newton at λr = 1e-5 from a rough solve at 1e-2, and from one every three decades if λr is less.
shear::ShearOptions default_options();
/// The same with Newton at this λr.
shear::ShearOptions newton_options(double lambda_r);

/// Boundaries of the elements along y, from the middle to the wall, and along z, upwards.
struct SectionLines {
  std::vector<double> across, up;
};
SectionLines lines_of(const Section& section, const SectionMesh& mesh);

/// The space of a mesh: it depends on no angle, so that one serves a whole search.
shear::CrossSection<2> space_of(const Section& section, const SectionMesh& mesh);

/// Pressure (H - z) cos α and driving force sin α.
shear::ShearLoad<2> load_of(const Section& section);

/// Solves at section.angle. Newton starts from `start` if it is given, else from rest; the interior
/// point always starts from rest.
SectionSolution solve(const Section& section, shear::CrossSection<2>& space,
                      const shear::ShearOptions& options,
                      const shear::ShearStart<2>* start = nullptr);

/// Q* = (1/W) ∫ u over the whole channel.
double flow_rate(const SectionSolution& solution, const shear::CrossSection<2>& space);

/// What is measured along the free surface, against y.
struct SurfaceProfile {
  std::vector<double> y, velocity;
  /// Depth of the flowing layer: where the velocity first falls below 1% and 5% of that at the
  /// surface, linear between nodes; H where it never does.
  std::vector<double> depth_1, depth_5;
  /// By the yield criterion: where |τ| first falls to μs p.
  std::vector<double> depth_yield;
};
SurfaceProfile surface_profile(const SectionSolution& solution,
                               const shear::CrossSection<2>& space);

/// Share of the section whose stress exceeds μs p: where the material yields.
double yielded_share(const SectionSolution& solution, const shear::CrossSection<2>& space);

/// Limits of existence of the wide layer: at rest below arctan μs, none beyond arctan μ2.
rheology::Regime regime(const Section& section);

}  // namespace talus::twod
