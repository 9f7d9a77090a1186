#pragma once
// Functions that a device may call, too.

#if defined(__CUDACC__)
#define TREAD_BODY __host__ __device__ inline
#else
#define TREAD_BODY inline
#endif
