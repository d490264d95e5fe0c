#include "twod/cylinder_mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "common/fem/line_mesh.hpp"
#include "common/fem/mesh_tools.hpp"

namespace talus::twod {
namespace {

using Line = std::vector<double>;
constexpr double radius = 0.5;

int rounded(double count) {
  return static_cast<int>(std::lround(count));
}

fem::Mesh<2> rectangle(const Line& x, const Line& z) {
  return fem::tensor_mesh<2>({x, z});
}

// Layers of the O-grid: as many as widen from the first to the outermost size along a mean ray, and
// a quarter more.
int layers(const CylinderMeshOptions& options, double outer_size) {
  const double first = options.first_layer, ray = 1.1 * options.half_block - radius;
  if (outer_size <= 1.01 * first) return static_cast<int>((options.half_block - radius) / first);
  return rounded(1.25 * std::log(outer_size / first) * ray / (outer_size - first));
}

// The O-grid's quarter x >= 0, z >= 0, on straight rays from the circle to the square.
fem::Mesh<2> o_grid_quarter(const CylinderMeshOptions& options) {
  const int per_side = options.around / 8, rays = 2 * per_side;
  const double block = options.half_block, gap = block - radius;
  const Line depth =
      fem::geometric_line(0, gap, layers(options, block / per_side), options.first_layer);
  fem::Mesh<2> mesh = rectangle(depth, fem::graded_line(0, rays, rays, 1));
  for (Eigen::Vector2d& node : mesh.nodes) {
    const double share = node[0] / gap, ray = node[1];  // ray 0 points along x, the last along z
    const double step = std::numbers::pi / (2 * rays);
    // Both sines: coordinates that vanish do so exactly.
    const Eigen::Vector2d on_circle(std::sin((rays - ray) * step), std::sin(ray * step));
    const Eigen::Vector2d on_square(std::min(rays - ray, 1. * per_side),
                                    std::min(ray, 1. * per_side));
    node = (1 - share) * radius * on_circle + share * (block / per_side) * on_square;
  }
  return mesh;
}

// Elements on half a side of the block, and outside of it: as wide as the O-grid's outermost all
// the way to the box.
struct Divisions {
  int per_side, columns, rows, outlet_rows;
};

Divisions divisions(const CylinderMeshOptions& options) {
  assert(options.around >= 8 && options.around % 8 == 0 && options.half_block > radius);
  const int per_side = options.around / 8;
  const double block = options.half_block, size = block / per_side;
  const double to_wall = options.half_width - block, to_top = options.half_height - block;
  const int fewer = options.around == 160 ? 3 : 0;  // closer to the number of elements in the paper
  const int columns = rounded(to_wall / size) - fewer, rows = rounded(to_top / size) - fewer;
  const double to_outlet = options.outlet - block;
  assert(columns >= 1 && rows >= 1 && to_outlet > 0);
  return {per_side, columns, rows, std::max(1, rounded(rows * to_outlet / to_top))};
}

}  // namespace

CylinderMeshOptions refined_to(int around, CylinderMeshOptions options) {
  options.first_layer *= static_cast<double>(options.around) / around;
  options.around = around;
  return options;
}

std::size_t element_count(const CylinderMeshOptions& options) {
  const auto [per_side, columns, rows, outlet_rows] = divisions(options);
  const int in_grid = 2 * 2 * per_side * layers(options, options.half_block / per_side);
  const int half = in_grid + 2 * per_side * columns + (per_side + columns) * (rows + outlet_rows);
  return static_cast<std::size_t>(options.full ? 2 * half : half);
}

fem::Mesh<2> cylinder_mesh(const CylinderMeshOptions& options) {
  // 1. Element boundaries.
  const auto [per_side, columns, rows, outlet_rows] = divisions(options);
  const double block = options.half_block;
  Line across = fem::graded_line(0, block, per_side, 1);
  const Line outside = fem::graded_line(block, options.half_width, columns, 1);
  across.insert(across.end(), outside.begin() + 1, outside.end());

  // 2. Blocks of the half x >= 0.
  const fem::Mesh<2> quarter = o_grid_quarter(options);
  fem::Mesh<2> mesh = fem::joined<2>(
      {quarter, fem::mirrored(quarter, 1),
       rectangle(outside, fem::graded_line(-block, block, 2 * per_side, 1)),
       rectangle(across, fem::graded_line(block, options.half_height, rows, 1)),
       rectangle(across, fem::graded_line(-options.outlet, -block, outlet_rows, 1))});
  if (options.full) mesh = fem::joined<2>({mesh, fem::mirrored(mesh, 0)});

  // 3. Names of what is left open.
  fem::name_boundaries<2>(mesh, [&](const Eigen::Vector2d& x) {
    if (x[0] == 0) return "symmetry";
    if (std::abs(x[0]) == options.half_width) return "wall";
    if (x[1] == options.half_height) return "top";
    return x[1] == -options.outlet ? "bottom" : "cylinder";
  });
  return mesh;
}

}  // namespace talus::twod
