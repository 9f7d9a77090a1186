#pragma once
// Functions of the kernels' bodies.

/// A body that is inlined into its caller and takes that caller's instruction set; on a device too.
#define TREAD_INLINE [[gnu::always_inline]] constexpr inline

/// A body that is too long for that, or calls functions that are not constexpr.
#if defined(__CUDACC__)
#define TREAD_BODY __host__ __device__ inline
#else
#define TREAD_BODY inline
#endif
