#pragma once
// Queues that leave some multiprocessors of an NVIDIA card free. A team that needs a whole multiprocessor, or
// a cluster of teams, would else wait until others end, though its queue comes first.

#include <cuda.h>
#include <cuda_runtime.h>

namespace tread {

namespace {

class SparedProcessors {
 public:
  /// At least `count` of them on one part of the card, where its driver can (12.4). The queues end before
  /// this.
  SparedProcessors([[maybe_unused]] int device, [[maybe_unused]] unsigned count) {
#if CUDART_VERSION >= 12050
    const auto resources = driver<decltype(&cuDeviceGetDevResource)>("cuDeviceGetDevResource");
    const auto split = driver<decltype(&cuDevSmResourceSplitByCount)>("cuDevSmResourceSplitByCount");
    const auto describe = driver<decltype(&cuDevResourceGenerateDesc)>("cuDevResourceGenerateDesc");
    const auto create = driver<decltype(&cuGreenCtxCreate)>("cuGreenCtxCreate");
    make_queue_ = driver<decltype(&cuGreenCtxStreamCreate)>("cuGreenCtxStreamCreate");
    destroy_ = driver<decltype(&cuGreenCtxDestroy)>("cuGreenCtxDestroy");
    if (!resources || !split || !describe || !create || !make_queue_ || !destroy_) return;
    CUdevResource all{};
    CUdevResource spared{};
    CUdevResource others{};
    CUdevResourceDesc description{};
    unsigned parts = 1;
    if (resources(device, &all, CU_DEV_RESOURCE_TYPE_SM) != CUDA_SUCCESS || all.sm.smCount < 8 * count)
      return;
    if (split(&spared, &parts, &all, &others, 0, count) != CUDA_SUCCESS || parts != 1) return;
    if (describe(&description, &others, 1) != CUDA_SUCCESS) return;
    if (create(&others_, description, device, CU_GREEN_CTX_DEFAULT_STREAM) != CUDA_SUCCESS) others_ = nullptr;
#endif
  }

  SparedProcessors(const SparedProcessors&) = delete;
  SparedProcessors& operator=(const SparedProcessors&) = delete;
  ~SparedProcessors() {
#if CUDART_VERSION >= 12050
    if (others_) destroy_(others_);
#endif
  }

  /// False where there is none.
  bool make_queue([[maybe_unused]] cudaStream_t* queue, [[maybe_unused]] int priority) const {
#if CUDART_VERSION >= 12050
    return others_ && make_queue_(queue, others_, CU_STREAM_NON_BLOCKING, priority) == CUDA_SUCCESS;
#else
    return false;
#endif
  }

 private:
#if CUDART_VERSION >= 12050
  template <class Function>
  static Function driver(const char* name) {
    void* function = nullptr;
    cudaDriverEntryPointQueryResult found{};
    if (cudaGetDriverEntryPointByVersion(name, &function, 12040, cudaEnableDefault, &found) != cudaSuccess) {
      cudaGetLastError();
      return nullptr;
    }
    return reinterpret_cast<Function>(function);
  }

  CUgreenCtx others_ = nullptr;
  decltype(&cuGreenCtxStreamCreate) make_queue_ = nullptr;
  decltype(&cuGreenCtxDestroy) destroy_ = nullptr;
#endif
};

}  // namespace

}  // namespace tread
