// The linear system of velocity-pressure flow with everything inside elements condensed.
//
// Pressure and the velocity of the interior node are eliminated element by element, exactly: with
// l the local unknowns (interior velocity, pressure) and o the outer velocities of an element,
//   S = A_ll,  K = A_oo - A_ol S⁻¹ A_lo,  b = r_o - A_ol S⁻¹ r_l,  x_l = S⁻¹ (r_l - A_lo x_o).
// The penalty λp makes S regular. What is left is a velocity system on the edges of the elements.
#pragma once

#include <memory>
#include <vector>

#include "common/flow/dense_space.hpp"
#include "common/solve/sparse_lu.hpp"

namespace talus::flow {

/// Tangents of `lanes` elements; velocity i of local node a at Dim a + i.
template <int Dim>
struct BatchTangent {
  static constexpr int velocities = Dim * DenseSpace<Dim>::nodes_per_element;
  static constexpr int pressures = DenseSpace<Dim>::pressures;
  std::array<std::array<Pack, velocities>, velocities> velocity_velocity;
  std::array<std::array<Pack, pressures>, velocities> velocity_pressure;
  std::array<std::array<Pack, velocities>, pressures> pressure_velocity;
  std::array<std::array<Pack, pressures>, pressures> pressure_pressure;
};

template <int Dim>
class CondensedSystem {
 public:
  using Space = DenseSpace<Dim>;

  /// `space` must outlive the system.
  explicit CondensedSystem(const Space& space);

  void set_zero();
  /// Condenses the tangents of a batch and adds what is left; destroys `tangent`.
  void add(std::size_t batch, BatchTangent<Dim>& tangent);
  /// False if the condensed matrix is singular.
  bool factor();
  /// Solves for velocities and pressures, fixed velocities zero. False if the result is not finite.
  bool solve(const Eigen::VectorXd& right_hand_side, Eigen::VectorXd& x) const;
  /// Sign of the determinant of the whole matrix, local unknowns included; 0 if singular.
  int determinant_sign() const { return local_sign_ * (lu_ ? lu_->determinant_sign() : 0); }

  /// Condensed unknowns, and stored entries of the factors.
  Eigen::Index unknowns() const { return matrix_.rows(); }
  double factor_entries() const { return lu_ ? lu_->factor_entries() : 0; }

 private:
  static constexpr int outer = Dim * (Space::nodes_per_element - 1);
  static constexpr int local = Dim + Space::pressures;
  struct LocalFactors {
    std::array<std::array<Pack, local>, local> inverse;   // S⁻¹
    std::array<std::array<Pack, outer>, local> to_local;  // S⁻¹ A_lo
    std::array<std::array<Pack, local>, outer> to_outer;  // A_ol S⁻¹
  };
  void number_rows();
  void make_pattern();
  Pack invert(std::size_t count, const std::array<std::array<Pack, local>, local>& matrix,
              LocalFactors& factors);

  const Space& space_;
  std::vector<int> row_of_velocity_;  // -1: fixed or interior
  std::vector<int> node_of_row_;
  solve::SparseLu::Matrix matrix_;
  std::vector<std::array<int, static_cast<std::size_t>(outer) * outer>> map_;  // per element
  std::vector<LocalFactors> factors_;                                          // per batch
  std::unique_ptr<solve::SparseLu> lu_;
  int local_sign_ = 1;
};

extern template class CondensedSystem<2>;
extern template class CondensedSystem<3>;

}  // namespace talus::flow
