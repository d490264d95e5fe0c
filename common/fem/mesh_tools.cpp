#include "common/fem/mesh_tools.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <Eigen/LU>

#include "common/fem/quadrature.hpp"

namespace talus::fem {
namespace {

// The determinant of dx/dξ and the quadrature weight at every point of an element or a face of
// dimension Dim in space; a face has the square root of the determinant of its metric.
template <int Dim, int Space, class Visit>
void visit_points(const Eigen::Matrix<double, Space, fem::quadratic_nodes(Dim)>& nodes,
                  const Visit& visit) {
  static const auto rule = fem::gauss_legendre(3);
  for (std::size_t q = 0; q < fem::quadratic_nodes(Dim); ++q) {
    Eigen::Matrix<double, Dim, 1> reference;
    double weight = 1;
    for (std::size_t d = 0, index = q; d < Dim; ++d, index /= 3) {
      reference[static_cast<Eigen::Index>(d)] = rule[index % 3].position;
      weight *= rule[index % 3].weight;
    }
    const fem::QuadraticBasis<Dim> basis(reference);
    const Eigen::Matrix<double, Space, Dim> jacobian = nodes * basis.gradients.transpose();
    if constexpr (Dim == Space)
      visit(jacobian.determinant(), weight);
    else
      visit(std::sqrt((jacobian.transpose() * jacobian).determinant()), weight);
  }
}

template <int Dim, class Visit>
void visit_points(const Mesh<Dim>& mesh, const Visit& visit) {
  Eigen::Matrix<double, Dim, Mesh<Dim>::nodes_per_element> nodes;
  for (const auto& element : mesh.elements) {
    for (std::size_t a = 0; a < element.size(); ++a)
      nodes.col(static_cast<Eigen::Index>(a)) = mesh.nodes[static_cast<std::size_t>(element[a])];
    visit_points<Dim, Dim>(nodes, visit);
  }
}

// How many elements have this face.
template <int Dim>
class FaceCount {
 public:
  explicit FaceCount(const Mesh<Dim>& mesh) : mesh_(mesh), count_(mesh.nodes.size(), 0) {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (int side = 0; side < 2 * Dim; ++side) ++count_[middle({e, side})];
  }
  bool is_outer(const Face& face) const { return count_[middle(face)] == 1; }

 private:
  std::size_t middle(const Face& face) const {
    return static_cast<std::size_t>(middle_node(mesh_, face));
  }
  const Mesh<Dim>& mesh_;
  std::vector<int> count_;
};

// For every node a number that nodes share when they agree in this coordinate. Sorting leaves no
// cell boundary that two roundings of one number could fall either side of.
template <int Dim>
std::vector<std::size_t> levels(const Mesh<Dim>& mesh, int coordinate) {
  const auto at = [&](std::size_t i) { return mesh.nodes[i][coordinate]; };
  std::vector<std::size_t> order(mesh.nodes.size()), level(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return at(a) < at(b); });
  const double tolerance = 1e-12 * (at(order.back()) - at(order.front()));
  for (std::size_t k = 1; k < order.size(); ++k)
    level[order[k]] = level[order[k - 1]] + (at(order[k]) - at(order[k - 1]) > tolerance ? 1 : 0);
  return level;
}

// For every node the first one at its place.
template <int Dim>
std::vector<std::size_t> first_at_place(const Mesh<Dim>& mesh) {
  std::array<std::vector<std::size_t>, Dim> level;
  for (int d = 0; d < Dim; ++d) level[static_cast<std::size_t>(d)] = levels(mesh, d);
  std::vector<std::array<std::size_t, Dim + 1>> keys(mesh.nodes.size());  // levels, node
  for (std::size_t i = 0; i < keys.size(); ++i) {
    for (std::size_t d = 0; d < Dim; ++d) keys[i][d] = level[d][i];
    keys[i].back() = i;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> first(keys.size());
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool is_same =
        k > 0 && std::equal(keys[k].begin(), keys[k].end() - 1, keys[k - 1].begin());
    first[keys[k].back()] = is_same ? first[keys[k - 1].back()] : keys[k].back();
  }
  return first;
}

// Digit of a node number in base 3: its place along a reference coordinate.
std::size_t place_along(std::size_t node, int coordinate) {
  return node / static_cast<std::size_t>(fem::quadratic_nodes(coordinate)) % 3;
}

// Vertices of an element whose mean is the straight-sided place of this node.
template <int Dim>
std::vector<std::size_t> vertices_around(std::size_t node) {
  std::vector<std::size_t> vertices;
  for (std::size_t v = 0; v < Mesh<Dim>::nodes_per_element; ++v) {
    bool is_around = true;
    for (int d = 0; d < Dim; ++d) {
      const std::size_t place = place_along(node, d), corner = place_along(v, d);
      is_around = is_around && corner != 1 && (place == 1 || place == corner);
    }
    if (is_around) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace

template <int Dim>
double measure(const Mesh<Dim>& mesh) {
  long double sum = 0;  // many equal elements: roundings of a double would add up, not cancel
  visit_points(mesh, [&](double determinant, double weight) { sum += weight * determinant; });
  return static_cast<double>(sum);
}

template <int Dim>
double measure(const Mesh<Dim>& mesh, const std::vector<Face>& faces) {
  long double sum = 0;
  Eigen::Matrix<double, Dim, fem::quadratic_nodes(Dim - 1)> nodes;
  for (const Face& face : faces) {
    Eigen::Index column = 0;
    for (const std::size_t a : face_nodes<Dim>(face.side))
      nodes.col(column++) = mesh.nodes[static_cast<std::size_t>(mesh.elements[face.element][a])];
    visit_points<Dim - 1, Dim>(nodes,
                               [&](double stretch, double weight) { sum += weight * stretch; });
  }
  return static_cast<double>(sum);
}

template <int Dim>
double smallest_jacobian(const Mesh<Dim>& mesh) {
  double smallest = std::numeric_limits<double>::infinity();
  visit_points(mesh,
               [&](double determinant, double) { smallest = std::min(smallest, determinant); });
  return smallest;
}

template <int Dim>
std::vector<Face> outer_faces(const Mesh<Dim>& mesh) {
  const FaceCount<Dim> count(mesh);
  std::vector<Face> faces;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (int side = 0; side < 2 * Dim; ++side)
      if (count.is_outer({e, side})) faces.push_back({e, side});
  return faces;
}

template <int Dim>
void name_boundaries(
    Mesh<Dim>& mesh,
    const std::function<std::string(const Eigen::Matrix<double, Dim, 1>&)>& name_at) {
  mesh.boundaries.clear();
  for (const Face& face : outer_faces(mesh)) {
    const auto& middle = mesh.nodes[static_cast<std::size_t>(middle_node(mesh, face))];
    mesh.boundaries[name_at(middle)].push_back(face);
  }
}

template <int Dim>
Mesh<Dim> joined(const std::vector<Mesh<Dim>>& parts) {
  Mesh<Dim> all;  // with nodes still one for each part
  for (const Mesh<Dim>& part : parts) {
    const auto first_node = static_cast<Eigen::Index>(all.nodes.size());
    for (const auto& [name, faces] : part.boundaries)
      for (const Face& face : faces)
        all.boundaries[name].push_back({all.elements.size() + face.element, face.side});
    for (auto element : part.elements) {
      for (auto& node : element) node += first_node;
      all.elements.push_back(element);
    }
    all.nodes.insert(all.nodes.end(), part.nodes.begin(), part.nodes.end());
    all.fixed.insert(all.fixed.end(), part.fixed.begin(), part.fixed.end());
  }

  const auto first = first_at_place(all);
  Mesh<Dim> mesh;
  std::vector<std::size_t> number(first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      number[i] = mesh.nodes.size();
      mesh.nodes.push_back(all.nodes[i]);
      mesh.fixed.push_back(false);
    }
    number[i] = number[first[i]];
    if (all.fixed[i]) mesh.fixed[number[i]] = true;
  }
  mesh.elements = std::move(all.elements);
  for (auto& element : mesh.elements)
    for (auto& node : element)
      node = static_cast<Eigen::Index>(number[static_cast<std::size_t>(node)]);
  const FaceCount<Dim> count(mesh);
  for (const auto& [name, faces] : all.boundaries)
    for (const Face& face : faces)
      if (count.is_outer(face)) mesh.boundaries[name].push_back(face);
  return mesh;
}

template <int Dim>
Mesh<Dim> mirrored(Mesh<Dim> mesh, int axis) {
  for (auto& node : mesh.nodes) node[axis] = 0 - node[axis];  // not -0
  for (auto& element : mesh.elements)
    for (std::size_t row = 0; row < element.size(); row += 3)
      std::swap(element[row], element[row + 2]);
  for (auto& [name, faces] : mesh.boundaries)
    for (Face& face : faces)
      if (face.side < 2) face.side = 1 - face.side;
  return mesh;
}

template <int Dim>
Mesh<Dim> distorted(Mesh<Dim> mesh, double amplitude, unsigned seed) {
  constexpr std::size_t nodes_per_element = Mesh<Dim>::nodes_per_element;
  // Shortest edge at every vertex; other nodes and those on the boundary stay at zero.
  std::vector<double> reach(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (const auto& element : mesh.elements)
    for (std::size_t node = 0; node < nodes_per_element; ++node) {
      const auto vertices = vertices_around<Dim>(node);
      if (vertices.size() > 1) reach[static_cast<std::size_t>(element[node])] = 0;
      if (vertices.size() != 2) continue;  // an edge has two ends
      const auto a = static_cast<std::size_t>(element[vertices[0]]);
      const auto b = static_cast<std::size_t>(element[vertices[1]]);
      const double length = (mesh.nodes[a] - mesh.nodes[b]).norm();
      reach[a] = std::min(reach[a], length);
      reach[b] = std::min(reach[b], length);
    }
  for (const Face& face : outer_faces(mesh))
    for (const std::size_t a : face_nodes<Dim>(face.side))
      reach[static_cast<std::size_t>(mesh.elements[face.element][a])] = 0;

  // Raw values of the generator: the standard's distributions differ between libraries.
  std::mt19937 generator(seed);
  const auto random = [&] {
    return 2 * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max()) - 1;
  };
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (reach[i] > 0)
      for (int d = 0; d < Dim; ++d) mesh.nodes[i][d] += amplitude * reach[i] * random();

  for (std::size_t node = 0; node < nodes_per_element; ++node) {
    const auto vertices = vertices_around<Dim>(node);
    if (vertices.size() == 1) continue;
    for (const auto& element : mesh.elements) {
      Eigen::Matrix<double, Dim, 1> sum = Eigen::Matrix<double, Dim, 1>::Zero();
      for (const std::size_t v : vertices) sum += mesh.nodes[static_cast<std::size_t>(element[v])];
      mesh.nodes[static_cast<std::size_t>(element[node])] =
          sum / static_cast<double>(vertices.size());
    }
  }
  return mesh;
}

#define TALUS_FOR(Dim)                                       \
  template double measure(const Mesh<Dim>&);                 \
  template double smallest_jacobian(const Mesh<Dim>&);       \
  template std::vector<Face> outer_faces(const Mesh<Dim>&);  \
  template Mesh<Dim> joined(const std::vector<Mesh<Dim>>&);  \
  template Mesh<Dim> mirrored(Mesh<Dim>, int);               \
  template Mesh<Dim> distorted(Mesh<Dim>, double, unsigned); \
  template void name_boundaries(                             \
      Mesh<Dim>&, const std::function<std::string(const Eigen::Matrix<double, Dim, 1>&)>&);
TALUS_FOR(1)
TALUS_FOR(2)
TALUS_FOR(3)
#undef TALUS_FOR
template double measure(const Mesh<2>&, const std::vector<Face>&);
template double measure(const Mesh<3>&, const std::vector<Face>&);

}  // namespace talus::fem
