#include "common/flow/cross_section.hpp"

#include <Eigen/LU>

#include "common/fem/quadrature.hpp"

namespace talus::flow {

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

Skeleton<1>::Skeleton(const Mesh<1>& mesh) : row_of_element_(mesh.elements.size()) {
  const std::size_t n = mesh.elements.size();
  const bool from_end = !mesh.fixed.front();  // elimination starts at a fixed vertex
  std::vector<double> coupling;               // of each row with the next
  const auto add_vertex = [&](std::size_t node) {
    if (mesh.fixed[node]) return;
    rows_.push_back({.node = static_cast<Eigen::Index>(node)});
    coupling.push_back(1);
  };
  add_vertex(from_end ? 2 * n : 0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t element = from_end ? n - 1 - i : i;
    const auto left = static_cast<Eigen::Index>(2 * element);
    row_of_element_[element] = static_cast<Eigen::Index>(rows_.size());
    rows_.push_back({.from = from_end ? left + 2 : left, .to = from_end ? left : left + 2});
    coupling.push_back(-1);
    add_vertex(static_cast<std::size_t>(rows_.back().to));
  }
  const auto size = static_cast<Eigen::Index>(rows_.size());
  matrix_.diagonal = Eigen::VectorXd::Zero(size);
  matrix_.off_diagonal = Eigen::Map<Eigen::VectorXd>(coupling.data(), size - 1);
}

void Skeleton<1>::add(std::size_t element, const Eigen::Matrix2d& matrix) {
  matrix_.diagonal[row_of_element_[element]] = -1 / matrix(0, 1);
}

bool Skeleton<1>::solve(const Eigen::VectorXd& force, solve::CompensatedVector& velocity) const {
  const auto size = static_cast<Eigen::Index>(rows_.size());
  Eigen::VectorXd b = Eigen::VectorXd::Zero(size), x;
  for (Eigen::Index i = 0; i < size; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    if (row.node >= 0) b[i] = -force[row.node];
  }
  if (!solve::solve_tridiagonal(matrix_, b, x)) return false;
  // Velocities from the fluxes: their differences keep all digits where they are tiny.
  for (Eigen::Index i = 0; i < size; ++i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    if (row.node < 0) velocity.set_relative(row.to, row.from, x[i] * matrix_.diagonal[i]);
  }
  return true;
}

template <int Dim>
CrossSection<Dim>::CrossSection(Mesh<Dim> mesh, int points_per_direction)
    : mesh_(std::move(mesh)),
      skeleton_(mesh_),
      interior_rows_(mesh_.elements.size()),
      interior_pivots_(mesh_.elements.size()) {
  const auto rule = fem::gauss_legendre(points_per_direction);
  const auto per_direction = rule.size();
  std::size_t per_element = 1;
  for (int d = 0; d < Dim; ++d) per_element *= per_direction;
  for (const auto& element : mesh_.elements) {
    Eigen::Matrix<double, Dim, nodes_per_element> nodes;
    for (int a = 0; a < nodes_per_element; ++a)
      nodes.col(a) = mesh_.nodes[static_cast<std::size_t>(element[static_cast<std::size_t>(a)])];
    for (std::size_t q = 0; q < per_element; ++q) {
      Vector reference;
      double weight = 1;
      for (std::size_t d = 0, index = q; d < Dim; ++d, index /= per_direction) {
        reference[static_cast<Eigen::Index>(d)] = rule[index % per_direction].position;
        weight *= rule[index % per_direction].weight;
      }
      const fem::QuadraticBasis<Dim> basis(reference);
      const Tangent jacobian = nodes * basis.gradients.transpose();  // dx_i/dξ_j
      points_.push_back({jacobian.inverse().transpose() * basis.gradients, basis.values,
                         nodes * basis.values, weight * jacobian.determinant()});
    }
  }
}

template <int Dim>
void CrossSection<Dim>::gradients(const solve::CompensatedVector& w, std::vector<Vector>& g) const {
  g.resize(points_.size());
  for (std::size_t e = 0, k = 0; e < element_count(); ++e) {
    const LongNodalValues relative = relative_velocities(w, e);
    for (std::size_t q = 0; q < points_per_element(); ++q, ++k)
      g[k] = points_[k].gradient(relative);
  }
}

template <int Dim>
Eigen::VectorXd CrossSection<Dim>::internal_force(std::span<const Vector> stress) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(node_count());
  for (std::size_t e = 0, k = 0; e < element_count(); ++e) {
    NodalValues local = NodalValues::Zero();
    for (std::size_t q = 0; q < points_per_element(); ++q, ++k)
      local.noalias() += points_[k].weight * (points_[k].gradients.transpose() * stress[k]);
    for (int a = 0; a < nodes_per_element; ++a)
      force[mesh_.elements[e][static_cast<std::size_t>(a)]] += local[a];
  }
  clear_fixed(force);
  return force;
}

template <int Dim>
Eigen::VectorXd CrossSection<Dim>::load(const std::function<double(const Vector&)>& f) const {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(node_count());
  for (std::size_t e = 0, k = 0; e < element_count(); ++e)
    for (std::size_t q = 0; q < points_per_element(); ++q, ++k)
      for (int a = 0; a < nodes_per_element; ++a)
        load[mesh_.elements[e][static_cast<std::size_t>(a)]] +=
            points_[k].weight * f(points_[k].position) * points_[k].values[a];
  clear_fixed(load);
  return load;
}

template <int Dim>
void CrossSection<Dim>::assemble(std::span<const Tangent> tangents) {
  constexpr int n = nodes_per_element;
  skeleton_.set_zero();
  for (std::size_t e = 0, k = 0; e < element_count(); ++e) {
    Eigen::Matrix<double, n, n> matrix = Eigen::Matrix<double, n, n>::Zero();
    for (std::size_t q = 0; q < points_per_element(); ++q, ++k) {
      const auto& gradients = points_[k].gradients;
      matrix.noalias() += gradients.transpose() * ((points_[k].weight * tangents[k]) * gradients);
    }
    interior_pivots_[e] = matrix(interior, interior);
    interior_rows_[e] = matrix.col(interior) / interior_pivots_[e];
    Eigen::Matrix<double, n - 1, n - 1> condensed;
    for (int a = 0; a < n - 1; ++a)
      for (int b = 0; b < n - 1; ++b) {
        const int i = a < interior ? a : a + 1, j = b < interior ? b : b + 1;
        condensed(a, b) = matrix(i, j) - matrix(i, interior) * interior_rows_[e][j];
      }
    skeleton_.add(e, condensed);
  }
}

template <int Dim>
bool CrossSection<Dim>::solve(const Eigen::VectorXd& right_hand_side,
                              solve::CompensatedVector& solution) const {
  Eigen::VectorXd force = right_hand_side;
  for (std::size_t e = 0; e < element_count(); ++e) {
    const auto& nodes = mesh_.elements[e];
    for (int a = 0; a < nodes_per_element; ++a)
      if (a != interior)
        force[nodes[static_cast<std::size_t>(a)]] -=
            interior_rows_[e][a] * right_hand_side[nodes[interior]];
  }
  solution = solve::CompensatedVector(node_count());
  if (!skeleton_.solve(force, solution)) return false;
  // The row of an interior node sums to zero, so it moves relative to any of its neighbours.
  for (std::size_t e = 0; e < element_count(); ++e) {
    const auto& nodes = mesh_.elements[e];
    double relative = right_hand_side[nodes[interior]] / interior_pivots_[e];
    for (int a = 1; a < nodes_per_element; ++a)
      if (a != interior)
        relative -= interior_rows_[e][a] * static_cast<double>(solution.difference(
                                               nodes[static_cast<std::size_t>(a)], nodes[0]));
    solution.set_relative(nodes[interior], nodes[0], relative);
  }
  return solution.value().allFinite();
}

template <int Dim>
Eigen::VectorXd CrossSection<Dim>::product(std::span<const Tangent> tangents,
                                           const solve::CompensatedVector& x) const {
  std::vector<Vector> g;
  gradients(x, g);
  for (std::size_t k = 0; k < g.size(); ++k) g[k] = tangents[k] * g[k];
  return internal_force(g);
}

template <int Dim>
void CrossSection<Dim>::clear_fixed(Eigen::VectorXd& values) const {
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (mesh_.fixed[static_cast<std::size_t>(i)]) values[i] = 0;
}

template class CrossSection<1>;

}  // namespace talus::flow
