// The device of NVIDIA's cards: the only source that knows CUDA. HIP would be one more file like it.

#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/march_kernels.hpp"

namespace tread {

namespace {

constexpr int kThreads = MarchCut{}.threads;
constexpr int kSearchThreads = 32;  ///< few, so that all multiprocessors search
constexpr int kPatchThreads = 512;  ///< of the one team of a patch
constexpr unsigned kAll = ~0U;      ///< lanes of a warp
constexpr int kWarp = 32;

/// ResourceError where a call failed.
void check(cudaError_t status, const char* what) {
  if (status != cudaSuccess)
    throw ResourceError(std::string("the GPU failed (") + what + "): " + cudaGetErrorString(status) +
                        "; `tread resume` goes on from the last checkpoint, with --device cpu anywhere");
}

std::string mebibytes(std::size_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

extern __shared__ double shared_memory[];

class CudaTeam {
 public:
  __device__ int block() const { return static_cast<int>(blockIdx.x); }
  template <class T>
  __device__ T* share(std::size_t n) const {
    T* const first = reinterpret_cast<T*>(reinterpret_cast<char*>(shared_memory) + used_);
    used_ += n * sizeof(T);
    return first;
  }
  template <class Body>
  __device__ void for_each(int n, const Body& body) const {
    for (int i = static_cast<int>(threadIdx.x); i < n; i += static_cast<int>(blockDim.x)) body(i);
    __syncthreads();
  }

 protected:
  mutable std::size_t used_ = 0;
};

/// Largest of the values of a warp's lanes, which are zero or more: then their bits have their order.
__device__ double largest_of_warp(double value) {
  const auto high = static_cast<unsigned>(__double2hiint(value));
  const unsigned most = __reduce_max_sync(kAll, high);
  const unsigned low = high == most ? static_cast<unsigned>(__double2loint(value)) : 0U;
  return __hiloint2double(static_cast<int>(most), static_cast<int>(__reduce_max_sync(kAll, low)));
}

/// kernels/device/patch_arena.hpp
class CudaPatchTeam : public CudaTeam {
 public:
  __device__ explicit CudaPatchTeam(unsigned bytes)
      : bytes_(bytes), largest_(share<LargestPair>(2 * kWarp)), sums_(share<int>(kWarp)) {}

  struct Spare {
    std::byte* first;
    std::size_t bytes;
    __device__ std::byte* data() const { return first; }
    __device__ std::size_t size() const { return bytes; }
  };
  __device__ Spare spare() const {
    return {reinterpret_cast<std::byte*>(shared_memory) + used_, bytes_ - used_};
  }
  template <class T>
  __device__ T* near(T* pointer) const {
    const std::size_t place = __cvta_generic_to_shared(pointer) - __cvta_generic_to_shared(shared_memory);
    return reinterpret_cast<T*>(reinterpret_cast<std::byte*>(shared_memory) + place);
  }
  __device__ void least(int* at, int value) const { atomicMin(at, value); }
  __device__ int add(int* at, int value) const { return atomicAdd(at, value); }
  __device__ int claim(int* at, int value) const {
    const int before = atomicCAS(at, 0, value);
    return before == 0 ? value : before;
  }

  /// Each warp takes a run of values, kWarp of them at a time.
  template <class Value, class Take>
  __device__ int number(int n, const Value& value, const Take& take) const {
    const int length = (n + kPatchThreads - 1) / kPatchThreads * kWarp;
    const int begin = warp() * length;
    const int end = begin + length < n ? begin + length : n;
    int own = 0;
    for (int i = begin + lane(); i < end; i += kWarp) own += value(i);
    own = __reduce_add_sync(kAll, own);
    if (lane() == 0) sums_[warp()] = own;
    __syncthreads();
    const int other = lane() < kWarps ? sums_[lane()] : 0;
    const int all = __reduce_add_sync(kAll, other);
    int before = __reduce_add_sync(kAll, lane() < warp() ? other : 0);
    for (int first = begin; first < end; first += kWarp) {
      const int i = first + lane();
      const int one = i < end ? value(i) : 0;
      int sum = one;
      for (int step = 1; step < kWarp; step *= 2) {
        const int lower = __shfl_up_sync(kAll, sum, static_cast<unsigned>(step));
        if (lane() >= step) sum += lower;
      }
      if (i < end) take(i, before + sum - one);
      before += __shfl_sync(kAll, sum, kWarp - 1);
    }
    __syncthreads();
    return all;
  }

  /// Places of the warps' largest values change from call to call: no one waits until all have read them.
  template <class Values>
  __device__ LargestPair largest(int n, const Values& values) const {
    LargestPair most{0, 0};
    for (int i = static_cast<int>(threadIdx.x); i < n; i += kPatchThreads) raise(most, values(i));
    LargestPair* const of_warps = largest_ + turn_ * kWarp;
    turn_ = 1 - turn_;
    const LargestPair of_warp{largest_of_warp(most.first), largest_of_warp(most.second)};
    if (lane() == 0) of_warps[warp()] = of_warp;
    __syncthreads();
    const LargestPair other = lane() < kWarps ? of_warps[lane()] : LargestPair{0, 0};
    return {largest_of_warp(other.first), largest_of_warp(other.second)};
  }

 private:
  static constexpr int kWarps = kPatchThreads / kWarp;

  __device__ static int lane() { return static_cast<int>(threadIdx.x) % kWarp; }
  __device__ static int warp() { return static_cast<int>(threadIdx.x) / kWarp; }

  unsigned bytes_;
  LargestPair* largest_;
  int* sums_;
  mutable int turn_ = 0;
};

/// Teams that a multiprocessor has registers for. Plastic elements need more than linear ones.
template <class Real, bool linear>
inline constexpr int kTeams = linear ? (sizeof(Real) == sizeof(double) ? 2 : 3) : 1;

template <class March, class Real, class U>
__global__ void __launch_bounds__(kThreads, kTeams<Real, March::kLinear>)
    march_kernel(MarchBlock<Real> block, MarchFields<Real, U> fields) {
  CudaTeam team;
  March(team, block, fields).run();
}

template <class Body>
constexpr int kThreadsOf = kThreads;
template <class U, class V>
constexpr int kThreadsOf<SearchPoints<U, V>> = kSearchThreads;

template <class Body>
__global__ void each_kernel(std::int64_t n, const __grid_constant__ Body body) {
  const std::int64_t i = std::int64_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (i < n) body(i);
}

template <class Law>
__global__ void __launch_bounds__(kPatchThreads)
    patch_kernel(const __grid_constant__ ContactTask task, const __grid_constant__ Law law,
                 typename Law::State* state, unsigned shared) {
  CudaPatchTeam team(shared);
  PatchTeam<Law, CudaPatchTeam>(team, task, law, state).run();
}

class CudaDevice final : public KernelDevice<CudaDevice> {
 public:
  explicit CudaDevice(int number) {
    check(cudaSetDevice(number), "opening it");
    cudaDeviceProp properties{};
    check(cudaGetDeviceProperties(&properties, number), "its properties");
    name_ = properties.name;
    shared_ = properties.sharedMemPerBlockOptin;
    int last = 0;
    int first = 0;
    check(cudaDeviceGetStreamPriorityRange(&last, &first), "its priorities");
    for (int i = 0; i < kQueues; ++i) {
      const int priority = i < kFanQueue ? first : last;  // others wait for what is in the former
      check(cudaStreamCreateWithPriority(&queues_[i].stream, cudaStreamNonBlocking, priority), "a queue");
      check(cudaEventCreateWithFlags(&queues_[i].end, cudaEventDisableTiming), "a queue");
    }
  }
  CudaDevice(const CudaDevice&) = delete;
  CudaDevice& operator=(const CudaDevice&) = delete;
  ~CudaDevice() override {
    for (const Queue& queue : queues_) {
      cudaEventDestroy(queue.end);
      cudaStreamDestroy(queue.stream);
    }
  }

  std::string name() const override { return name_; }

  void* allocate(std::size_t bytes) override {
    void* memory = nullptr;
    const cudaError_t status = cudaMalloc(&memory, bytes);
    if (status == cudaErrorMemoryAllocation) {
      std::size_t free = 0;
      std::size_t total = 0;
      cudaMemGetInfo(&free, &total);
      throw ResourceError("the GPU " + name_ + " has " + mebibytes(free) + " of " + mebibytes(total) +
                          " free, too little for this scene; larger elements, or --device cpu, need none");
    }
    check(status, "memory");
    check(cudaMemsetAsync(memory, 0, bytes, stream()), "memory");
    return memory;
  }
  void release(void* memory) override { cudaFree(memory); }
  /// A limit of the host's locked memory is no failure: copies are slower then.
  void lock(void* pages, std::size_t bytes) override {
    if (cudaHostRegister(pages, bytes, cudaHostRegisterDefault) != cudaSuccess) cudaGetLastError();
  }
  void unlock(void* pages) override {
    cudaDeviceSynchronize();  // a copy may be under way
    if (cudaHostUnregister(pages) != cudaSuccess) cudaGetLastError();
  }

  void finish(int queue) override {
    check(cudaStreamSynchronize(queues_[queue].stream), "waiting for a queue");
  }
  void wait() override { check(cudaDeviceSynchronize(), "waiting for it"); }

 private:
  friend KernelDevice<CudaDevice>;

  struct Queue {
    cudaStream_t stream = nullptr;
    cudaEvent_t end = nullptr;  ///< of what the queue held when it was marked last
    bool marked = false;        ///< the queue holds nothing after that
  };

  /// The queue in use, which gets something.
  cudaStream_t stream() {
    queues_[used()].marked = false;
    return queues_[used()].stream;
  }

  void let_wait(int waiting, int queue) override {
    Queue& of = queues_[queue];
    if (!std::exchange(of.marked, true)) check(cudaEventRecord(of.end, of.stream), "the end of a queue");
    queues_[waiting].marked = false;
    check(cudaStreamWaitEvent(queues_[waiting].stream, of.end, 0), "a queue after another");
  }

  void copy_to(void* to, const void* from, std::size_t bytes) override {
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream()), "copy to it");
  }
  void copy_from(void* to, const void* from, std::size_t bytes) override {
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream()), "copy from it");
  }

  template <class Body>
  void each(const Body& body) {
    constexpr int threads = kThreadsOf<Body>;
    const auto blocks = static_cast<unsigned>((body.count() + threads - 1) / threads);
    each_kernel<<<blocks, threads, 0, stream()>>>(body.count(), body);
    check(cudaGetLastError(), "values of nodes");
  }

  template <class Law>
  void patch_any(const ContactTask& task, const Law& law, typename Law::State* state) {
    const auto kernel = patch_kernel<Law>;
    check(
        cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(shared_)),
        "shared memory");
    kernel<<<1, kPatchThreads, shared_, stream()>>>(task, law, state, static_cast<unsigned>(shared_));
    check(cudaGetLastError(), "patch");
  }

  template <class Real, class U>
  void march_any(TileVariant variant, const MarchBlock<Real>& block, const MarchFields<Real, U>& fields) {
    with_march<Real, U, CudaTeam>(variant, Launch<Real, U>{*this, block, fields});
  }

  template <class Real, class U>
  struct Launch {
    CudaDevice& device;
    const MarchBlock<Real>& block;
    const MarchFields<Real, U>& fields;

    template <class March>
    void operator()() const {
      const std::size_t bytes = March::shared_bytes(block);
      if (bytes > device.shared_)
        throw ResourceError("the GPU " + device.name_ + " shares " + std::to_string(device.shared_) +
                            " B among the threads of a team, and " + std::to_string(bytes) +
                            " B are needed; --device cpu needs none");
      const auto kernel = march_kernel<March, Real, U>;
      check(
          cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(bytes)),
          "shared memory");
      kernel<<<static_cast<unsigned>(block.teams()), kThreads, bytes, device.stream()>>>(block, fields);
      check(cudaGetLastError(), "march");
    }
  };

  std::string name_;
  std::size_t shared_ = 0;
  std::array<Queue, kQueues> queues_;
};

}  // namespace

std::vector<std::string> gpus() {
  int count = 0;
  std::vector<std::string> names;
  if (cudaGetDeviceCount(&count) != cudaSuccess) return names;
  for (int number = 0; number < count; ++number) {
    cudaDeviceProp properties{};
    if (cudaGetDeviceProperties(&properties, number) == cudaSuccess) names.emplace_back(properties.name);
  }
  return names;
}

std::string why_no_gpu() {
  int count = 0;
  const cudaError_t status = cudaGetDeviceCount(&count);
  std::string why = "there is no card that CUDA can use";
  if (status != cudaSuccess) why += std::string(" (") + cudaGetErrorString(status) + ")";
  return why;
}

std::unique_ptr<Device> open_gpu(int number) {
  const int count = static_cast<int>(gpus().size());
  const std::string name = "--device gpu:" + std::to_string(number);
  if (count == 0) throw ResourceError(name + ": " + why_no_gpu() + "; --device cpu runs everywhere");
  if (number >= count)
    throw ResourceError(name + ": the last card of this machine is gpu:" + std::to_string(count - 1));
  return std::make_unique<CudaDevice>(number);
}

}  // namespace tread
