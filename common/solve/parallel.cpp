#include "common/solve/parallel.hpp"

#include <omp.h>

// Of OpenBLAS; null with any other BLAS.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

namespace talus::solve {
namespace {

int thread_count = 1;

}  // namespace

int threads() {
  return thread_count;
}

void set_threads(int count) {
  thread_count = std::max(1, count);
}

void keep_libraries_on_one_thread() {
  omp_set_max_active_levels(0);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

}  // namespace talus::solve
