#include "common/io/vtu.hpp"

#include "common/io/table.hpp"

namespace talus::io {
namespace {

std::string fields_as_xml(const std::string& tag, const std::vector<Field>& fields) {
  std::string xml = "<" + tag + ">\n";
  for (const Field& field : fields) {
    xml += "<DataArray type=\"Float64\" Name=\"" + field.name + "\" format=\"ascii\">\n";
    for (const double value : field.values) xml += exact(value) + "\n";
    xml += "</DataArray>\n";
  }
  return xml + "</" + tag + ">\n";
}

}  // namespace

std::string to_vtu(const QuadraticGrid& grid) {
  constexpr const char* biquadratic_quad = "28";
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
      std::to_string(grid.points.size()) + "\" NumberOfCells=\"" +
      std::to_string(grid.cells.size()) + "\">\n";
  xml += fields_as_xml("PointData", grid.point_fields);
  xml += fields_as_xml("CellData", grid.cell_fields);
  xml += "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& p : grid.points)
    xml += exact(p[0]) + " " + exact(p[1]) + " " + exact(p[2]) + "\n";
  xml += "</DataArray>\n</Points>\n<Cells>\n";
  xml += "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& cell : grid.cells) {
    for (const long node : cell) xml += std::to_string(node) + " ";
    xml += "\n";
  }
  xml += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= grid.cells.size(); ++i)
    xml += std::to_string(i * grid.cells.front().size()) + "\n";
  xml += "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < grid.cells.size(); ++i) xml += std::string(biquadratic_quad) + "\n";
  return xml + "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace talus::io
