// Unstructured grids for ParaView: VTK XML, ASCII.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace talus::io {

/// A named scalar field, one value a point or a cell.
struct Field {
  std::string name;
  std::vector<double> values;
};

/// Nine-node quadrilaterals (VTK's biquadratic quad, type 28). Cells list their nodes in VTK's
/// order: corners, middles of the edges from the first corner on, centre.
struct QuadraticGrid {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<long, 9>> cells;
  std::vector<Field> point_fields, cell_fields;
};

/// The contents of a .vtu file.
std::string to_vtu(const QuadraticGrid& grid);

}  // namespace talus::io
