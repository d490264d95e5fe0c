// The mesh around the cylinder: an O-grid blended into a square, then rectangles out to the box.
#pragma once

#include "common/fem/mesh.hpp"

namespace talus::twod {

/// Lengths in diameters D. The defaults are the mesh of the paper: 160 elements around, the first
/// layer D/50 thick, 42 276 elements in the full box (the paper has 42 200).
struct CylinderMeshOptions {
  int around = 160;           ///< elements on the full circle, a multiple of 8
  double first_layer = 0.02;  ///< thickness of the elements on the cylinder
  bool full = false;          ///< both halves; else x >= 0 only
  double half_width = 10, half_height = 15;
  double half_block = 2.5;  ///< half the side of the square in which the O-grid ends
  double outlet = 15;       ///< the bottom is at z = -outlet; elements keep about their size
};

/// Options for so many elements around, the first layer as much thinner or thicker as the others.
CylinderMeshOptions refined_to(int around, CylinderMeshOptions options = {});

/// How many elements that is.
std::size_t element_count(const CylinderMeshOptions& options);

/// The box |x| <= half_width, -outlet <= z <= half_height without the disc of diameter 1 at the
/// origin, coordinates (x, z), nodes exactly on the circle. Boundaries: "cylinder", "wall"
/// (|x| = half_width), "top" and "bottom" (ends in z), "symmetry" (x = 0, half the box only).
fem::Mesh<2> cylinder_mesh(const CylinderMeshOptions& options);

}  // namespace talus::twod
