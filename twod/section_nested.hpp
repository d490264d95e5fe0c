// Solving the section on ever finer meshes, each from the one before.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "twod/section.hpp"

namespace talus::twod {

/// Where Newton starts: at rest, or on ever finer meshes.
enum class Start { rest, nested };

/// A solution on a coarser mesh is a start only: rough, and of a smoother law, since of a yield
/// surface sharper than its elements a finer mesh sees little but the kinks.
struct CoarserMesh {
  static constexpr int fewest_elements = 8;  ///< each way: a coarser one saves nothing
  static constexpr double tolerance = 1e-2;
  static constexpr double lambda_r_for(double finer) { return std::min(1.0, 4 * finer); }
};

/// Half as many elements each way, rounded up; nothing where fewer would save nothing.
std::optional<SectionMesh> coarsened(const SectionMesh& mesh);

/// A solution on the mesh of these lines, to start from in another space of the same section.
shear::ShearStart<2> carried_over(const SectionSolution& solution,
                                  const shear::CrossSection<2>& space, const SectionLines& lines,
                                  const shear::CrossSection<2>& to);

/// Solves by Newton on `mesh` and before that, roughly, on ever coarser ones, the coarsest from
/// rest; from rest as well wherever a coarser mesh leads nowhere. `space` is that of `mesh`.
SectionSolution solve_nested(const Section& section, const SectionMesh& mesh,
                             shear::CrossSection<2>& space, const shear::ShearOptions& options);

}  // namespace talus::twod
