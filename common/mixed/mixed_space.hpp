// The finite-element space of velocity-pressure flow: continuous quadratic velocity, discontinuous
// linear pressure, in any dimension (Q9/P1, H27/P1).
//
// A state is one vector: the velocities of all nodes (component i of node n at Dim n + i), then the
// pressures of all elements (Dim + 1 coefficients each). Elements are worked on in batches, one a
// lane of the machine's vectors; a batch shares no node with another of its colour.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <experimental/simd>

#include "common/fem/geometry.hpp"
#include "common/mixed/boundary_condition.hpp"
#include "common/solve/carried_stress.hpp"
#include "common/solve/parallel.hpp"

namespace talus::mixed {

/// The same number of as many elements as the machine's vectors hold.
using Pack = std::experimental::native_simd<double>;
inline constexpr std::size_t lanes = Pack::size();
template <int Dim>
using PackVector = std::array<Pack, Dim>;
template <int Dim>
using PackTensor = std::array<std::array<Pack, Dim>, Dim>;

/// The stress τ that the primal-dual form carries at the quadrature points of a batch.
template <int Dim>
using CarriedStress = std::array<PackTensor<Dim>, fem::quadratic_nodes(Dim)>;

/// Linear pressure in physical coordinates {1, x - x_c, ...}, or in those of the reference element:
/// the latter loses an order on elements that are not parallelograms.
enum class PressureBasis { physical, mapped };

template <int Dim>
class MixedSpace {
 public:
  static constexpr int nodes_per_element = fem::quadratic_nodes(Dim);
  static constexpr int interior = (nodes_per_element - 1) / 2;  ///< the node inside an element
  static constexpr int points_per_element = fem::quadratic_nodes(Dim);
  static constexpr int pressures = Dim + 1;
  using Vector = fem::Point<Dim>;
  using PressureValues = Eigen::Matrix<double, Dim + 1, 1>;
  using State = solve::WithStress<std::vector<CarriedStress<Dim>>>;

  /// The geometry of `lanes` elements at one quadrature point.
  struct BatchPoint {
    Pack weight;  ///< quadrature weight times volume
    std::array<std::array<Pack, Dim>, Dim> inverse_jacobian;
    std::array<Pack, Dim> pressure_basis;  ///< beside the constant 1
    std::array<Pack, Dim> position;
  };
  struct Batch {
    std::array<std::size_t, lanes> elements{};  ///< the last one repeated in idle lanes
    std::size_t count = 0;                      ///< lanes in use
    std::array<BatchPoint, points_per_element> points;
  };

  /// Throws std::invalid_argument naming a boundary without a condition, a condition without
  /// boundary or two that contradict each other, and what checked() throws of a mesh.
  MixedSpace(fem::Mesh<Dim> mesh, BoundaryConditions<Dim> conditions,
             PressureBasis pressure_basis = PressureBasis::physical);

  const fem::Mesh<Dim>& mesh() const { return mesh_; }
  const BoundaryConditions<Dim>& conditions() const { return conditions_; }
  std::size_t element_count() const { return mesh_.elements.size(); }
  Eigen::Index velocity_count() const {
    return Dim * static_cast<Eigen::Index>(mesh_.nodes.size());
  }
  Eigen::Index size() const {
    return velocity_count() + pressures * static_cast<Eigen::Index>(element_count());
  }
  Eigen::Index velocity_index(Eigen::Index node, int component) const {
    return Dim * node + component;
  }
  Eigen::Index pressure_index(std::size_t element, int k) const {
    return velocity_count() + pressures * static_cast<Eigen::Index>(element) + k;
  }
  bool is_fixed(Eigen::Index velocity) const { return fixed_[static_cast<std::size_t>(velocity)]; }
  /// Sets the rows of prescribed velocities to zero.
  void clear_fixed(Eigen::VectorXd& values) const;

  const std::vector<Batch>& batches() const { return batches_; }
  /// Where each colour ends among the batches.
  const std::vector<std::size_t>& colour_ends() const { return colour_ends_; }
  /// Calls body(b) for every batch, colour by colour, those of a colour on several threads: body
  /// may add to what belongs to nodes or elements, and every sum keeps its order.
  template <class Body>
  void for_each_batch(const Body& body) const {
    constexpr std::size_t least = Dim == 3 ? 8 : 64;  // worth starting a thread for
    std::size_t first = 0;
    for (const std::size_t end : colour_ends_) {
      solve::parallel_for(first, end, least, body);
      first = end;
    }
  }
  /// Basis values and reference gradients at the quadrature points, the same in every element.
  const std::vector<fem::QuadraticBasis<Dim>>& bases() const { return bases_; }
  /// Sides with an open boundary, and whether their pressure is open too.
  struct OpenFace : fem::Face {
    bool keeps_pressure = true;
  };
  const std::vector<OpenFace>& open_faces() const { return open_faces_; }
  /// ∫ t N over the boundaries with a prescribed traction; zero at fixed velocities.
  const Eigen::VectorXd& traction_load() const { return traction_load_; }

  /// At rest, but for prescribed velocities.
  State start(solve::Precision precision = solve::Precision::compensated) const;

  /// Values of the pressure basis of an element: 1 and Dim linear functions.
  PressureValues pressure_basis(std::size_t element, const Vector& reference,
                                const Vector& position) const;
  /// Velocity, its gradient (grad_u(i, j) = ∂_j u_i) and pressure at a point of an element.
  struct Values {
    Vector position, velocity;
    Eigen::Matrix<double, Dim, Dim> velocity_gradient;
    double pressure = 0;
    double divergence() const { return velocity_gradient.trace(); }
    /// |γ| = sqrt(γ:γ/2), γ = grad u + grad uᵀ.
    double shear_rate() const {
      return (velocity_gradient + velocity_gradient.transpose()).norm() / std::sqrt(2.0);
    }
  };
  Values values_at(const solve::CompensatedVector& state, std::size_t element,
                   const Vector& reference) const;

 private:
  void constrain();
  void make_batches();

  fem::Mesh<Dim> mesh_;
  BoundaryConditions<Dim> conditions_;
  PressureBasis kind_;
  std::vector<bool> fixed_;
  std::vector<std::pair<Eigen::Index, double>> prescribed_;
  std::vector<OpenFace> open_faces_;
  Eigen::VectorXd traction_load_;
  std::vector<fem::QuadraticBasis<Dim>> bases_;
  std::vector<Batch> batches_;
  std::vector<std::size_t> colour_ends_;  // among the batches
};

extern template class MixedSpace<2>;
extern template class MixedSpace<3>;

}  // namespace talus::mixed
