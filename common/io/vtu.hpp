// Unstructured grids for ParaView: VTK XML, ASCII.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace talus::io {

/// A named field on points or cells: scalars, or vectors of 3 components stored one after another.
struct Field {
  std::string name;
  std::vector<double> values;
  int components = 1;
};

/// 3^dim: nodes of a quadratic line, quadrilateral or hexahedron.
constexpr std::size_t nodes_per_cell(int dim) {
  return dim == 0 ? 1 : 3 * nodes_per_cell(dim - 1);
}

/// For every place in VTK's order of a quadratic cell's nodes (quadratic edge, biquadratic quad,
/// triquadratic hexahedron) the number i + 3j + 9k of the node there. VTK lists corners, middles of
/// edges, of faces, and the centre.
template <int Dim>
constexpr std::array<std::size_t, nodes_per_cell(Dim)> vtk_order() {
  static_assert(1 <= Dim && Dim <= 3);
  if constexpr (Dim == 1)
    return {0, 2, 1};
  else if constexpr (Dim == 2)
    return {0, 2, 8, 6, 1, 5, 7, 3, 4};
  else
    return {0,  2,  8,  6,  18, 20, 26, 24,                 // corners of the lower, the upper face
            1,  5,  7,  3,  19, 23, 25, 21, 9, 11, 17, 15,  // edges: lower, upper, upright
            12, 14, 10, 16, 4,  22, 13};                    // faces in pairs along the axes, centre
}

/// A cell in VTK's order from its nodes in the order of our elements.
template <int Dim, class Index>
std::array<long, nodes_per_cell(Dim)> vtk_cell(
    const std::array<Index, nodes_per_cell(Dim)>& nodes) {
  std::array<long, nodes_per_cell(Dim)> cell{};
  for (std::size_t place = 0; place < cell.size(); ++place)
    cell[place] = static_cast<long>(nodes[vtk_order<Dim>()[place]]);
  return cell;
}

/// Quadratic tensor-product cells (VTK's types 21, 28 and 29), their nodes in VTK's order.
template <int Dim>
struct Grid {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<long, nodes_per_cell(Dim)>> cells;
  std::vector<Field> point_fields, cell_fields;
};
using QuadraticGrid = Grid<2>;

/// The contents of a .vtu file; every number reads back as the same double.
template <int Dim>
std::string to_vtu(const Grid<Dim>& grid);

/// A file of a series and the time, or the parameter, it belongs to.
struct SeriesEntry {
  double time = 0;
  std::string file;  ///< relative to the collection's own folder
};

/// The contents of a .pvd file: ParaView opens the files of a series as one.
std::string to_pvd(std::span<const SeriesEntry> entries);

}  // namespace talus::io
