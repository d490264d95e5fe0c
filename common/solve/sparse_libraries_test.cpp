#include "common/solve/sparse_libraries.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <utility>

#include <Eigen/CholmodSupport>
#include <boost/test/unit_test.hpp>
#include <omp.h>
#include <unistd.h>

BOOST_AUTO_TEST_SUITE(sparse_libraries_test)

// Of OpenBLAS; null with any other BLAS.
extern "C" __attribute__((weak)) int openblas_get_num_threads();
extern "C" __attribute__((weak)) void openblas_set_num_threads(int);

using namespace talus::solve;

BOOST_AUTO_TEST_CASE(libraries_stay_on_one_thread_once_told_to) {
  if (openblas_set_num_threads) openblas_set_num_threads(2);
  omp_set_max_active_levels(1);
  prepare_sparse_libraries();
  BOOST_TEST(omp_get_max_active_levels() == 0);  // no parallel region is active, all run as one
  if (openblas_get_num_threads) BOOST_TEST(openblas_get_num_threads() == 1);
}

BOOST_AUTO_TEST_CASE(large_blocks_begin_with_a_huge_page_and_keep_what_is_in_them) {
  prepare_sparse_libraries();
  constexpr std::size_t small = 1000, large = (std::size_t{1} << 23) + 12345;
  auto* block = static_cast<unsigned char*>(SuiteSparse_malloc(large, 1));
  BOOST_REQUIRE(block != nullptr);
  BOOST_TEST(reinterpret_cast<std::uintptr_t>(block) % (std::size_t{1} << 21) == 0U);
  for (std::size_t i = 0; i < large; ++i) block[i] = static_cast<unsigned char>(i % 251);
  int ok = 0;
  std::size_t last = large;
  for (const std::size_t size : {3 * large, large, small}) {
    block = static_cast<unsigned char*>(
        SuiteSparse_realloc(size, std::exchange(last, size), 1, block, &ok));
    BOOST_REQUIRE(ok);
    std::size_t changed = 0;
    for (std::size_t i = 0; i < std::min(size, large); ++i) changed += block[i] != i % 251;
    BOOST_TEST(changed == 0U);
  }
  SuiteSparse_free(block);
}

BOOST_AUTO_TEST_CASE(a_factorisation_that_fails_prints_nothing) {
  prepare_sparse_libraries();
  Eigen::SparseMatrix<double> indefinite(2, 2);
  indefinite.insert(0, 0) = 1;
  indefinite.insert(1, 1) = -1;
  std::fflush(stdout);
  std::FILE* const captured = std::tmpfile();
  BOOST_REQUIRE(captured != nullptr);
  const int own = dup(STDOUT_FILENO);
  dup2(fileno(captured), STDOUT_FILENO);
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> cholesky(indefinite);
  std::fflush(stdout);
  dup2(own, STDOUT_FILENO);
  close(own);
  BOOST_TEST((cholesky.info() != Eigen::Success));
  BOOST_TEST(lseek(fileno(captured), 0, SEEK_END) == 0);
  std::fclose(captured);
}

BOOST_AUTO_TEST_SUITE_END()
