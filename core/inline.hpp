#pragma once
// Functions of the kernels' bodies. TREAD_BODY: those that are too long for TREAD_INLINE, or call functions
// that are not constexpr.

#include "core/math/body.hpp"

/// A body that is inlined into its caller and takes that caller's instruction set; on a device too.
#define TREAD_INLINE [[gnu::always_inline]] constexpr inline
