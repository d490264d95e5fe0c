// The door through which a space takes its mesh.
#pragma once

#include "common/fem/mesh.hpp"

namespace talus::fem {

/// The mesh itself, if its elements can be integrated over: all their nodes exist, and det dx/dξ at
/// the points of the 3-point Gauss rule is positive by more than rounding. Else throws
/// std::invalid_argument naming the element (turned inside out, folded over, without extent or not
/// finite), its determinant and where.
template <int Dim>
Mesh<Dim> checked(Mesh<Dim> mesh);

}  // namespace talus::fem
