#include "common/solve/sparse_libraries.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <malloc.h>
#include <omp.h>
#include <sys/mman.h>

#include "common/solve/memory.hpp"
#include "common/solve/sparse_allocator.hpp"

// Of OpenBLAS; null with any other BLAS.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);
extern "C" __attribute__((weak)) void dgemm_(const char*, const char*, const int*, const int*,
                                             const int*, const double*, const double*, const int*,
                                             const double*, const int*, const double*, double*,
                                             const int*);

namespace talus::solve {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21, large = 2 * huge_page;

// A wish: where the system has no huge pages, nothing changes.
void* on_huge_pages(void* block, std::size_t size) {
  if (!block || size < large) return block;
  const auto address = reinterpret_cast<std::uintptr_t>(block);
  const std::size_t before = (huge_page - address % huge_page) % huge_page;
  madvise(static_cast<char*>(block) + before, size - before, MADV_HUGEPAGE);
  return block;
}

std::size_t whole_pages(std::size_t size) {
  return (size + huge_page - 1) / huge_page * huge_page;
}

void* allocate(std::size_t size) {
  return size < large ? std::malloc(size)
                      : on_huge_pages(std::aligned_alloc(huge_page, whole_pages(size)), size);
}

void* reallocate(void* block, std::size_t size) {
  return on_huge_pages(std::realloc(block, size), size);
}

// What one factorisation frees the next asks for: only the largest blocks go back to the kernel,
// which would clear the pages of all others every time.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 1 << 25);  // the largest that it takes
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
}

// OpenBLAS takes its buffer at its first product, and waits for it for ever where there is no
// memory. It keeps it: so let it ask while there is.
void let_blas_have_its_buffer() {
  static const bool has_it = [] {
    constexpr double buffer = 1.2e8;
    require_memory("products of dense matrices", buffer);
    constexpr int n = 128;
    constexpr double one = 1, zero = 0;
    const std::vector<double> a(n * n, 1.0);
    std::vector<double> c(n * n);
    if (dgemm_) dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &zero, c.data(), &n);
    return true;
  }();
  static_cast<void>(has_it);
}

}  // namespace

void prepare_sparse_libraries() {
  keep_freed_memory();
  omp_set_max_active_levels(0);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  let_blas_have_its_buffer();
  set_sparse_allocator(allocate, std::calloc, reallocate);
  silence_sparse_libraries();
}

}  // namespace talus::solve
