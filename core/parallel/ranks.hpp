#pragma once
// Processes that share the steps of a run. Rank 0 leads: it alone reads, writes, prints and decides.
//
// All ranks make the same calls in the same order, post() and receive() aside; each call returns once its
// data are there.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tread {

/// Calls that a rank has made.
struct RankTraffic {
  std::int64_t waits = 0;     ///< number of calls
  std::int64_t sent = 0;      ///< but for broadcasts [B]
  std::int64_t received = 0;  ///< but for broadcasts [B]
  double seconds = 0;         ///< time in the calls [s]
  double beside = 0;          ///< of it, in receive(), while the rank's other threads go on [s]

  RankTraffic& operator+=(const RankTraffic& more) {
    waits += more.waits;
    sent += more.sent;
    received += more.received;
    seconds += more.seconds;
    beside += more.beside;
    return *this;
  }
  friend RankTraffic operator-(const RankTraffic& a, const RankTraffic& b) {
    return {a.waits - b.waits, a.sent - b.sent, a.received - b.received, a.seconds - b.seconds,
            a.beside - b.beside};
  }
};

/// Bytes that go to another rank or come from it.
struct RankSegment {
  int rank;
  std::span<std::byte> bytes;
};

class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  virtual ~Ranks() = default;

  virtual int rank() const = 0;
  virtual int count() const = 0;
  /// Number of ranks, this one included, on this machine, and its place among them.
  virtual int on_host() const { return count(); }
  virtual int place_on_host() const { return rank(); }
  /// The same of those that may use the same of its cores.
  virtual int on_cores() const { return count(); }
  virtual int place_on_cores() const { return rank(); }

  /// Gives each rank the values of all: rank r has those of [first[r], first[r + 1]).
  template <class T>
  void gather(T* values, std::span<const std::int64_t> first) {
    gather_values(reinterpret_cast<std::byte*>(values), static_cast<int>(sizeof(T)), first);
  }
  /// Sends bytes to single ranks and receives theirs. What two ranks send one another has the order of both
  /// lists.
  virtual void exchange(std::span<const RankSegment> sent, std::span<const RankSegment> received) = 0;
  /// Begins to send bytes, which stay as they are until the next exchange(); it waits for their way.
  virtual void post(std::span<const RankSegment> sent) = 0;
  /// Waits for what other ranks post.
  virtual void receive(std::span<const RankSegment> received) = 0;
  /// Gives all ranks the bytes of rank 0. A rank that has to wait long for them leaves its core to others.
  void broadcast(std::span<std::byte> bytes);

  /// Ends the processes of all ranks; the launcher returns `code`.
  [[noreturn]] virtual void end_all(int code) = 0;

  /// True where copies of what another rank moves shall be spoilt, so that tests find out who reads them.
  virtual bool spoils_copies() const { return false; }

  RankTraffic traffic;
  /// Shares of the elements' work, by rank, by which the next fields are cut; empty: these choose them.
  std::vector<double> shares;
  /// Shares that the last fields got, in whole tiles; empty where other shares would not change them.
  std::vector<double> dealt;

 protected:
  /// Counts a call that began then. Returns its time [s].
  double note_wait(std::chrono::steady_clock::time_point started);

 private:
  virtual void broadcast_bytes(std::span<std::byte> bytes) = 0;
  /// `size`: 1, 4 or 8 bytes.
  virtual void gather_values(std::byte* values, int size, std::span<const std::int64_t> first) = 0;
};

/// Shares the steps of all runs that begin from here on among these ranks; null: none.
void choose_ranks(std::shared_ptr<Ranks> ranks);
std::shared_ptr<Ranks> chosen_ranks();

}  // namespace tread
