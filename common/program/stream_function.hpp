// The stream function of a plane flow: its isolines are the streamlines, and between two of them
// flows the same everywhere.
#pragma once

#include "common/mixed/mixed_space.hpp"

namespace talus::program {

/// ψ at the nodes, u = (∂ψ/∂y, -∂ψ/∂x), 0 at the first node of the first element: the flux through
/// a line between two nodes is the difference of ψ. Along the sides of elements u is integrated
/// exactly; it is free of divergence in the mean over each, so that the way does not matter. A node
/// inside an element takes the mean of the ways from its four sides. NaN in parts of the mesh that
/// hang together with the first element by no node.
Eigen::VectorXd stream_function(const mixed::MixedSpace<2>& space,
                                const solve::CompensatedVector& state);

}  // namespace talus::program
