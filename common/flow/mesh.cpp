#include "common/flow/mesh.hpp"

namespace talus::flow {
namespace {

// Nodes along a line: element boundaries and the middles between them.
std::vector<double> with_middles(std::span<const double> boundaries) {
  std::vector<double> nodes;
  for (std::size_t e = 0; e + 1 < boundaries.size(); ++e) {
    nodes.push_back(boundaries[e]);
    nodes.push_back(0.5 * (boundaries[e] + boundaries[e + 1]));
  }
  nodes.push_back(boundaries.back());
  return nodes;
}

}  // namespace

Mesh<1> line_mesh(std::span<const double> boundaries, bool fixed_at_start, bool fixed_at_end) {
  Mesh<1> mesh;
  const std::size_t elements = boundaries.size() - 1;
  for (std::size_t e = 0; e < elements; ++e) {
    mesh.nodes.emplace_back(boundaries[e]);
    mesh.nodes.emplace_back(0.5 * (boundaries[e] + boundaries[e + 1]));
    const auto first = static_cast<Eigen::Index>(2 * e);
    mesh.elements.push_back({first, first + 1, first + 2});
  }
  mesh.nodes.emplace_back(boundaries.back());
  mesh.fixed.assign(mesh.nodes.size(), false);
  mesh.fixed.front() = fixed_at_start;
  mesh.fixed.back() = fixed_at_end;
  return mesh;
}

Mesh<2> rectangle_mesh(std::span<const double> first, std::span<const double> second,
                       const std::function<bool(const Eigen::Vector2d&)>& is_fixed) {
  const std::vector<double> x = with_middles(first), y = with_middles(second);
  Mesh<2> mesh;
  for (const double each_y : y)
    for (const double each_x : x) {
      mesh.nodes.emplace_back(each_x, each_y);
      mesh.fixed.push_back(is_fixed(mesh.nodes.back()));
    }
  const auto index = [&](std::size_t i, std::size_t j) {
    return static_cast<Eigen::Index>(i + j * x.size());
  };
  for (std::size_t row = 0; row + 1 < second.size(); ++row)
    for (std::size_t column = 0; column + 1 < first.size(); ++column) {
      auto& element = mesh.elements.emplace_back();
      for (std::size_t node = 0; node < element.size(); ++node)
        element[node] = index(2 * column + node % 3, 2 * row + node / 3);
      const std::size_t number = mesh.elements.size() - 1;
      if (column == 0) mesh.boundaries["left"].push_back({number, 0});
      if (column + 2 == first.size()) mesh.boundaries["right"].push_back({number, 1});
      if (row == 0) mesh.boundaries["bottom"].push_back({number, 2});
      if (row + 2 == second.size()) mesh.boundaries["top"].push_back({number, 3});
    }
  return mesh;
}

}  // namespace talus::flow
