#include "common/solve/tridiagonal.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>

namespace talus::solve {
namespace {

gsl_vector_const_view view(const Eigen::VectorXd& v) {
  return gsl_vector_const_view_array(v.data(), static_cast<std::size_t>(v.size()));
}

}  // namespace

bool solve_tridiagonal(const TridiagonalMatrix& matrix, const Eigen::VectorXd& b,
                       Eigen::VectorXd& x) {
  const Eigen::Index n = matrix.diagonal.size();
  x.resize(n);
  if (n == 1) {  // GSL views cannot be empty
    x[0] = b[0] / matrix.diagonal[0];
    return x.allFinite();
  }
  // GSL's default handler aborts the program on a zero pivot.
  gsl_error_handler_t* const previous = gsl_set_error_handler_off();
  const gsl_vector_const_view diagonal = view(matrix.diagonal);
  const gsl_vector_const_view off_diagonal = view(matrix.off_diagonal);
  const gsl_vector_const_view right = view(b);
  gsl_vector_view solution = gsl_vector_view_array(x.data(), static_cast<std::size_t>(n));
  const int status = gsl_linalg_solve_symm_tridiag(&diagonal.vector, &off_diagonal.vector,
                                                   &right.vector, &solution.vector);
  gsl_set_error_handler(previous);
  return status == GSL_SUCCESS && x.allFinite();
}

}  // namespace talus::solve
