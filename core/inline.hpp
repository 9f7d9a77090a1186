#pragma once
// Functions of the kernels' bodies.

/// A body that is inlined into its caller and takes that caller's instruction set; on a device too.
#define TREAD_INLINE [[gnu::always_inline]] constexpr inline
