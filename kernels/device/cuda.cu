// The device of NVIDIA's cards: with its teams, the only source that knows CUDA. HIP would be one more like
// it.

#include <array>
#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "kernels/device/cuda_spared.hpp"
#include "kernels/device/cuda_teams.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/march_kernels.hpp"

namespace tread {

namespace {

constexpr int kThreads = MarchCut{}.threads;
constexpr int kSearchThreads = 32;  ///< few, so that all multiprocessors search

/// Architectures that the program is compiled for, ascending: 900 is 9.0. cuda.cmake keeps PTX of each, from
/// which newer cards get their code.
constexpr int kArchitectures[] = {__CUDA_ARCH_LIST__};

/// "9.0" of 900.
std::string version(int architecture) {
  return std::to_string(architecture / 100) + "." + std::to_string(architecture / 10 % 10);
}

/// Zeros where there is no such card.
cudaDeviceProp properties_of(int number) {
  cudaDeviceProp properties{};
  if (cudaGetDeviceProperties(&properties, number) != cudaSuccess) cudaGetLastError();
  return properties;
}

int architecture_of(const cudaDeviceProp& card) {
  return 100 * card.major + 10 * card.minor;
}
bool has_code(const cudaDeviceProp& card) {
  return architecture_of(card) >= kArchitectures[0];
}

/// Why the program has no code for a card.
std::string why_no_code(const cudaDeviceProp& card) {
  return std::string(card.name) + " has the architecture " + version(architecture_of(card)) +
         ", and this tread is compiled for " + version(kArchitectures[0]) +
         " and newer; TREAD_CUDA_ARCHITECTURES=80 compiles it for 8.0, the oldest that it can use";
}

/// Cards that CUDA shows, with code or without.
int card_count() {
  int count = 0;
  return cudaGetDeviceCount(&count) == cudaSuccess ? count : 0;
}

std::string mebibytes(std::int64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

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

template <class Body>
__global__ void __launch_bounds__(kPatchThreads, Body::kNeedsMemory ? 1 : 2)
    patch_kernel(const __grid_constant__ Body body, unsigned shared) {
  body(CudaTeams(shared));
}

class CudaDevice final : public KernelDevice<CudaDevice> {
 public:
  explicit CudaDevice(int number)
      : number_(number),
        card_(properties_of(number)),
        patch_teams_(opened()),
        spared_(number, static_cast<unsigned>(patch_teams_)) {
    int last = 0;
    int first = 0;
    check(cudaDeviceGetStreamPriorityRange(&last, &first), "its priorities");
    for (int i = 0; i < kQueues; ++i) {
      // Others wait for what is in the former.
      const int priority = i < kHostQueue ? first : i < kFanQueue ? (first + last) / 2 : last;
      if (i < kHostQueue || !spared_.make_queue(&queues_[i].stream, priority))
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

  std::string name() const override { return card_.name; }
  std::size_t team_bytes() const override { return card_.sharedMemPerBlockOptin; }
  std::int64_t free_bytes() const override {
    std::size_t free = 0;
    std::size_t total = 0;
    check(cudaMemGetInfo(&free, &total), "its memory");
    return static_cast<std::int64_t>(free);
  }

  void* allocate(std::size_t bytes) override {
    void* memory = nullptr;
    const cudaError_t status = cudaMalloc(&memory, bytes);
    if (status == cudaErrorMemoryAllocation)
      throw ResourceError("the GPU " + label() + " has " + mebibytes(free_bytes()) + " of " +
                          mebibytes(static_cast<std::int64_t>(card_.totalGlobalMem)) +
                          " free, too little for this scene; larger elements, or --device cpu, need less");
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

  /// "NVIDIA H200 (gpu:0)".
  std::string label() const { return name() + " (gpu:" + std::to_string(number_) + ")"; }

  /// ResourceError where a call failed.
  void check(cudaError_t status, const char* what) const {
    if (status != cudaSuccess)
      throw ResourceError("the GPU " + label() + " failed (" + what + "): " + cudaGetErrorString(status) +
                          "; --device cpu needs none");
  }

  /// Opens the card. Returns the teams of a patch in the code that it takes.
  int opened() const {
    check(cudaSetDevice(number_), "opening it");
    check(cudaFree(nullptr), "opening it");
    cudaFuncAttributes attributes{};
    check(cudaFuncGetAttributes(&attributes, each_kernel<Triad>), "its code");
    return teams_of_code(10 * attributes.ptxVersion);  // not binaryVersion: that may be made of older PTX
  }

  struct Queue {
    cudaStream_t stream = nullptr;
    cudaEvent_t end = nullptr;           ///< of what the queue held when it was marked last
    bool marked = false;                 ///< the queue holds nothing after that
    int marks = 0;                       ///< how often it was marked
    std::array<int, kQueues> awaited{};  ///< by queue: its mark that this one has waited for
  };

  /// The queue in use, which gets something.
  cudaStream_t stream() {
    queues_[used()].marked = false;
    return queues_[used()].stream;
  }

  void let_wait(int waiting, int queue) override {
    Queue& of = queues_[queue];
    if (!std::exchange(of.marked, true)) {
      check(cudaEventRecord(of.end, of.stream), "the end of a queue");
      ++of.marks;
    }
    if (std::exchange(queues_[waiting].awaited[queue], of.marks) == of.marks) return;
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

  /// Lets the threads of a kernel's teams share so much memory. The limit is the card's for that kernel,
  /// whoever launches it.
  template <class Kernel>
  void allow(Kernel* kernel, std::size_t bytes) {
    static std::mutex lock;
    static std::map<std::pair<int, const void*>, std::size_t> limits;  ///< by card and kernel [B]
    const std::lock_guard held(lock);
    std::size_t& allowed = limits[{number_, reinterpret_cast<const void*>(kernel)}];
    if (bytes <= allowed) return;
    check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(bytes)),
          "shared memory");
    allowed = bytes;
  }

  template <class Body>
  void patch_any(const Body& body) {
    const auto kernel = patch_kernel<Body>;
    const std::size_t shared = Body::kNeedsMemory ? team_bytes() : CudaTeams::kOwnBytes;
    allow(kernel, shared);
    cudaLaunchAttribute cluster{};
    cluster.id = cudaLaunchAttributeClusterDimension;
    cluster.val.clusterDim = {static_cast<unsigned>(patch_teams_), 1, 1};
    cudaLaunchConfig_t launch{};
    launch.gridDim = dim3(static_cast<unsigned>(patch_teams_));
    launch.blockDim = dim3(kPatchThreads);
    launch.dynamicSmemBytes = shared;
    launch.stream = stream();
    launch.attrs = &cluster;
    launch.numAttrs = patch_teams_ > 1 ? 1 : 0;
    check(cudaLaunchKernelEx(&launch, kernel, body, static_cast<unsigned>(shared)), "patch");
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

    /// Advice to runs in double. All others march in float already.
    static constexpr const char* kLessMemory =
        std::is_same_v<Real, double> ? "scene.precision = \"mixed\" needs less, " : "";

    template <class March>
    void operator()() const {
      const std::size_t bytes = March::shared_bytes(block);
      if (bytes > device.team_bytes())
        throw ResourceError("the GPU " + device.label() + " shares " + std::to_string(device.team_bytes()) +
                            " B among the threads of a team, and " + std::to_string(bytes) +
                            " B are needed; " + kLessMemory + "--device cpu needs none");
      const auto kernel = march_kernel<March, Real, U>;
      device.allow(kernel, bytes);
      kernel<<<static_cast<unsigned>(block.teams()), kThreads, bytes, device.stream()>>>(block, fields);
      device.check(cudaGetLastError(), "march");
    }
  };

  int number_;
  cudaDeviceProp card_;
  int patch_teams_;
  SparedProcessors spared_;
  std::array<Queue, kQueues> queues_;
};

}  // namespace

std::vector<int> gpu_numbers() {
  std::vector<int> numbers;
  for (int number = 0; number < card_count(); ++number)
    if (has_code(properties_of(number))) numbers.push_back(number);
  return numbers;
}

std::vector<std::string> gpus() {
  std::vector<std::string> names;
  for (const int number : gpu_numbers())
    names.push_back("gpu:" + std::to_string(number) + " " + properties_of(number).name);
  return names;
}

std::string why_no_gpu() {
  int count = 0;
  const cudaError_t status = cudaGetDeviceCount(&count);
  if (count > 0) return why_no_code(properties_of(0));
  std::string why = "there is no card that CUDA can use";
  if (status != cudaSuccess) why += std::string(" (") + cudaGetErrorString(status) + ")";
  return why;
}

std::unique_ptr<Device> open_gpu(int number) {
  const std::string name = "--device gpu:" + std::to_string(number) + ": ";
  const int count = card_count();
  if (count == 0) throw ResourceError(name + why_no_gpu() + "; --device cpu runs everywhere");
  if (number >= count)
    throw ResourceError(name + "the last card of this machine is gpu:" + std::to_string(count - 1));
  if (const cudaDeviceProp card = properties_of(number); !has_code(card))
    throw ResourceError(name + why_no_code(card) + "; --device cpu runs everywhere");
  return std::make_unique<CudaDevice>(number);
}

}  // namespace tread
