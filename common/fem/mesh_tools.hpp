// What one does with a mesh once its blocks are there: measure, check, join, mirror, name, distort.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/fem/mesh.hpp"

namespace talus::fem {

/// Length, area or volume of a mesh.
template <int Dim>
double measure(const Mesh<Dim>& mesh);

/// Length or area of faces.
template <int Dim>
double measure(const Mesh<Dim>& mesh, const std::vector<Face>& faces);

/// Smallest determinant of dx/dξ over the points of a 3-point Gauss rule in all elements: a mesh
/// whose elements fold over or are turned inside out has it at or below zero.
template <int Dim>
double smallest_jacobian(const Mesh<Dim>& mesh);

/// The node in the middle of a face: no other face of the element has it.
template <int Dim>
Eigen::Index middle_node(const Mesh<Dim>& mesh, const Face& face) {
  constexpr std::size_t middle = (fem::quadratic_nodes(Dim - 1) - 1) / 2;
  return mesh.elements[face.element][face_nodes<Dim>(face.side)[middle]];
}

/// The faces that belong to one element only, element by element.
template <int Dim>
std::vector<Face> outer_faces(const Mesh<Dim>& mesh);

/// Sorts all outer faces anew into boundaries, by the position of their middle nodes.
template <int Dim>
void name_boundaries(
    Mesh<Dim>& mesh,
    const std::function<std::string(const Eigen::Matrix<double, Dim, 1>&)>& name_at);

/// The parts as one mesh: nodes at the same place become one, fixed if any of them was. Elements
/// keep their order; named boundaries keep the faces that still are outer ones.
template <int Dim>
Mesh<Dim> joined(const std::vector<Mesh<Dim>>& parts);

/// The mirror image in the plane where coordinate `axis` vanishes. The first reference direction is
/// reversed, so that Jacobians keep their sign.
template <int Dim>
Mesh<Dim> mirrored(Mesh<Dim> mesh, int axis);

/// Inner vertices moved at random, in each coordinate by at most `amplitude` times their shortest
/// edge (0.2 is a good deal, above 0.25 elements may fold), the other nodes put back to the middles
/// of their vertices: straight-sided elements that are not affine. For meshes with straight sides;
/// the same seed gives the same mesh on every machine.
template <int Dim>
Mesh<Dim> distorted(Mesh<Dim> mesh, double amplitude, unsigned seed);

}  // namespace talus::fem
