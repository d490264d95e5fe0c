#include "common/solve/sparse_lu.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include <cholmod.h>
#include <umfpack.h>

#include "common/solve/sparse_libraries.hpp"

namespace talus::solve {
namespace {

// Nested dissection of the node graph; permutation[k] is the node eliminated k-th.
std::vector<int> dissect(const SparseLu::Matrix& pattern, const std::vector<int>& node_of_row,
                         int nodes) {
  std::vector<Eigen::Triplet<double, int>> edges;
  edges.reserve(static_cast<std::size_t>(pattern.nonZeros()) / 2);
  int last_row = -1, last_column = -1;
  for (int column = 0; column < pattern.outerSize(); ++column)
    for (SparseLu::Matrix::InnerIterator entry(pattern, column); entry; ++entry) {
      const int i = node_of_row[static_cast<std::size_t>(entry.row())];
      const int j = node_of_row[static_cast<std::size_t>(column)];
      if (i > j || (i == last_row && j == last_column)) continue;
      edges.emplace_back(last_row = i, last_column = j, 1.0);
    }
  SparseLu::Matrix graph(nodes, nodes);
  graph.setFromTriplets(edges.begin(), edges.end());

  cholmod_common common;
  cholmod_start(&common);
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(nodes);
  view.nzmax = static_cast<std::size_t>(graph.nonZeros());
  view.p = graph.outerIndexPtr();
  view.i = graph.innerIndexPtr();
  view.stype = 1;  // upper triangle
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_PATTERN;
  view.sorted = view.packed = 1;
  std::vector<int> permutation(static_cast<std::size_t>(nodes));
  // METIS separators, minimum degree within the parts: a tenth fewer operations than METIS alone.
  std::vector<int> parents(permutation.size()), members(permutation.size());
  const auto components = cholmod_nested_dissection(&view, nullptr, 0, permutation.data(),
                                                    parents.data(), members.data(), &common);
  cholmod_finish(&common);
  if (components < 0) std::iota(permutation.begin(), permutation.end(), 0);
  return permutation;
}

}  // namespace

struct SparseLu::Factors {
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};
  void* symbolic = nullptr;
  void* numeric = nullptr;
  const Matrix* matrix = nullptr;

  Factors() {
    umfpack_di_defaults(control.data());
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    // A pivot off the diagonal breaks the order and fills the factors: with the default of 1e-3
    // they cost 2.5 times the operations on the heap. What small pivots lose, refinement gets back.
    control[UMFPACK_SYM_PIVOT_TOLERANCE] = 1e-6;
    control[UMFPACK_IRSTEP] = 0;  // refinement is done with the residual of the whole problem
  }
  ~Factors() {
    umfpack_di_free_numeric(&numeric);
    umfpack_di_free_symbolic(&symbolic);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;
};

SparseLu::~SparseLu() = default;
SparseLu::SparseLu(SparseLu&&) noexcept = default;
SparseLu& SparseLu::operator=(SparseLu&&) noexcept = default;

SparseLu::SparseLu(const Matrix& pattern, const std::vector<int>& node_of_row)
    : factors_(std::make_unique<Factors>()) {
  prepare_sparse_libraries();
  const int nodes = node_of_row.empty() ? 0 : *std::ranges::max_element(node_of_row) + 1;
  std::vector<std::vector<int>> rows_of(static_cast<std::size_t>(nodes));
  for (std::size_t row = 0; row < node_of_row.size(); ++row)
    rows_of[static_cast<std::size_t>(node_of_row[row])].push_back(static_cast<int>(row));
  std::vector<int> order;
  for (const int node : dissect(pattern, node_of_row, nodes))
    for (const int row : rows_of[static_cast<std::size_t>(node)]) order.push_back(row);
  const auto size = static_cast<int>(pattern.rows());
  const int status = umfpack_di_qsymbolic(
      size, size, pattern.outerIndexPtr(), pattern.innerIndexPtr(), nullptr, order.data(),
      &factors_->symbolic, factors_->control.data(), factors_->info.data());
  if (status != UMFPACK_OK)
    throw std::runtime_error("the sparse system could not be analysed (UMFPACK status " +
                             std::to_string(status) + ")");
}

bool SparseLu::factor(const Matrix& matrix) {
  Factors& f = *factors_;
  umfpack_di_free_numeric(&f.numeric);
  f.matrix = &matrix;
  const int status =
      umfpack_di_numeric(matrix.outerIndexPtr(), matrix.innerIndexPtr(), matrix.valuePtr(),
                         f.symbolic, &f.numeric, f.control.data(), f.info.data());
  return status == UMFPACK_OK;
}

bool SparseLu::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  const Factors& f = *factors_;
  if (!f.numeric) return false;
  x.resize(b.size());
  std::array<double, UMFPACK_INFO> info{};
  const int status = umfpack_di_solve(UMFPACK_A, f.matrix->outerIndexPtr(),
                                      f.matrix->innerIndexPtr(), f.matrix->valuePtr(), x.data(),
                                      b.data(), f.numeric, f.control.data(), info.data());
  return status == UMFPACK_OK && x.allFinite();
}

int SparseLu::determinant_sign() const {
  if (!factors_->numeric) return 0;
  double mantissa = 0, exponent = 0;
  std::array<double, UMFPACK_INFO> info{};
  umfpack_di_get_determinant(&mantissa, &exponent, factors_->numeric, info.data());
  return mantissa > 0 ? 1 : mantissa < 0 ? -1 : 0;
}

double SparseLu::factor_entries() const {
  if (!factors_->numeric) return 0;
  return factors_->info[UMFPACK_LNZ] + factors_->info[UMFPACK_UNZ];
}

double SparseLu::solves_per_factorisation() const {
  // Measured: what is done once an entry costs 22 solves, the products of dense blocks in cache 50
  // times less an operation than the memory that a solve reads.
  return 22 + factors_->info[UMFPACK_FLOPS] / (50 * factor_entries());
}

}  // namespace talus::solve
