#include "common/fem/mesh.hpp"

#include <cmath>
#include <utility>

#include "common/fem/line_mesh.hpp"

namespace talus::fem {
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

// Places of a number in a grid of these sizes, the first running fastest.
template <std::size_t Dim>
std::array<std::size_t, Dim> places(std::size_t number, const std::array<std::size_t, Dim>& sizes) {
  std::array<std::size_t, Dim> place{};
  for (std::size_t d = 0; d < Dim; number /= sizes[d++]) place[d] = number % sizes[d];
  return place;
}

}  // namespace

template <int Dim>
Mesh<Dim> tensor_mesh(const std::array<std::span<const double>, Dim>& boundaries) {
  constexpr std::size_t dim = Dim;
  constexpr std::array<const char*, 6> names = {"left", "right", "bottom", "top", "back", "front"};
  std::array<std::vector<double>, dim> lines;
  std::array<std::size_t, dim> node_counts, element_counts, threes;
  std::size_t nodes = 1, elements = 1;
  for (std::size_t d = 0; d < dim; ++d) {
    lines[d] = with_middles(boundaries[d]);
    nodes *= node_counts[d] = lines[d].size();
    elements *= element_counts[d] = boundaries[d].size() - 1;
    threes[d] = 3;
  }

  Mesh<Dim> mesh;
  mesh.fixed.assign(nodes, false);
  for (std::size_t n = 0; n < nodes; ++n) {
    const auto place = places(n, node_counts);
    auto& node = mesh.nodes.emplace_back();
    for (std::size_t d = 0; d < dim; ++d) node[static_cast<Eigen::Index>(d)] = lines[d][place[d]];
  }
  for (std::size_t e = 0; e < elements; ++e) {
    const auto place = places(e, element_counts);
    auto& element = mesh.elements.emplace_back();
    for (std::size_t a = 0; a < element.size(); ++a) {
      const auto within = places(a, threes);
      std::size_t node = 0;
      for (std::size_t d = dim; d-- > 0;) node = node * node_counts[d] + 2 * place[d] + within[d];
      element[a] = static_cast<Eigen::Index>(node);
    }
    for (std::size_t d = 0; d < dim; ++d) {
      const int side = static_cast<int>(2 * d);
      if (place[d] == 0) mesh.boundaries[names[2 * d]].push_back({e, side});
      if (place[d] + 1 == element_counts[d])
        mesh.boundaries[names[2 * d + 1]].push_back({e, side + 1});
    }
  }
  return mesh;
}

template Mesh<1> tensor_mesh<1>(const std::array<std::span<const double>, 1>&);
template Mesh<2> tensor_mesh<2>(const std::array<std::span<const double>, 2>&);
template Mesh<3> tensor_mesh<3>(const std::array<std::span<const double>, 3>&);

Mesh<1> line_mesh(std::span<const double> boundaries, bool fixed_at_start, bool fixed_at_end) {
  Mesh<1> mesh = tensor_mesh<1>({boundaries});
  mesh.fixed.front() = fixed_at_start;
  mesh.fixed.back() = fixed_at_end;
  return mesh;
}

Mesh<2> rectangle_mesh(std::span<const double> first, std::span<const double> second,
                       const std::function<bool(const Eigen::Vector2d&)>& is_fixed) {
  Mesh<2> mesh = tensor_mesh<2>({first, second});
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) mesh.fixed[i] = is_fixed(mesh.nodes[i]);
  return mesh;
}

Mesh<3> box_mesh(std::span<const double> first, std::span<const double> second,
                 std::span<const double> third) {
  return tensor_mesh<3>({first, second, third});
}

Mesh<2> annulus_mesh(double inner_radius, double outer_radius, int around, int layers, double start,
                     double end) {
  const auto radii = fem::graded_line(inner_radius, outer_radius, layers, 1);
  const auto angles = fem::graded_line(start, end, around, 1);
  Mesh<2> mesh = tensor_mesh<2>({radii, angles});
  for (auto& node : mesh.nodes)
    node = node[0] * Eigen::Vector2d(std::cos(node[1]), std::sin(node[1]));
  for (const auto& [plane, curved] :
       {std::pair{"left", "inner"}, {"right", "outer"}, {"bottom", "start"}, {"top", "end"}}) {
    auto boundary = mesh.boundaries.extract(plane);
    boundary.key() = curved;
    mesh.boundaries.insert(std::move(boundary));
  }
  return mesh;
}

}  // namespace talus::fem
