// A limit on what SuiteSparse may allocate, for tests of what happens when memory runs out.
#pragma once

#include <cstdlib>

#include "common/solve/sparse_allocator.hpp"
#include "common/solve/sparse_libraries.hpp"

namespace talus::testing {

/// While it lives, blocks of more than `bytes` are refused. To be made after the solver that it is
/// to hit: preparing the libraries lifts it.
class AllocationLimit {
 public:
  explicit AllocationLimit(std::size_t bytes) {
    limit() = bytes;
    solve::set_sparse_allocator(
        [](std::size_t size) -> void* { return size > limit() ? nullptr : std::malloc(size); },
        [](std::size_t count, std::size_t size) -> void* {
          return count * size > limit() ? nullptr : std::calloc(count, size);
        },
        [](void* block, std::size_t size) -> void* {
          return size > limit() ? nullptr : std::realloc(block, size);
        });
  }
  ~AllocationLimit() { solve::prepare_sparse_libraries(); }
  AllocationLimit(const AllocationLimit&) = delete;
  AllocationLimit& operator=(const AllocationLimit&) = delete;

 private:
  static std::size_t& limit() {
    static std::size_t bytes = 0;
    return bytes;
  }
};

}  // namespace talus::testing
