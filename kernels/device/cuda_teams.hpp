#pragma once
// Teams of threads on NVIDIA's cards. [kernels/device/march_body.hpp, kernels/device/patch_room.hpp]

#include <cooperative_groups.h>

#include <cstddef>

#include "kernels/device/contact_layout.hpp"
#include "kernels/device/patch_room.hpp"

namespace tread {

namespace {

constexpr int kPatchThreads = 512;  ///< of each team of a patch
constexpr unsigned kAll = ~0U;      ///< lanes of a warp
constexpr int kWarp = 32;

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
  /// From the card's memory into its cache.
  template <int bytes, class Place>
  __device__ void fetch_ahead(int n, const Place& place) const {
    constexpr int line = 64;
    for (int i = static_cast<int>(threadIdx.x); i < n; i += static_cast<int>(blockDim.x))
      for (int at = 0; at < bytes; at += line)
        asm volatile("prefetch.global.L2 [%0];" ::"l"(reinterpret_cast<const char*>(place(i)) + at));
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

/// kernels/device/patch_room.hpp: the blocks of a cluster.
class CudaTeams {
  static constexpr int kWarps = kPatchThreads / kWarp;
  static_assert(kMostTeams <= kWarp);

  /// Values that the warps of all teams tell each other.
  struct alignas(PatchRoom::kLine) Board {
    LargestPair largest[2][kMostTeams * kWarps];
    int sums[kMostTeams * kWarps];
  };

 public:
  static constexpr std::size_t kOwnBytes = sizeof(Board);  ///< of a block's memory

  /// `bytes`: that the threads of a block share.
  __device__ explicit CudaTeams(unsigned bytes) : bytes_(bytes) { join(); }

  struct Memory {
    std::byte* first;
    std::size_t bytes;
    __device__ std::byte* data() const { return first; }
    __device__ std::size_t size() const { return bytes; }
  };
  __device__ Memory memory() const {
    return {reinterpret_cast<std::byte*>(shared_memory) + kOwnBytes, bytes_ - kOwnBytes};
  }
  template <class T>
  __device__ T* here(T* pointer) const {
    return pointer;
  }
  template <class T>
  __device__ T* near(T* pointer) const {
    const std::size_t place = __cvta_generic_to_shared(pointer) - __cvta_generic_to_shared(shared_memory);
    return reinterpret_cast<T*>(reinterpret_cast<std::byte*>(shared_memory) + place);
  }
  template <class T>
  __device__ void tell(T* pointer, T value) const {
    for (int team = 0; team < teams(); ++team) *of(team, pointer) = value;
  }
  __device__ void least(int* at, int value) const { atomicMin(at, value); }
  __device__ int add(int* at, int value) const { return atomicAdd(at, value); }
  __device__ int claim(int* at, int value) const {
    const int before = atomicCAS(at, 0, value);
    return before == 0 ? value : before;
  }

  __device__ int teams() const { return static_cast<int>(gridDim.x); }
  __device__ int team() const { return static_cast<int>(blockIdx.x); }
  __device__ int run(int n) const { return (n + teams() - 1) / teams(); }
  template <int width = 1, class Body>
  __device__ void for_each(int n, const Body& body) const {
    of_run<width>(n, body);
    join();
  }
  template <int width = 1, class Body>
  __device__ void for_own(int n, const Body& body) const {
    of_run<width>(n, body);
    __syncthreads();
  }
  template <class First, class Body>
  __device__ void for_lists(int n, const First& first, const Body& body) const {
    const int end = first(end_of(n));
    for (int i = first(begin_of(n)) + thread(); i < end; i += kPatchThreads) body(i);
    __syncthreads();
  }

  /// Each warp takes a part of its team's run, kWarp values at a time.
  template <class Value, class Take>
  __device__ int number(int n, const Value& value, const Take& take) const {
    const int length = (run(n) + kPatchThreads - 1) / kPatchThreads * kWarp;
    const int begin = min(end_of(n), begin_of(n) + warp() * length);
    const int end = min(end_of(n), begin + length);
    int own = 0;
    for (int i = begin + lane(); i < end; i += kWarp) own += value(i);
    own = __reduce_add_sync(kAll, own);
    if (lane() < teams()) *of(lane(), board().sums + place()) = own;
    join();
    int all = 0;
    int before = 0;
    for (int i = lane(); i < teams() * kWarps; i += kWarp) {
      all += board().sums[i];
      if (i < place()) before += board().sums[i];
    }
    all = __reduce_add_sync(kAll, all);
    before = __reduce_add_sync(kAll, before);
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
    join();
    return all;
  }

  /// Places of the warps' largest values change from call to call: no one waits until all have read them.
  template <class Values>
  __device__ LargestPair largest(int n, const Values& values) const {
    LargestPair most{0, 0};
    of_run<1>(n, [&](int i) { raise(most, values(i)); });
    LargestPair* const of_warps = board().largest[turn_];
    turn_ = 1 - turn_;
    const LargestPair of_warp{largest_of_warp(most.first), largest_of_warp(most.second)};
    if (lane() < teams()) *of(lane(), of_warps + place()) = of_warp;
    join();
    LargestPair all{0, 0};
    for (int i = lane(); i < teams() * kWarps; i += kWarp) raise(all, of_warps[i]);
    return {largest_of_warp(all.first), largest_of_warp(all.second)};
  }

 private:
  __device__ static int thread() { return static_cast<int>(threadIdx.x); }
  __device__ static int lane() { return thread() % kWarp; }
  __device__ static int warp() { return thread() / kWarp; }
  /// Number of the own warp among those of all teams.
  __device__ int place() const { return team() * kWarps + warp(); }
  __device__ static Board& board() { return *reinterpret_cast<Board*>(shared_memory); }
  __device__ int begin_of(int n) const { return min(n, team() * run(n)); }
  __device__ int end_of(int n) const { return min(n, (team() + 1) * run(n)); }
  template <int width, class Body>
  __device__ void of_run(int n, const Body& body) const {
    const int end = width * end_of(n);
    for (int i = width * begin_of(n) + thread(); i < end; i += kPatchThreads) body(i);
  }

#if __CUDA_ARCH__ >= 900
  static_assert(teams_of_code(__CUDA_ARCH__) > 1);
  __device__ void join() const {
    if (teams() == 1)
      __syncthreads();
    else
      cooperative_groups::this_cluster().sync();
  }
  /// The same place in the memory of another team.
  template <class T>
  __device__ static T* of(int team, T* pointer) {
    return cooperative_groups::this_cluster().map_shared_rank(pointer, team);
  }
#else
  __device__ static void join() {
    __syncthreads();
  }
  template <class T>
  __device__ static T* of(int /*team*/, T* pointer) {
    return pointer;
  }
#endif

  unsigned bytes_;
  mutable int turn_ = 0;
};

}  // namespace

}  // namespace tread
