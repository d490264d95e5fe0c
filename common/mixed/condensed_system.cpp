#include "common/mixed/condensed_system.hpp"

#include <algorithm>

#include <Eigen/LU>

namespace talus::mixed {
namespace {

// Places of the outer and of the interior velocities of an element among all of them.
template <int Dim>
constexpr std::size_t outer_place(std::size_t o) {
  constexpr auto first_interior = static_cast<std::size_t>(Dim * MixedSpace<Dim>::interior);
  return o < first_interior ? o : o + Dim;
}
template <int Dim>
constexpr std::size_t interior_place(std::size_t i) {
  return static_cast<std::size_t>(Dim * MixedSpace<Dim>::interior) + i;
}

}  // namespace

template <int Dim>
CondensedSystem<Dim>::CondensedSystem(const Space& space)
    : space_(space), factors_(space.batches().size()) {
  number_rows();
  make_pattern();
  lu_ = std::make_unique<solve::SparseLu>(matrix_, node_of_row_);
}

template <int Dim>
void CondensedSystem<Dim>::number_rows() {
  const auto& mesh = space_.mesh();
  std::vector<bool> is_interior(mesh.nodes.size(), false);
  for (const auto& element : mesh.elements)
    is_interior[static_cast<std::size_t>(element[Space::interior])] = true;
  row_of_velocity_.assign(static_cast<std::size_t>(space_.velocity_count()), -1);
  int groups = 0;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (is_interior[node]) continue;
    bool has_rows = false;
    for (int i = 0; i < Dim; ++i) {
      const auto v = space_.velocity_index(static_cast<Eigen::Index>(node), i);
      if (space_.is_fixed(v)) continue;
      row_of_velocity_[static_cast<std::size_t>(v)] =
          static_cast<Eigen::Index>(node_of_row_.size());
      node_of_row_.push_back(groups);
      has_rows = true;
    }
    if (has_rows) ++groups;
  }
}

template <int Dim>
void CondensedSystem<Dim>::make_pattern() {
  const auto& mesh = space_.mesh();
  const auto size = static_cast<Eigen::Index>(node_of_row_.size());
  rows_.resize(mesh.elements.size());
  std::vector<std::vector<std::size_t>> elements_of(static_cast<std::size_t>(size));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t o = 0; o < outer; ++o) {
      const std::size_t place = outer_place<Dim>(o);
      const Eigen::Index node = mesh.elements[e][place / Dim];
      const Eigen::Index row = row_of_velocity_[static_cast<std::size_t>(
          space_.velocity_index(node, static_cast<int>(place % Dim)))];
      rows_[e][o] = row;
      if (row >= 0) elements_of[static_cast<std::size_t>(row)].push_back(e);
    }
  std::vector<Eigen::Index> starts{0}, indices, column;
  for (Eigen::Index j = 0; j < size; ++j) {
    column.clear();
    for (const std::size_t e : elements_of[static_cast<std::size_t>(j)])
      for (const Eigen::Index row : rows_[e])
        if (row >= 0) column.push_back(row);
    std::ranges::sort(column);
    column.erase(std::ranges::unique(column).begin(), column.end());
    indices.insert(indices.end(), column.begin(), column.end());
    starts.push_back(static_cast<Eigen::Index>(indices.size()));
  }
  const std::vector<double> zeros(indices.size(), 0.0);
  matrix_ = Eigen::Map<const solve::SparseLu::Matrix>(size, size, starts.back(), starts.data(),
                                                      indices.data(), zeros.data());
  const auto first_row = [](const std::array<Eigen::Index, outer>& rows, std::size_t node) {
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(Dim * node);
    const auto found = std::find_if(first, first + Dim, [](Eigen::Index row) { return row >= 0; });
    return found == first + Dim ? Eigen::Index{-1} : *found;
  };
  places_.resize(mesh.elements.size());
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t b = 0; b < outer_nodes; ++b) {
      const Eigen::Index j = first_row(rows_[e], b);
      if (j < 0) continue;
      const auto first = indices.begin() + starts[static_cast<std::size_t>(j)];
      const auto last = indices.begin() + starts[static_cast<std::size_t>(j) + 1];
      for (std::size_t a = 0; a < outer_nodes; ++a)
        places_[e][b][a] =
            static_cast<int>(std::lower_bound(first, last, first_row(rows_[e], a)) - first);
    }
}

template <int Dim>
void CondensedSystem<Dim>::set_zero() {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
}

// Inverts S lane by lane, with pivoting.
template <int Dim>
void CondensedSystem<Dim>::invert(std::size_t count, const LocalMatrix& matrix,
                                  LocalFactors& factors) {
  using Local = Eigen::Matrix<double, local, local>;
  factors.sign = 1;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    Local s = Local::Identity();
    if (lane < count)
      for (int i = 0; i < local; ++i)
        for (int j = 0; j < local; ++j)
          s(i, j) = matrix[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)][lane];
    const Eigen::PartialPivLU<Local> lu(s);
    const Local inverse = lu.inverse();
    const double determinant = lu.determinant();
    factors.sign *= determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
    for (int i = 0; i < local; ++i)
      for (int j = 0; j < local; ++j)
        factors.inverse[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)][lane] =
            inverse(i, j);
  }
}

template <int Dim>
void CondensedSystem<Dim>::split(const BatchTangent<Dim>& tangent, LocalMatrix& s,
                                 FromLocal& from_local, FromOuter& from_outer) {
  for (std::size_t i = 0; i < Dim; ++i) {
    const std::size_t at = interior_place<Dim>(i);
    for (std::size_t j = 0; j < Dim; ++j)
      s[i][j] = tangent.velocity_velocity[at][interior_place<Dim>(j)];
    for (std::size_t k = 0; k < Space::pressures; ++k) {
      s[i][Dim + k] = tangent.velocity_pressure[at][k];
      s[Dim + k][i] = tangent.pressure_velocity[k][at];
    }
    for (std::size_t o = 0; o < outer; ++o) {
      from_local[o][i] = tangent.velocity_velocity[outer_place<Dim>(o)][at];
      from_outer[i][o] = tangent.velocity_velocity[at][outer_place<Dim>(o)];
    }
  }
  for (std::size_t k = 0; k < Space::pressures; ++k) {
    for (std::size_t l = 0; l < Space::pressures; ++l)
      s[Dim + k][Dim + l] = tangent.pressure_pressure[k][l];
    for (std::size_t o = 0; o < outer; ++o) {
      from_local[o][Dim + k] = tangent.velocity_pressure[outer_place<Dim>(o)][k];
      from_outer[Dim + k][o] = tangent.pressure_velocity[k][outer_place<Dim>(o)];
    }
  }
}

template <int Dim>
void CondensedSystem<Dim>::add(std::size_t number, const BatchTangent<Dim>& tangent) {
  const auto& batch = space_.batches()[number];
  LocalFactors& f = factors_[number];
  LocalMatrix s;
  FromLocal from_local;
  FromOuter from_outer;
  split(tangent, s, from_local, from_outer);
  invert(batch.count, s, f);
  for (std::size_t i = 0; i < local; ++i)
    for (std::size_t o = 0; o < outer; ++o) {
      Pack forward = 0, back = 0;
      for (std::size_t j = 0; j < local; ++j) {
        forward += f.inverse[i][j] * from_outer[j][o];
        back += from_local[o][j] * f.inverse[j][i];
      }
      f.to_local[i][o] = forward;
      f.to_outer[o][i] = back;
    }
  std::array<Pack, outer> entries;
  for (std::size_t c = 0; c < outer; ++c) {
    for (std::size_t r = 0; r < outer; ++r) {
      Pack entry = tangent.velocity_velocity[outer_place<Dim>(r)][outer_place<Dim>(c)];
      for (std::size_t j = 0; j < local; ++j) entry -= from_local[r][j] * f.to_local[j][c];
      entries[r] = entry;
    }
    for (std::size_t lane = 0; lane < batch.count; ++lane)
      scatter(batch.elements[lane], c, lane, entries);
  }
}

// Adds to one column of the matrix; the rows of a node follow each other there.
template <int Dim>
void CondensedSystem<Dim>::scatter(std::size_t element, std::size_t column, std::size_t lane,
                                   const std::array<Pack, outer>& entries) {
  const auto& rows = rows_[element];
  if (rows[column] < 0) return;
  double* const values = matrix_.valuePtr() + matrix_.outerIndexPtr()[rows[column]];
  const auto& places = places_[element][column / Dim];
  for (std::size_t a = 0; a < outer_nodes; ++a) {
    double* value = values + places[a];
    for (std::size_t r = Dim * a; r < Dim * (a + 1); ++r)
      if (rows[r] >= 0) *value++ += entries[r][lane];
  }
}

template <int Dim>
int CondensedSystem<Dim>::determinant_sign() const {
  int sign = lu_->determinant_sign();
  for (const LocalFactors& each : factors_) sign *= each.sign;
  return sign;
}

// An iteration is a solve and a product with the tangent.
template <int Dim>
double CondensedSystem<Dim>::iterations_per_factorisation() const {
  constexpr double product_over_solve = 3;  // an entry of the one over one of the other; measured
  const double share = static_cast<double>(matrix_.nonZeros()) / lu_->factor_entries();
  return lu_->solves_per_factorisation() / (1 + product_over_solve * share);
}

template <int Dim>
bool CondensedSystem<Dim>::factor() {
  return lu_->factor(matrix_);
}

template <int Dim>
bool CondensedSystem<Dim>::solve(const Eigen::VectorXd& right_hand_side, Eigen::VectorXd& x,
                                 int refinements) const {
  const auto& mesh = space_.mesh();
  const auto velocity = [&](std::size_t e, std::size_t place) {
    return space_.velocity_index(mesh.elements[e][place / Dim], static_cast<int>(place % Dim));
  };
  const auto local_index = [&](std::size_t e, std::size_t l) {
    return l < Dim ? velocity(e, interior_place<Dim>(l))
                   : space_.pressure_index(e, static_cast<int>(l - Dim));
  };
  Eigen::VectorXd b = Eigen::VectorXd::Zero(matrix_.rows()), outer_x;
  for (std::size_t v = 0; v < row_of_velocity_.size(); ++v)
    if (row_of_velocity_[v] >= 0)
      b[row_of_velocity_[v]] = right_hand_side[static_cast<Eigen::Index>(v)];
  for (std::size_t number = 0; number < factors_.size(); ++number) {
    const auto& batch = space_.batches()[number];
    for (std::size_t lane = 0; lane < batch.count; ++lane) {
      const std::size_t e = batch.elements[lane];
      for (std::size_t o = 0; o < outer; ++o) {
        const Eigen::Index row =
            row_of_velocity_[static_cast<std::size_t>(velocity(e, outer_place<Dim>(o)))];
        if (row < 0) continue;
        for (std::size_t l = 0; l < local; ++l)
          b[row] -= factors_[number].to_outer[o][l][lane] * right_hand_side[local_index(e, l)];
      }
    }
  }
  if (!lu_->solve(b, outer_x)) return false;
  for (int i = 0; i < refinements; ++i) {
    Eigen::VectorXd correction;
    if (!lu_->solve(b - matrix_ * outer_x, correction)) return false;
    outer_x += correction;
  }
  x = Eigen::VectorXd::Zero(space_.size());
  for (std::size_t v = 0; v < row_of_velocity_.size(); ++v)
    if (row_of_velocity_[v] >= 0) x[static_cast<Eigen::Index>(v)] = outer_x[row_of_velocity_[v]];
  for (std::size_t number = 0; number < factors_.size(); ++number) {
    const auto& batch = space_.batches()[number];
    const LocalFactors& f = factors_[number];
    for (std::size_t lane = 0; lane < batch.count; ++lane) {
      const std::size_t e = batch.elements[lane];
      for (std::size_t l = 0; l < local; ++l) {
        double value = 0;
        for (std::size_t m = 0; m < local; ++m)
          value += f.inverse[l][m][lane] * right_hand_side[local_index(e, m)];
        for (std::size_t o = 0; o < outer; ++o)
          value -= f.to_local[l][o][lane] * x[velocity(e, outer_place<Dim>(o))];
        x[local_index(e, l)] = value;
      }
    }
  }
  return x.allFinite();
}

template class CondensedSystem<2>;
template class CondensedSystem<3>;

}  // namespace talus::mixed
