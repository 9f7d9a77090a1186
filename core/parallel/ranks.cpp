#include "core/parallel/ranks.hpp"

#include <utility>

namespace tread {

namespace {

std::shared_ptr<Ranks>& chosen() {
  static std::shared_ptr<Ranks> ranks;
  return ranks;
}

}  // namespace

void Ranks::broadcast(std::span<std::byte> bytes) {
  const auto started = std::chrono::steady_clock::now();
  broadcast_bytes(bytes);
  note_wait(started);
}

double Ranks::note_wait(std::chrono::steady_clock::time_point started) {
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  ++traffic.waits;
  traffic.seconds += seconds;
  return seconds;
}

void choose_ranks(std::shared_ptr<Ranks> ranks) {
  chosen() = std::move(ranks);
}

std::shared_ptr<Ranks> chosen_ranks() {
  return chosen();
}

}  // namespace tread
