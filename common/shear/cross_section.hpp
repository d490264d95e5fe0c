// The finite-element space of unidirectional flow: quadratic elements on a cross-section of any
// dimension, interior nodes condensed.
//
// The velocity w(x) along the flow solves div(A grad w) + f = 0 with a point tangent A; both Newton
// and the interior point build their linear systems here from values at the quadrature points.
//
// A wall with friction adds ∫ D(|w|) along it. Its quadrature points are points like the others,
// with the slip velocity over the unit of length as first component of their "gradient": a layer
// of shear one unit thick, squeezed into the wall.
#pragma once

#include <functional>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/fem/lagrange.hpp"
#include "common/shear/skeleton.hpp"
#include "common/solve/compensated_vector.hpp"

namespace talus::shear {

/// Of the flow: nothing changes along a straight stream, or around an axis, which is the line where
/// the first coordinate r vanishes. There the velocity stands for an angular one ω: the stream is r
/// ω, its shear rate r|grad ω|, and areas count r times. Torques stand for forces.
enum class Symmetry { translation, rotation };

template <int Dim>
class CrossSection {
 public:
  static constexpr int nodes_per_element = fem::quadratic_nodes(Dim);
  static constexpr int interior = (nodes_per_element - 1) / 2;
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Tangent = Eigen::Matrix<double, Dim, Dim>;
  using NodalValues = Eigen::Matrix<double, nodes_per_element, 1>;
  using LongNodalValues = Eigen::Matrix<long double, nodes_per_element, 1>;

  /// Nodal velocities of an element relative to its interior node: their gradient is the same, and
  /// the differences are exact where velocities hardly differ.
  struct LocalVelocities {
    LongNodalValues relative;
    long double interior;
  };

  /// One quadrature point of one element.
  struct Point {
    /// Of the basis, on a wall its values; with rotation times r.
    Eigen::Matrix<double, Dim, nodes_per_element> gradients;
    NodalValues values;
    Vector position;
    /// Quadrature weight times the area of the element, or of its face, there; with rotation times
    /// r.
    double weight = 0;
    bool on_wall = false;

    /// grad w from local velocities, or the slip. Where a stiff point shares its element with soft
    /// ones, its gradient is what two large slopes leave: summed in extended precision.
    Vector gradient(const LocalVelocities& w) const {
      Eigen::Matrix<long double, Dim, 1> g = gradients.template cast<long double>() * w.relative;
      if (on_wall) g[0] += w.interior;
      return g.template cast<double>();
    }
  };

  /// `friction_wall` names the boundary that slips with friction, if there is one (Dim > 1). Its
  /// nodes must not be fixed. Throws what checked() throws of a mesh, and std::logic_error for such
  /// a wall around an axis.
  explicit CrossSection(fem::Mesh<Dim> mesh, const std::string& friction_wall = {},
                        int points_per_direction = 3, Symmetry symmetry = Symmetry::translation);

  const fem::Mesh<Dim>& mesh() const { return mesh_; }
  Eigen::Index node_count() const { return static_cast<Eigen::Index>(mesh_.nodes.size()); }
  std::size_t element_count() const { return mesh_.elements.size(); }
  /// Inside an element.
  std::size_t points_per_element() const { return points_per_element_; }
  /// All quadrature points, those of an element together.
  const std::vector<Point>& points() const { return points_; }
  /// Where the points of an element are among all; those on its wall come last.
  auto points_of(std::size_t element) const {
    return std::views::iota(first_point_[element], first_point_[element + 1]);
  }

  LocalVelocities local_velocities(const solve::CompensatedVector& w, std::size_t element) const {
    const auto& nodes = mesh_.elements[element];
    LocalVelocities local{{}, w.long_value(nodes[interior])};
    for (int a = 0; a < nodes_per_element; ++a)
      local.relative[a] = w.difference(nodes[static_cast<std::size_t>(a)], nodes[interior]);
    return local;
  }
  /// grad w, or the slip, at every quadrature point.
  void gradients(const solve::CompensatedVector& w, std::vector<Vector>& g) const;
  /// Σ weight Gᵀτ at every node; zero at fixed nodes.
  Eigen::VectorXd internal_force(std::span<const Vector> stress) const;
  /// The same at fixed nodes only: what holds or drives them.
  Eigen::VectorXd reactions(std::span<const Vector> stress) const;
  /// ∫ f N at every node; zero at fixed nodes.
  Eigen::VectorXd load(const std::function<double(const Vector&)>& f) const;

  /// Assembles ∫ grad v · A grad w from symmetric point tangents and condenses interior nodes.
  void assemble(std::span<const Tangent> tangents);
  /// Solves the system last assembled; false if it is singular or the solution not finite.
  /// In more than one dimension with one step of refinement: the solution is compensated, so that
  /// differences in a stiff plug come out better than the factor alone could give them.
  bool solve(const Eigen::VectorXd& right_hand_side, solve::CompensatedVector& solution) const;
  /// The same without refinement, which would hide a small error of the factors.
  bool solve_once(const Eigen::VectorXd& right_hand_side, solve::CompensatedVector& solution) const;
  /// The product of the uncondensed matrix of these point tangents with x; zero at fixed nodes.
  Eigen::VectorXd product(std::span<const Tangent> tangents,
                          const solve::CompensatedVector& x) const;
  void clear_fixed(Eigen::VectorXd& values) const;
  /// Whether a fixed node has a velocity.
  bool has_moving_walls(const solve::CompensatedVector& w) const;
  double factor_entries() const { return skeleton_.factor_entries(); }

 private:
  void add_wall_points(const fem::Face& side, int points_per_direction);
  Eigen::VectorXd nodal_forces(std::span<const Vector> stress) const;

  fem::Mesh<Dim> mesh_;
  std::vector<Point> points_;
  std::vector<std::size_t> first_point_{0};  // of every element, and the end
  std::size_t points_per_element_ = 1;
  Skeleton<Dim> skeleton_;
  std::vector<NodalValues> interior_rows_;  // of the element matrices, divided by the pivot
  std::vector<double> interior_pivots_;
  std::vector<Tangent> tangents_;  // last assembled
  bool is_factored_ = false;
};

extern template class CrossSection<1>;
extern template class CrossSection<2>;

}  // namespace talus::shear
