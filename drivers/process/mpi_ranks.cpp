// Ranks by MPI. The name stands in this file and in the choice of sources alone (drivers/mpi.cmake).

#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "core/contract.hpp"
#include "core/error.hpp"
#include "drivers/process/host.hpp"
#include "drivers/process/launched_ranks.hpp"
#include "drivers/process/launcher.hpp"
#include "drivers/process/machine.hpp"

namespace tread {

namespace {

using Clock = std::chrono::steady_clock;

/// Ranks that have something in common.
struct Alike {
  int count;  ///< of them
  int place;  ///< number of this one among them
};

/// Ranks whose texts are this rank's.
Alike alike(const std::string& text) {
  int count = 0;
  int rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const std::size_t own = std::hash<std::string>{}(text);
  std::vector<std::size_t> all(static_cast<std::size_t>(count));
  MPI_Allgather(&own, sizeof own, MPI_BYTE, all.data(), sizeof own, MPI_BYTE, MPI_COMM_WORLD);
  return {static_cast<int>(std::count(all.begin(), all.end(), own)),
          static_cast<int>(std::count(all.begin(), all.begin() + rank, own))};
}

/// Machine and cores that this process may use.
std::string cores_text() {
  std::string text = host_name();
  for (const int core : allowed_cores()) text += " " + std::to_string(core);
  return text;
}

/// Waits for all of them. A rank that has waited long sleeps: on a busy machine it then gets its core back
/// sooner than one that keeps asking, and ranks that wait for the preload leave their cores to it.
void await(std::span<MPI_Request> requests) {
  using std::chrono::microseconds;
  constexpr microseconds kAwake{200};  ///< as long as an exchange among idle cores takes
  constexpr microseconds kLong{20000};
  const Clock::time_point started = Clock::now();
  for (int done = 0;;) {
    MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE);
    if (done != 0) return;
    const Clock::duration waited = Clock::now() - started;
    if (waited > kAwake) std::this_thread::sleep_for(waited > kLong ? microseconds(1000) : microseconds(20));
  }
}

class MpiRanks final : public Ranks {
 public:
  /// Threads of this process compute and write; one at a time exchanges.
  MpiRanks() {
    int level = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    on_host_ = alike(host_name());
    on_cores_ = alike(cores_text());
    if (level < MPI_THREAD_SERIALIZED)
      throw ResourceError("this MPI allows a process no threads that exchange in turn");
  }
  ~MpiRanks() override { MPI_Finalize(); }

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  int on_host() const override { return on_host_.count; }
  int place_on_host() const override { return on_host_.place; }
  int on_cores() const override { return on_cores_.count; }
  int place_on_cores() const override { return on_cores_.place; }

  void exchange(std::span<const RankSegment> sent, std::span<const RankSegment> received) override {
    const Clock::time_point started = Clock::now();
    begin_to_receive(received, kExchanged);
    begin_to_send(sent, kExchanged);
    finish(started);
  }
  void post(std::span<const RankSegment> sent) override { begin_to_send(sent, kPosted); }
  void receive(std::span<const RankSegment> received) override {
    const Clock::time_point started = Clock::now();
    begin_to_receive(received, kPosted);
    if (!received.empty()) traffic.beside += finish(started);
  }

  [[noreturn]] void end_all(int code) override {
    std::fflush(nullptr);
    MPI_Abort(MPI_COMM_WORLD, code);
    std::_Exit(code);
  }

 private:
  static constexpr int kExchanged = 0, kPosted = 1;  ///< tags

  void begin_to_receive(std::span<const RankSegment> received, int tag) {
    for (const RankSegment& segment : received)
      for_pieces(segment.bytes, [&](std::byte* at, int size) {
        MPI_Irecv(at, size, MPI_BYTE, segment.rank, tag, MPI_COMM_WORLD, &requests_.emplace_back());
        traffic.received += size;
      });
  }
  void begin_to_send(std::span<const RankSegment> sent, int tag) {
    for (const RankSegment& segment : sent)
      for_pieces(segment.bytes, [&](std::byte* at, int size) {
        MPI_Isend(at, size, MPI_BYTE, segment.rank, tag, MPI_COMM_WORLD, &requests_.emplace_back());
        traffic.sent += size;
      });
  }
  /// Waits for all that has begun. Returns the time since `started` [s].
  double finish(Clock::time_point started) {
    await(requests_);
    requests_.clear();
    return note_wait(started);
  }

  void broadcast_bytes(std::span<std::byte> bytes) override {
    for_pieces(bytes, [](std::byte* at, int size) {
      MPI_Request request = MPI_REQUEST_NULL;
      MPI_Ibcast(at, size, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
      await({&request, 1});
    });
  }

  void gather_values(std::byte* values, int size, std::span<const std::int64_t> first) override {
    TREAD_EXPECT(std::ssize(first) == count_ + 1);
    if (first.back() > std::numeric_limits<int>::max())
      throw ResourceError("a field has more than 2^31 values, too many for several ranks; start one process");
    const Clock::time_point started = Clock::now();
    counts_.resize(first.size() - 1);
    places_.resize(counts_.size());
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      counts_[i] = static_cast<int>(first[i + 1] - first[i]);
      places_[i] = static_cast<int>(first[i]);
    }
    const MPI_Datatype type = size == 1 ? MPI_BYTE : size == 4 ? MPI_UINT32_T : MPI_UINT64_T;
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Iallgatherv(MPI_IN_PLACE, 0, type, values, counts_.data(), places_.data(), type, MPI_COMM_WORLD,
                    &request);
    await({&request, 1});
    const std::int64_t own = counts_[static_cast<std::size_t>(rank_)];
    traffic.sent += own * size * (count_ - 1);
    traffic.received += (first.back() - own) * size;
    note_wait(started);
  }

  /// MPI counts by int.
  template <class Visit>
  static void for_pieces(std::span<std::byte> bytes, const Visit& visit) {
    constexpr std::size_t kPiece = 1 << 30;
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(kPiece, bytes.size())))
      visit(bytes.data(), static_cast<int>(std::min(kPiece, bytes.size())));
  }

  int rank_ = 0, count_ = 1;
  Alike on_host_{1, 0}, on_cores_{1, 0};
  std::vector<int> counts_, places_;
  std::vector<MPI_Request> requests_;  ///< that have begun
};

}  // namespace

std::shared_ptr<Ranks> launched_ranks() {
  if (launched_count() == 1) return nullptr;
  auto ranks = std::make_shared<MpiRanks>();
  if (ranks->count() > 1) return ranks;
  if (launched_count() == 0) return nullptr;
  refuse_launch("the MPI of this program, " + rank_library() +
                ", sees one alone, and each would do the whole work; start them with the mpirun of this "
                "MPI, or one without a launcher");
}

std::string rank_library() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string whole(text.data());
  return whole.substr(0, whole.find_first_of(",\n"));
}

}  // namespace tread
