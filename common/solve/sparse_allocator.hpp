// Whom SuiteSparse asks for memory: a struct of its version 5, functions from version 6 on.
#pragma once

#include <cstddef>

#include <SuiteSparse_config.h>

namespace talus::solve {

using Allocate = void* (*)(std::size_t size);
using AllocateZeros = void* (*)(std::size_t count, std::size_t size);
using Reallocate = void* (*)(void* block, std::size_t size);

/// From now on, in the whole process. Blocks are freed by std::free.
inline void set_sparse_allocator(Allocate allocate, AllocateZeros allocate_zeros,
                                 Reallocate reallocate) {
#if SUITESPARSE_MAIN_VERSION < 6
  SuiteSparse_config.malloc_func = allocate;
  SuiteSparse_config.calloc_func = allocate_zeros;
  SuiteSparse_config.realloc_func = reallocate;
#else
  SuiteSparse_config_malloc_func_set(allocate);
  SuiteSparse_config_calloc_func_set(allocate_zeros);
  SuiteSparse_config_realloc_func_set(reallocate);
#endif
}

/// Its warnings are not for the user of a program.
inline void silence_sparse_libraries() {
#if SUITESPARSE_MAIN_VERSION < 6
  SuiteSparse_config.printf_func = nullptr;
#else
  SuiteSparse_config_printf_func_set(nullptr);
#endif
}

}  // namespace talus::solve
