#include "common/shear/cross_section.hpp"

#include <stdexcept>

#include "common/fem/geometry.hpp"
#include "common/fem/mesh_check.hpp"

namespace talus::shear {

template <int Dim>
CrossSection<Dim>::CrossSection(fem::Mesh<Dim> mesh, const std::string& friction_wall,
                                int points_per_direction, Symmetry symmetry)
    : mesh_(fem::checked(std::move(mesh))),
      skeleton_(mesh_),
      interior_rows_(mesh_.elements.size()),
      interior_pivots_(mesh_.elements.size()) {
  if (symmetry == Symmetry::rotation && !friction_wall.empty())
    throw std::logic_error("CrossSection: no wall with friction around an axis");
  const auto rule = fem::gauss_rule<Dim>(points_per_direction);
  points_per_element_ = rule.size();
  std::vector<std::vector<fem::Face>> wall_sides(element_count());
  if (!friction_wall.empty())
    for (const fem::Face& face : mesh_.boundaries.at(friction_wall))
      wall_sides[face.element].push_back(face);
  for (std::size_t e = 0; e < element_count(); ++e) {
    for (const auto& each : rule) {
      const fem::ElementPoint<Dim> at(mesh_, e, each.position);
      points_.push_back({at.gradients, at.values, at.position, each.weight * at.determinant});
    }
    for (const fem::Face& side : wall_sides[e]) add_wall_points(side, points_per_direction);
    if (symmetry == Symmetry::rotation)
      for (std::size_t k = first_point_.back(); k < points_.size(); ++k) {
        points_[k].gradients *= points_[k].position[0];
        points_[k].weight *= points_[k].position[0];
      }
    first_point_.push_back(points_.size());
  }
}

template <int Dim>
void CrossSection<Dim>::add_wall_points([[maybe_unused]] const fem::Face& side,
                                        [[maybe_unused]] int points_per_direction) {
  // On a line a wall is a point, and the skeleton's fluxes have no place for its force.
  if constexpr (Dim > 1)
    for (const auto& each : fem::face_rule(mesh_, side, points_per_direction)) {
      const fem::ElementPoint<Dim> at(mesh_, side.element, each.reference);
      Point point{{}, at.values, at.position, each.weight, true};
      point.gradients.setZero();
      point.gradients.row(0) = at.values.transpose();
      points_.push_back(point);
    }
}

template <int Dim>
void CrossSection<Dim>::gradients(const solve::CompensatedVector& w, std::vector<Vector>& g) const {
  g.resize(points_.size());
  for (std::size_t e = 0; e < element_count(); ++e) {
    const LocalVelocities local = local_velocities(w, e);
    for (const std::size_t k : points_of(e)) g[k] = points_[k].gradient(local);
  }
}

template <int Dim>
Eigen::VectorXd CrossSection<Dim>::nodal_forces(std::span<const Vector> stress) const {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(node_count());
  for (std::size_t e = 0; e < element_count(); ++e) {
    // course 7: element residual
    NodalValues local = NodalValues::Zero();
    for (const std::size_t k : points_of(e))
      local.noalias() += points_[k].weight * (points_[k].gradients.transpose() * stress[k]);
    for (int a = 0; a < nodes_per_element; ++a)
      force[mesh_.elements[e][static_cast<std::size_t>(a)]] += local[a];
    // end of course 7
  }
  return force;
}

template <int Dim>
Eigen::VectorXd CrossSection<Dim>::internal_force(std::span<const Vector> stress) const {
  Eigen::VectorXd force = nodal_forces(stress);
  clear_fixed(force);
  return force;
}

template <int Dim>
Eigen::VectorXd CrossSection<Dim>::reactions(std::span<const Vector> stress) const {
  const Eigen::VectorXd forces = nodal_forces(stress);
  Eigen::VectorXd on_free_nodes = forces;
  clear_fixed(on_free_nodes);
  return forces - on_free_nodes;
}

template <int Dim>
Eigen::VectorXd CrossSection<Dim>::load(const std::function<double(const Vector&)>& f) const {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(node_count());
  for (std::size_t e = 0; e < element_count(); ++e)
    for (const std::size_t k : points_of(e) | std::views::take(points_per_element_))
      for (int a = 0; a < nodes_per_element; ++a)
        load[mesh_.elements[e][static_cast<std::size_t>(a)]] +=
            points_[k].weight * f(points_[k].position) * points_[k].values[a];
  clear_fixed(load);
  return load;
}

template <int Dim>
void CrossSection<Dim>::assemble(std::span<const Tangent> tangents) {
  constexpr int n = nodes_per_element;
  tangents_.assign(tangents.begin(), tangents.end());
  skeleton_.set_zero();
  for (std::size_t e = 0; e < element_count(); ++e) {
    Eigen::Matrix<double, n, n> matrix = Eigen::Matrix<double, n, n>::Zero();
    for (const std::size_t k : points_of(e)) {
      // course 9: element tangent
      const auto& gradients = points_[k].gradients;
      // Products of this size are faster written out than through Eigen's blocked kernel.
      const Eigen::Matrix<double, Dim, n> flux = (points_[k].weight * tangents[k]) * gradients;
      matrix.noalias() += gradients.transpose().lazyProduct(flux);
      // end of course 9
    }
    Eigen::Matrix<double, n - 1, n - 1> condensed;
    // course 10: condensation
    interior_pivots_[e] = matrix(interior, interior);
    interior_rows_[e] = matrix.col(interior) / interior_pivots_[e];
    for (int a = 0; a < n - 1; ++a)
      for (int b = 0; b < n - 1; ++b) {
        const int i = a < interior ? a : a + 1, j = b < interior ? b : b + 1;
        condensed(a, b) = matrix(i, j) - matrix(i, interior) * interior_rows_[e][j];
      }
    // end of course 10
    skeleton_.add(e, condensed);
  }
  is_factored_ = skeleton_.factor();
}

template <int Dim>
bool CrossSection<Dim>::solve(const Eigen::VectorXd& right_hand_side,
                              solve::CompensatedVector& solution) const {
  if (!is_factored_ || !solve_once(right_hand_side, solution)) return false;
  if constexpr (Dim > 1) {
    solve::CompensatedVector correction;
    if (!solve_once(right_hand_side - product(tangents_, solution), correction)) return false;
    solution = solution.moved(1, correction);
  }
  return solution.value().allFinite();
}

template <int Dim>
bool CrossSection<Dim>::solve_once(const Eigen::VectorXd& right_hand_side,
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
  // The row of an interior node sums to zero (it is on no wall), so it moves relative to any of its
  // neighbours.
  for (std::size_t e = 0; e < element_count(); ++e) {
    const auto& nodes = mesh_.elements[e];
    double relative = right_hand_side[nodes[interior]] / interior_pivots_[e];
    for (int a = 1; a < nodes_per_element; ++a)
      if (a != interior)
        relative -= interior_rows_[e][a] * static_cast<double>(solution.difference(
                                               nodes[static_cast<std::size_t>(a)], nodes[0]));
    solution.set_relative(nodes[interior], nodes[0], relative);
  }
  return true;
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

template <int Dim>
bool CrossSection<Dim>::has_moving_walls(const solve::CompensatedVector& w) const {
  for (Eigen::Index i = 0; i < w.size(); ++i)
    if (mesh_.fixed[static_cast<std::size_t>(i)] && w.value()[i] != 0) return true;
  return false;
}

template class CrossSection<1>;
template class CrossSection<2>;

}  // namespace talus::shear
