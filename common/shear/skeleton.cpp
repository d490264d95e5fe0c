#include "common/shear/skeleton.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "common/solve/sparse_cholesky.hpp"

namespace talus::shear {

Skeleton<1>::Skeleton(const fem::Mesh<1>& mesh) : row_of_element_(mesh.elements.size()) {
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

struct Skeleton<2>::System {
  using Matrix = solve::SparseCholesky::Matrix;
  static constexpr int outer_nodes = 8;
  static constexpr int pairs = outer_nodes * outer_nodes;
  static constexpr Eigen::Index none = -1;

  std::vector<Eigen::Index> free_nodes;              // of every row
  Matrix matrix;                                     // lower triangle
  std::vector<std::array<Eigen::Index, pairs>> map;  // place of an element's entries in the values
  std::optional<solve::SparseCholesky> cholesky;
};

Skeleton<2>::~Skeleton() = default;
Skeleton<2>::Skeleton(Skeleton&&) noexcept = default;
Skeleton<2>& Skeleton<2>::operator=(Skeleton&&) noexcept = default;

Skeleton<2>::Skeleton(const fem::Mesh<2>& mesh) : system_(std::make_unique<System>()) {
  System& s = *system_;
  constexpr std::size_t middle = 4;
  std::vector<Eigen::Index> row(mesh.nodes.size(), System::none);
  for (const auto& element : mesh.elements)
    for (std::size_t a = 0; a < element.size(); ++a) {
      const auto node = static_cast<std::size_t>(element[a]);
      if (a == middle || mesh.fixed[node] || row[node] != System::none) continue;
      row[node] = static_cast<Eigen::Index>(s.free_nodes.size());
      s.free_nodes.push_back(element[a]);
    }
  const auto outer = [&](const auto& element, std::size_t a) {
    return row[static_cast<std::size_t>(element[a < middle ? a : a + 1])];
  };
  const auto for_each_entry = [&](std::size_t e, auto&& action) {
    for (std::size_t a = 0; a < System::outer_nodes; ++a)
      for (std::size_t b = 0; b < System::outer_nodes; ++b) {
        const Eigen::Index i = outer(mesh.elements[e], a), j = outer(mesh.elements[e], b);
        if (i != System::none && j != System::none && i >= j)
          action(a + System::outer_nodes * b, i, j);
      }
  };
  std::vector<Eigen::Triplet<double, System::Matrix::StorageIndex>> pattern;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for_each_entry(
        e, [&](std::size_t, Eigen::Index i, Eigen::Index j) { pattern.emplace_back(i, j, 0.0); });
  const auto size = static_cast<Eigen::Index>(s.free_nodes.size());
  s.matrix.resize(size, size);
  s.matrix.setFromTriplets(pattern.begin(), pattern.end());
  s.map.resize(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    s.map[e].fill(System::none);
    for_each_entry(e, [&](std::size_t place, Eigen::Index i, Eigen::Index j) {
      s.map[e][place] = &s.matrix.coeffRef(i, j) - s.matrix.valuePtr();
    });
  }
  s.cholesky.emplace(s.matrix);
}

void Skeleton<2>::set_zero() {
  std::fill_n(system_->matrix.valuePtr(), system_->matrix.nonZeros(), 0.0);
}

void Skeleton<2>::add(std::size_t element, const Eigen::Matrix<double, 8, 8>& matrix) {
  const auto& map = system_->map[element];
  for (std::size_t place = 0; place < map.size(); ++place)
    if (map[place] != System::none) system_->matrix.valuePtr()[map[place]] += matrix.data()[place];
}

bool Skeleton<2>::factor() {
  return system_->cholesky->factor(system_->matrix);
}

double Skeleton<2>::factor_entries() const {
  return system_->cholesky->factor_entries();
}

bool Skeleton<2>::solve(const Eigen::VectorXd& force, solve::CompensatedVector& velocity) const {
  Eigen::VectorXd b(system_->matrix.rows());
  for (Eigen::Index i = 0; i < b.size(); ++i)
    b[i] = force[system_->free_nodes[static_cast<std::size_t>(i)]];
  Eigen::VectorXd x;
  if (!system_->cholesky->solve(b, x)) return false;
  for (Eigen::Index i = 0; i < b.size(); ++i)
    velocity.set(system_->free_nodes[static_cast<std::size_t>(i)], x[i]);
  return true;
}

}  // namespace talus::shear
