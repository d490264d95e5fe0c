#include "common/io/vtu.hpp"

#include <cmath>
#include <ctime>
#include <sstream>

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(vtu_test)

using namespace talus::io;

namespace {

// Where VTK's documentation puts the nodes of a quadratic cell: at the mean of these corners.
using Corners = std::vector<std::size_t>;
const std::vector<Corners> documented_edge = {{0}, {1}, {0, 1}};
const std::vector<Corners> documented_quad = {{0},    {1},    {2},    {3},         {0, 1},
                                              {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}};
const std::vector<Corners> documented_hexahedron = {
    {0},          {1},          {2},
    {3},          {4},          {5},
    {6},          {7},          {0, 1},
    {1, 2},       {2, 3},       {3, 0},
    {4, 5},       {5, 6},       {6, 7},
    {7, 4},       {0, 4},       {1, 5},
    {2, 6},       {3, 7},       {3, 0, 4, 7},
    {1, 2, 6, 5}, {0, 1, 5, 4}, {2, 3, 7, 6},
    {0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 2, 3, 4, 5, 6, 7}};

using Place = std::array<double, 3>;
Place place_of(std::size_t node) {
  return {static_cast<double>(node % 3), static_cast<double>(node / 3 % 3),
          static_cast<double>(node / 9)};
}

// Whether the nodes of a cell lie where the documentation puts them, its corners given.
template <std::size_t N>
bool agrees(const std::array<std::size_t, N>& order, const std::vector<Corners>& documented) {
  const std::vector<Place> corners = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                                      {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  if (documented.size() != N) return false;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t d = 0; d < 3; ++d) {
      double mean = 0;
      for (const std::size_t corner : documented[i])
        mean += corners[corner][d] / static_cast<double>(documented[i].size());
      if (mean != place_of(order[i])[d]) return false;
    }
  return true;
}

// The numbers of the data array whose tag contains this text.
std::vector<double> numbers_of(const std::string& xml, const std::string& tag) {
  const std::size_t start = xml.find('>', xml.find(tag)) + 1;
  std::istringstream body(xml.substr(start, xml.find('<', start) - start));
  std::vector<double> numbers;
  for (std::string word; body >> word;) numbers.push_back(std::stod(word));
  return numbers;
}

template <int Dim>
Grid<Dim> single_cell() {
  Grid<Dim> grid;
  std::array<std::size_t, nodes_per_cell(Dim)> nodes{};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i] = i;
    grid.points.push_back(place_of(i));
  }
  grid.cells.push_back(vtk_cell<Dim>(nodes));
  return grid;
}

template <int Dim>
void check_cell(double type) {
  const Grid<Dim> grid = single_cell<Dim>();
  const std::string xml = to_vtu(grid);
  const auto connectivity = numbers_of(xml, "Name=\"connectivity\"");
  BOOST_TEST(connectivity == grid.cells[0], boost::test_tools::per_element());
  BOOST_TEST(numbers_of(xml, "Name=\"types\"") == std::vector<double>{type},
             boost::test_tools::per_element());
  BOOST_TEST(numbers_of(xml, "Name=\"offsets\"") ==
                 std::vector<double>{static_cast<double>(nodes_per_cell(Dim))},
             boost::test_tools::per_element());
  std::vector<double> coordinates;
  for (const Place& point : grid.points)
    coordinates.insert(coordinates.end(), point.begin(), point.end());
  BOOST_TEST(numbers_of(xml, "type=\"Float64\" NumberOfComponents=\"3\"") == coordinates,
             boost::test_tools::per_element());
}

}  // namespace

BOOST_AUTO_TEST_CASE(nodes_of_quadratic_cells_stand_in_the_documented_order) {
  BOOST_TEST(agrees(vtk_order<1>(), documented_edge));
  BOOST_TEST(agrees(vtk_order<2>(), documented_quad));
  BOOST_TEST(agrees(vtk_order<3>(), documented_hexahedron));
  auto wrong = vtk_order<3>();  // the faces in the order of quadratic cells of other programs
  std::swap(wrong[20], wrong[22]);
  BOOST_TEST(!agrees(wrong, documented_hexahedron));
}

BOOST_AUTO_TEST_CASE(each_kind_of_cell_has_its_type_its_nodes_and_its_points) {
  check_cell<1>(21);
  check_cell<2>(28);
  check_cell<3>(29);
}

BOOST_AUTO_TEST_CASE(scalars_and_vectors_on_points_and_cells_read_back_as_the_same_numbers) {
  Grid<2> grid = single_cell<2>();
  Field velocity{"velocity", {}, 3}, height{"height", {}};
  for (int i = 0; i < 27; ++i) velocity.values.push_back(std::sin(i) * std::pow(10., 3 * i - 40));
  for (int i = 0; i < 9; ++i) height.values.push_back(1 / (i + 3.));
  grid.point_fields = {velocity, height};
  grid.cell_fields = {{"pressure", {-1. / 3}}, {"pressure_gradient", {1e-300, -0.1, 5e-324}, 3}};
  const std::string xml = to_vtu(grid);
  const auto per_element = boost::test_tools::per_element();
  BOOST_TEST(numbers_of(xml, "Name=\"velocity\" NumberOfComponents=\"3\"") == velocity.values,
             per_element);
  BOOST_TEST(numbers_of(xml, "Name=\"height\" NumberOfComponents=\"1\"") == height.values,
             per_element);
  const std::size_t cells = xml.find("<CellData>");
  BOOST_TEST(xml.find("\"height\"") < cells);
  BOOST_TEST(xml.find("\"pressure\"") > cells);
  BOOST_TEST(numbers_of(xml, "Name=\"pressure\"") == grid.cell_fields[0].values, per_element);
}

BOOST_AUTO_TEST_CASE(a_series_lists_its_files_with_their_times) {
  const std::vector<SeriesEntry> entries = {{0.044, "creep.vtu"}, {0.054, "flow.vtu"}};
  const std::string xml = to_pvd(entries);
  const std::size_t first = xml.find("timestep=\"0.044\" group=\"\" part=\"0\" file=\"creep.vtu\"");
  const std::size_t second = xml.find("timestep=\"0.054\" group=\"\" part=\"0\" file=\"flow.vtu\"");
  BOOST_TEST(first < second);
  BOOST_TEST(second < xml.find("</Collection>\n</VTKFile>"));
  BOOST_TEST(to_pvd({}).find("DataSet") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_grid_of_the_size_of_the_cylinder_s_is_written_in_a_second) {
  Grid<2> grid;
  const std::size_t cells = 42'000, points = 4 * cells;
  Field velocity{"velocity", {}, 3}, pressure{"pressure", {}};
  for (std::size_t i = 0; i < points; ++i) {
    const double x = static_cast<double>(i) / 7;
    grid.points.push_back({x, 0, 1 / (1 + x)});
    velocity.values.insert(velocity.values.end(), {std::sin(x), 0, std::cos(x)});
  }
  for (std::size_t i = 0; i < cells; ++i) {
    grid.cells.push_back({});
    grid.cells.back().fill(static_cast<long>(4 * i));
    pressure.values.push_back(std::sin(static_cast<double>(i)));
  }
  grid.point_fields = {velocity};
  grid.cell_fields = {pressure, pressure, pressure, pressure};
  const std::clock_t start = std::clock();  // the processor's: others may keep the machine busy
  const std::string xml = to_vtu(grid);
  const double elapsed = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  BOOST_TEST_MESSAGE("wrote " << xml.size() << " bytes in " << elapsed << " s");
  BOOST_TEST(elapsed < 1);
}

BOOST_AUTO_TEST_SUITE_END()
