// A mesh as the grid that ParaView shows.
#pragma once

#include <array>

#include "common/fem/mesh.hpp"
#include "common/io/vtu.hpp"

namespace talus::program {

/// Points and cells of the mesh, fields still to come; coordinate d of the mesh is drawn along
/// axes[d] of space (0 = x, 1 = y, 2 = z).
template <int Dim>
io::Grid<Dim> grid_of(const fem::Mesh<Dim>& mesh, const std::array<std::size_t, Dim>& axes) {
  io::Grid<Dim> grid;
  grid.points.reserve(mesh.nodes.size());
  for (const auto& node : mesh.nodes) {
    auto& point = grid.points.emplace_back();
    for (std::size_t d = 0; d < Dim; ++d) point[axes[d]] = node[static_cast<Eigen::Index>(d)];
  }
  grid.cells.reserve(mesh.elements.size());
  for (const auto& element : mesh.elements) grid.cells.push_back(io::vtk_cell<Dim>(element));
  return grid;
}

}  // namespace talus::program
