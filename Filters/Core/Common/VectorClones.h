// SPDX-License-Identifier: BSD-3-Clause
#ifndef freespace_VectorClones_h
#define freespace_VectorClones_h

/// FREESPACE_VECTOR_CLONES stands before a function whose loops gain from wide registers: it is
/// compiled once more for processors with AVX2, and the loader selects the version that the machine supports.
/// The results are bitwise the same: AVX2 has no fused multiplications. What such a
/// function calls must be FREESPACE_INLINE to gain as well.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__linux__) &&       \
  defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FREESPACE_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define FREESPACE_VECTOR_CLONES
#endif

/// FREESPACE_PREFETCH loads an address into the cache before it is read.
#if defined(__GNUC__)
#define FREESPACE_PREFETCH(address) __builtin_prefetch(address)
#else
#define FREESPACE_PREFETCH(address)
#endif

#if defined(__GNUC__)
#define FREESPACE_INLINE inline __attribute__((always_inline))
#else
#define FREESPACE_INLINE inline
#endif

#endif
