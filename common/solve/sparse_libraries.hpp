// What SuiteSparse is told before it factors.
#pragma once

namespace talus::solve {

/// Prepares the process for sparse factorisations; to be called before the first, and again at
/// will.
/// - OpenBLAS and OpenMP stay on the calling thread. CHOLMOD asks for four threads whatever
///   OMP_NUM_THREADS says, OpenBLAS for all there are: for blocks as small as these they cost more
///   than they share out, and idle ones burn a core waiting.
/// - Large blocks of SuiteSparse lie on pages of 2 MB where the system has them. Factors are
///   allocated anew by every factorisation, and on pages of 4 kB the kernel takes a tenth of its
///   time to hand them out.
/// - Memory that is freed stays with the process, up to 1 GB, for the next factorisation.
/// - OpenBLAS gets its buffer. Throws OutOfMemory if there is none.
/// - SuiteSparse prints nothing: what becomes of a factorisation is asked for, and stdout is the
///   programs' own.
void prepare_sparse_libraries();

}  // namespace talus::solve
