// The linear system of velocity-pressure flow with everything inside elements condensed.
//
// Pressure and the velocity of the interior node are eliminated element by element, exactly: with
// l the local unknowns (interior velocity, pressure) and o the outer velocities of an element,
//   S = A_ll,  K = A_oo - A_ol S⁻¹ A_lo,  b = r_o - A_ol S⁻¹ r_l,  x_l = S⁻¹ (r_l - A_lo x_o).
// The penalty λp makes S regular. What is left is a velocity system on the edges of the elements.
#pragma once

#include <memory>
#include <vector>

#include "common/mixed/mixed_space.hpp"
#include "common/solve/sparse_lu.hpp"

namespace talus::mixed {

/// Tangents of `lanes` elements; velocity i of local node a at Dim a + i.
template <int Dim>
struct BatchTangent {
  static constexpr int velocities = Dim * MixedSpace<Dim>::nodes_per_element;
  static constexpr int pressures = MixedSpace<Dim>::pressures;
  std::array<std::array<Pack, velocities>, velocities> velocity_velocity;
  std::array<std::array<Pack, pressures>, velocities> velocity_pressure;
  std::array<std::array<Pack, velocities>, pressures> pressure_velocity;
  std::array<std::array<Pack, pressures>, pressures> pressure_pressure;
};

template <int Dim>
class CondensedSystem {
 public:
  using Space = MixedSpace<Dim>;

  /// `space` must outlive the system.
  explicit CondensedSystem(const Space& space);

  void set_zero();
  /// Condenses the tangents of a batch and adds what is left. Batches of one colour may be added at
  /// the same time.
  void add(std::size_t batch, const BatchTangent<Dim>& tangent);
  /// False if the condensed matrix is singular.
  bool factor();
  /// Solves for velocities and pressures, fixed velocities zero. False if the result is not finite.
  /// `refinements` are of the condensed system, with its own matrix: they take out the round-off
  /// of its factors, and no error of the condensing.
  bool solve(const Eigen::VectorXd& right_hand_side, Eigen::VectorXd& x, int refinements = 0) const;
  /// Sign of the determinant of the whole matrix, local unknowns included; 0 if singular.
  int determinant_sign() const;

  /// Condensed unknowns, and stored entries of the factors.
  Eigen::Index unknowns() const { return matrix_.rows(); }
  double factor_entries() const { return lu_ ? lu_->factor_entries() : 0; }
  /// Iterations with old factors that cost as much as new ones.
  double iterations_per_factorisation() const;

 private:
  static constexpr int outer = Dim * (Space::nodes_per_element - 1);
  static constexpr int local = Dim + Space::pressures;
  static constexpr int outer_nodes = Space::nodes_per_element - 1;
  struct LocalFactors {
    std::array<std::array<Pack, local>, local> inverse;   // S⁻¹
    std::array<std::array<Pack, outer>, local> to_local;  // S⁻¹ A_lo
    std::array<std::array<Pack, local>, outer> to_outer;  // A_ol S⁻¹
    int sign = 1;                                         // of det S, over all lanes
  };
  using LocalMatrix = std::array<std::array<Pack, local>, local>;
  using FromLocal = std::array<std::array<Pack, local>, outer>;  // A_ol
  using FromOuter = std::array<std::array<Pack, outer>, local>;  // A_lo
  void number_rows();
  void make_pattern();
  static void invert(std::size_t count, const LocalMatrix& matrix, LocalFactors& factors);
  static void split(const BatchTangent<Dim>& tangent, LocalMatrix& s, FromLocal& from_local,
                    FromOuter& from_outer);
  void scatter(std::size_t element, std::size_t column, std::size_t lane,
               const std::array<Pack, outer>& entries);

  const Space& space_;
  std::vector<Eigen::Index> row_of_velocity_;  // -1: fixed or interior
  std::vector<int> node_of_row_;
  solve::SparseLu::Matrix matrix_;
  std::vector<std::array<Eigen::Index, outer>> rows_;  // of an element's outer velocities
  // Of an element, [b][a]: where the rows of outer node a begin in the columns of outer node b.
  std::vector<std::array<std::array<int, outer_nodes>, outer_nodes>> places_;
  std::vector<LocalFactors> factors_;  // per batch
  std::unique_ptr<solve::SparseLu> lu_;
};

extern template class CondensedSystem<2>;
extern template class CondensedSystem<3>;

}  // namespace talus::mixed
