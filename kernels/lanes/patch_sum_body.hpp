#pragma once
// Included by one source per instruction set; internal linkage keeps the versions apart.

#include "kernels/lanes/patch_sum.hpp"
#include "kernels/lanes/registers.hpp"

namespace tread {
namespace {

using PatchRegister = Vector<double, 4>::type;

inline Vec3 patch_take(const PatchLink& link, const PatchVector* nodes, const PatchVector& start) {
  constexpr int kSums = 4;  // so that additions wait less for one another
  PatchRegister part[kSums] = {load<PatchRegister>(start.value)};
#pragma GCC unroll 8
  for (int k = 0; k < kLinkedNodes; k += kSums)
    for (int i = 0; i < kSums; ++i)
      part[i] += link.weight[k + i] * load<PatchRegister>(nodes[link.node[k + i]].value);
  const PatchRegister sum = (part[0] + part[1]) + (part[2] + part[3]);
  return {sum[0], sum[1], sum[2]};
}

inline void patch_give(const PatchLink& link, const Vec3& value, PatchVector* nodes) {
  const PatchRegister given = {value.x, value.y, value.z, 0};
#pragma GCC unroll 8
  for (int k = 0; k < kLinkedNodes; ++k) {
    double* const at = nodes[link.node[k]].value;
    store(at, load<PatchRegister>(at) + link.weight[k] * given);
  }
}

}  // namespace
}  // namespace tread
