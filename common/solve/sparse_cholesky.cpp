#include "common/solve/sparse_cholesky.hpp"

#include <stdexcept>
#include <string>

#include <cholmod.h>

#include "common/solve/memory.hpp"
#include "common/solve/sparse_libraries.hpp"

namespace talus::solve {
namespace {

cholmod_sparse view_of(const SparseCholesky::Matrix& lower) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(lower.rows());
  view.nzmax = static_cast<std::size_t>(lower.nonZeros());
  view.p = const_cast<std::int64_t*>(lower.outerIndexPtr());
  view.i = const_cast<std::int64_t*>(lower.innerIndexPtr());
  view.x = const_cast<double*>(lower.valuePtr());
  view.stype = -1;  // lower triangle
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.sorted = view.packed = 1;
  return view;
}

}  // namespace

struct SparseCholesky::Factors {
  mutable cholmod_common common;
  cholmod_factor* factor = nullptr;

  Factors() {
    cholmod_l_start(&common);
    common.final_asis = 1;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.print = 0;  // its status says it all
  }
  ~Factors() {
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }
  Factors(const Factors&) = delete;
  Factors& operator=(const Factors&) = delete;

  // Values of the factor, and half as much again for what is done on the way.
  double memory() const {
    return 1.5 * sizeof(double) * static_cast<double>(factor ? factor->xsize : 0);
  }
  // What is not the matrix's fault.
  void check_status() const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE)
      throw OutOfMemory("factors of " + std::to_string(factor ? factor->n : 0) + " unknowns",
                        std::max(memory(), static_cast<double>(common.memory_usage)));
    if (common.status < CHOLMOD_OK)
      throw std::runtime_error("CHOLMOD failed with status " + std::to_string(common.status));
  }
};

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

SparseCholesky::SparseCholesky(const Matrix& lower_triangle) {
  prepare_sparse_libraries();
  factors_ = std::make_unique<Factors>();
  cholmod_sparse view = view_of(lower_triangle);
  factors_->factor = cholmod_l_analyze(&view, &factors_->common);
  factors_->check_status();
  require_memory("factors of " + std::to_string(lower_triangle.rows()) + " unknowns",
                 factors_->memory());
}

bool SparseCholesky::factor(const Matrix& lower_triangle) {
  Factors& f = *factors_;
  cholmod_sparse view = view_of(lower_triangle);
  double no_shift[2] = {0, 0};
  cholmod_l_factorize_p(&view, no_shift, nullptr, 0, f.factor, &f.common);
  f.check_status();
  return f.factor->minor == f.factor->n;
}

bool SparseCholesky::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) const {
  const Factors& f = *factors_;
  if (f.factor->xtype == CHOLMOD_PATTERN || f.factor->minor < f.factor->n) return false;
  cholmod_dense view{};
  view.nrow = view.nzmax = view.d = static_cast<std::size_t>(b.size());
  view.ncol = 1;
  view.x = const_cast<double*>(b.data());
  view.xtype = CHOLMOD_REAL;
  cholmod_dense* solution = cholmod_l_solve(CHOLMOD_A, f.factor, &view, &f.common);
  f.check_status();
  if (!solution) return false;
  x = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(solution->x), b.size());
  cholmod_l_free_dense(&solution, &f.common);
  return x.allFinite();
}

double SparseCholesky::factor_entries() const {
  return factors_->common.lnz;
}

}  // namespace talus::solve
