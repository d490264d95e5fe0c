#include "common/solve/sparse_libraries.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <SuiteSparse_config.h>
#include <omp.h>
#include <sys/mman.h>

// Of OpenBLAS; null with any other BLAS.
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

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

}  // namespace

void prepare_sparse_libraries() {
  omp_set_max_active_levels(0);
  if (openblas_set_num_threads) openblas_set_num_threads(1);
  SuiteSparse_config.malloc_func = allocate;
  SuiteSparse_config.realloc_func = reallocate;
  SuiteSparse_config.printf_func = nullptr;
}

}  // namespace talus::solve
