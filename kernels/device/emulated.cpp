// Teams and their threads, taken one after another by the threads of the processor. What they share must not
// depend on their order, nor on that of queues: tests shuffle the one and delay the others.

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <new>
#include <numeric>
#include <span>
#include <utility>

#include "core/aligned.hpp"
#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/march_kernels.hpp"

namespace tread {

namespace {

/// A permutation of 0 ... n - 1 that takes no memory: steps of a length that has no common factor with n.
class Order {
 public:
  Order(std::int64_t n, std::uint64_t seed) : n_(n) {
    if (seed == 0 || n < 2) return;
    first_ = static_cast<std::int64_t>(seed % static_cast<std::uint64_t>(n));
    step_ = 1 + static_cast<std::int64_t>(seed / 7 % static_cast<std::uint64_t>(n - 1));
    while (std::gcd(step_, n) != 1) ++step_;
  }
  std::int64_t operator()(std::int64_t i) const { return (first_ + i * step_) % n_; }

 private:
  std::int64_t n_;
  std::int64_t first_ = 0;
  std::int64_t step_ = 1;
};

/// Queues whose kernels and copies begin as late as they may: when the host waits for them, or another queue
/// that it waits for.
class LateQueues {
 public:
  void add(int queue, std::function<void()> task) { queue_[at(queue)].tasks.push_back(std::move(task)); }
  void let_wait(int waiting, int queue) {
    add(waiting, [this, queue, until = added(queue)] { run(queue, until); });
  }
  void run(int queue) { run(queue, added(queue)); }
  void run_all() {
    for (int queue = 0; queue < kQueues; ++queue) run(queue);
  }

 private:
  struct Queue {
    std::deque<std::function<void()>> tasks;
    std::int64_t begun = 0;
  };
  static std::size_t at(int queue) { return static_cast<std::size_t>(queue); }
  std::int64_t added(int queue) const {
    return queue_[at(queue)].begun + std::ssize(queue_[at(queue)].tasks);
  }
  void run(int queue, std::int64_t until) {
    Queue& of = queue_[at(queue)];
    while (of.begun < until) {
      const std::function<void()> task = std::move(of.tasks.front());
      of.tasks.pop_front();
      ++of.begun;
      task();
    }
  }

  std::array<Queue, kQueues> queue_;
};

class EmulatedTeam {
 public:
  EmulatedTeam(int block, std::uint64_t seed, std::span<std::byte> memory)
      : block_(block), seed_(seed), memory_(memory) {}

  int block() const { return block_; }
  template <class T>
  T* share(std::size_t n) const {
    T* const first = reinterpret_cast<T*>(memory_.data());
    memory_ = memory_.subspan(n * sizeof(T));
    return first;
  }
  template <class Body>
  void for_each(int n, const Body& body) const {
    const Order order(n, seed_);
    for (int i = 0; i < n; ++i) body(static_cast<int>(order(i)));
  }
  template <int bytes, class Place>
  void fetch_ahead(int /*n*/, const Place& /*place*/) const {}

 private:
  int block_;
  std::uint64_t seed_;
  mutable std::span<std::byte> memory_;
};

/// kernels/device/patch_room.hpp: one thread at a time changes what all share.
class EmulatedTeams {
 public:
  EmulatedTeams(int teams, std::uint64_t seed, std::span<std::byte> memory)
      : teams_(teams), seed_(seed), memory_(memory) {}

  int teams() const { return teams_; }
  int team() const { return team_; }
  int run(int n) const { return (n + teams_ - 1) / teams_; }
  template <int width = 1, class Body>
  void for_each(int n, const Body& body) const {
    for_teams([&] {
      const int first = width * std::min(n, team_ * run(n));
      const int count = width * std::min(n, (team_ + 1) * run(n)) - first;
      const Order order(count, seed_);
      for (int i = 0; i < count; ++i) body(first + static_cast<int>(order(i)));
    });
  }
  template <int width = 1, class Body>
  void for_own(int n, const Body& body) const {
    for_each<width>(n, body);
  }
  template <class First, class Body>
  void for_lists(int n, const First& first, const Body& body) const {
    for_teams([&] {
      const int begin = first(std::min(n, team_ * run(n)));
      const int count = first(std::min(n, (team_ + 1) * run(n))) - begin;
      const Order order(count, seed_);
      for (int i = 0; i < count; ++i) body(begin + static_cast<int>(order(i)));
    });
  }
  template <class Value, class Take>
  int number(int n, const Value& value, const Take& take) const {
    int before = 0;
    for (int i = 0; i < n; ++i) {
      team_ = i / run(n);
      const int own = value(i);
      take(i, before);
      before += own;
    }
    return before;
  }
  template <class Values>
  LargestPair largest(int n, const Values& values) const {
    LargestPair most{0, 0};
    for_each(n, [&](int i) { raise(most, values(i)); });
    return most;
  }
  std::span<std::byte> memory() const {
    return memory_.first(memory_.size() / static_cast<std::size_t>(teams_));
  }
  template <class T>
  T* here(T* pointer) const {
    return of(team_, pointer);
  }
  template <class T>
  T* near(T* pointer) const {
    return here(pointer);
  }
  template <class T>
  void tell(T* pointer, T value) const {
    for (int team = 0; team < teams_; ++team) *of(team, pointer) = value;
  }
  void least(int* at, int value) const { *at = std::min(*at, value); }
  int add(int* at, int value) const { return std::exchange(*at, *at + value); }
  int claim(int* at, int value) const { return *at = *at == 0 ? value : *at; }

 private:
  template <class Body>
  void for_teams(const Body& body) const {
    const Order order(teams_, seed_);
    for (int i = 0; i < teams_; ++i) {
      team_ = static_cast<int>(order(i));
      body();
    }
  }
  template <class T>
  T* of(int team, T* pointer) const {
    return reinterpret_cast<T*>(reinterpret_cast<std::byte*>(pointer) +
                                static_cast<std::size_t>(team) * memory().size());
  }

  int teams_;
  std::uint64_t seed_;
  std::span<std::byte> memory_;
  mutable int team_ = 0;
};

class EmulatedDevice final : public KernelDevice<EmulatedDevice> {
 public:
  explicit EmulatedDevice(const Emulation& emulation) : emulation_(emulation) {}

  std::string name() const override { return "emulated"; }
  MarchCut cut() const override { return emulation_.cut; }
  std::size_t team_bytes() const override { return emulation_.team_bytes; }
  std::int64_t free_bytes() const override { return emulation_.free_bytes - taken_; }
  bool spoils_copies() const override { return emulation_.spoils_copies; }

  void* allocate(std::size_t bytes) override {
    void* const memory = ::operator new (bytes, std::align_val_t{64});
    std::memset(memory, 0, bytes);
    taken_ += static_cast<std::int64_t>(bytes_[memory] = bytes);
    return memory;
  }
  void release(void* memory) override {
    wait();
    taken_ -= static_cast<std::int64_t>(bytes_.extract(memory).mapped());
    ::operator delete (memory, std::align_val_t{64});
  }
  /// A copy may be under way.
  void unlock(void* /*pages*/) override { wait(); }
  void finish(int queue) override { queues_.run(queue); }
  void wait() override { queues_.run_all(); }

 private:
  friend KernelDevice<EmulatedDevice>;

  void let_wait(int waiting, int queue) override { queues_.let_wait(waiting, queue); }
  void copy_to(void* to, const void* from, std::size_t bytes) override { copy(to, from, bytes); }
  void copy_from(void* to, const void* from, std::size_t bytes) override { copy(to, from, bytes); }
  void copy(void* to, const void* from, std::size_t bytes) {
    if (emulation_.copies-- <= 0) throw ResourceError("the device emulated is lost; --device cpu needs none");
    start([=] { std::memcpy(to, from, bytes); });
  }

  /// At once in the order of the calls, late in another.
  template <class Task>
  void start(const Task& task) {
    if (emulation_.order == 0) {
      task();
      return;
    }
    queues_.add(used(), task);
    if (emulation_.order % 2 == 0 && used() >= kHostQueue) queues_.run(used());
  }

  template <class Body>
  void each(const Body& body) {
    start([body, seed = emulation_.order] {
      const Order order(body.count(), seed);
      parallel_ranges(body.count(), [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i) body(order(i));
      });
    });
  }

  template <class Body>
  void patch_any(const Body& body) {
    start([body, seed = emulation_.order, shared = emulation_.shared, teams = emulation_.teams] {
      thread_local AlignedVector<std::byte> memory;
      memory.resize(static_cast<std::size_t>(teams) * shared);
      body(EmulatedTeams(teams, seed, memory));
    });
  }

  template <class Real, class U>
  void march_any(TileVariant variant, const MarchBlock<Real>& block, const MarchFields<Real, U>& fields) {
    start([=, seed = emulation_.order] {
      with_march<Real, U, EmulatedTeam>(variant, [&]<class M>() {
        const Order order(block.teams(), seed);
        parallel_ranges(block.teams(), [&](std::int64_t first, std::int64_t last) {
          thread_local AlignedVector<std::byte> memory;
          memory.resize(std::max(memory.size(), M::shared_bytes(block)));
          for (std::int64_t i = first; i < last; ++i) {
            const EmulatedTeam team(static_cast<int>(order(i)), seed, memory);
            M(team, block, fields).run();
          }
        });
      });
    });
  }

  Emulation emulation_;
  std::map<void*, std::size_t> bytes_;  ///< by piece of memory [B]
  std::int64_t taken_ = 0;              ///< their sum [B]
  LateQueues queues_;
};

}  // namespace

std::unique_ptr<Device> emulated_device(const Emulation& emulation) {
  return std::make_unique<EmulatedDevice>(emulation);
}

}  // namespace tread
