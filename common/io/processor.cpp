// Compiled for any processor of the family, whatever the rest is compiled for.
#include "common/io/processor.hpp"

#include <unistd.h>

namespace talus::io {
namespace {

constexpr char complaint[] =
    "This build needs a processor with AVX2 and FMA, and this one has not both. Build it here: "
    "rm -r build, then ./run; or configure with -D TALUS_ARCHITECTURE=baseline.\n";

// Before the initialisation of what is static elsewhere, which may use vectors.
__attribute__((constructor(101))) void require_processor_first() {
  require_processor();
}

}  // namespace

void require_processor() {
#ifdef TALUS_NEEDS_AVX2
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, complaint, sizeof complaint - 1);
  _exit(1);
#else
  static_cast<void>(complaint);
#endif
}

}  // namespace talus::io
