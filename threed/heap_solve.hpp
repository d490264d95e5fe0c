// Solving the heap in three dimensions, from rest or from its cross-section.
#pragma once

#include <memory>

#include "common/mixed/mixed_tangent.hpp"
#include "threed/heap.hpp"

namespace talus::threed {

/// Where Newton starts: at rest, coming down in λr; on ever finer meshes, each from the one before
/// (the coarsest at rest, an open outlet from a developed one); or from the extruded cross-section.
enum class Start { rest, nested, section };

/// The residual is of 1e-14, about round-off, the velocity as good as 1e-10.
struct HeapOptions {
  Start start = Start::nested;
  solve::NewtonOptions newton{
      .tolerance = 1e-14, .distance = 1e-10, .line_search = solve::LineSearch::residual_norm};
  /// In its primal-dual form a stress is carried beside the velocity, from mesh to mesh too.
  shear::TangentTerm tangent = shear::TangentTerm::primal_dual;
  bool comes_down = true;  ///< in λr, from rest; else Newton at λr directly and only
};

/// What one mesh took.
struct MeshCost {
  HeapMesh mesh;
  solve::End end = solve::End::stagnated;
  int iterations = 0, factorisations = 0;
  Eigen::Index unknowns = 0, condensed = 0;
  double factor_entries = 0;
  double seconds = 0;  ///< CPU time, with the analysis of the mesh
};

struct HeapSolution {
  std::unique_ptr<HeapFlow> flow;
  HeapFlow::State state;
  std::vector<MeshCost> meshes;  ///< the finest last
  /// The section at half the length, as a solution of the two-dimensional model; Newton's record
  /// on the finest mesh and the CPU time on all meshes with it.
  twod::SectionSolution middle;
  /// Largest |v|, |w| at the nodes and |p_dyn| at the quadrature points; how far u is from that of
  /// the middle, relative to its largest.
  double cross_flow = 0, dynamic_pressure = 0, change_along = 0;
};

/// Solves at heap.section.angle. `section` is the solution on the same mesh of the section that
/// Start::section begins with; the other starts need none.
HeapSolution solve(const Heap& heap, const HeapMesh& mesh, const HeapOptions& options = {},
                   const twod::SectionSolution* section = nullptr);

/// Options with which the cross-section is solved for the same discrete problem.
shear::ShearOptions section_options(const Heap& heap, const HeapOptions& options);

}  // namespace talus::threed
