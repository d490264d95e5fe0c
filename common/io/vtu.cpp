#include "common/io/vtu.hpp"

#include <cassert>
#include <charconv>

#include "common/io/table.hpp"

namespace talus::io {
namespace {

// Appends a number without a string of its own: a large grid has millions.
template <class Number>
void append(std::string& xml, Number number, char separator) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text - 1, number).ptr;
  *end = separator;
  xml.append(text, end + 1);
}

void append_tuples(std::string& xml, const double* values, std::size_t count, int components) {
  for (std::size_t i = 0; i < count; ++i)
    for (int c = 0; c < components; ++c) append(xml, *values++, c + 1 < components ? ' ' : '\n');
}

void append_fields(std::string& xml, const std::string& tag, const std::vector<Field>& fields,
                   std::size_t count) {
  xml += "<" + tag + ">\n";
  for (const Field& field : fields) {
    assert(field.values.size() == count * static_cast<std::size_t>(field.components));
    xml += "<DataArray type=\"Float64\" Name=\"" + field.name + "\" NumberOfComponents=\"" +
           std::to_string(field.components) + "\" format=\"ascii\">\n";
    append_tuples(xml, field.values.data(), count, field.components);
    xml += "</DataArray>\n";
  }
  xml += "</" + tag + ">\n";
}

std::string head(const std::string& type) {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
         "\" version=\"1.0\" byte_order=\"LittleEndian\">\n";
}

}  // namespace

template <int Dim>
std::string to_vtu(const Grid<Dim>& grid) {
  constexpr std::array<int, 4> cell_types = {0, 21, 28, 29};
  std::string xml = head("UnstructuredGrid") + "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
                    std::to_string(grid.points.size()) + "\" NumberOfCells=\"" +
                    std::to_string(grid.cells.size()) + "\">\n";
  append_fields(xml, "PointData", grid.point_fields, grid.points.size());
  append_fields(xml, "CellData", grid.cell_fields, grid.cells.size());
  xml += "<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  for (const auto& point : grid.points) append_tuples(xml, point.data(), 1, 3);
  xml += "</DataArray>\n</Points>\n<Cells>\n";
  xml += "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& cell : grid.cells)
    for (const long& node : cell) append(xml, node, &node == &cell.back() ? '\n' : ' ');
  xml += "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (std::size_t i = 1; i <= grid.cells.size(); ++i) append(xml, i * nodes_per_cell(Dim), '\n');
  xml += "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (std::size_t i = 0; i < grid.cells.size(); ++i) append(xml, cell_types[Dim], '\n');
  return xml + "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

template std::string to_vtu(const Grid<1>&);
template std::string to_vtu(const Grid<2>&);
template std::string to_vtu(const Grid<3>&);

std::string to_pvd(std::span<const SeriesEntry> entries) {
  std::string xml = head("Collection") + "<Collection>\n";
  for (const SeriesEntry& entry : entries)
    xml += "<DataSet timestep=\"" + exact(entry.time) + "\" group=\"\" part=\"0\" file=\"" +
           entry.file + "\"/>\n";
  return xml + "</Collection>\n</VTKFile>\n";
}

}  // namespace talus::io
