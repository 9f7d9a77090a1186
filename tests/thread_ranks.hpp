#pragma once
// Ranks that are threads of one process. Copies of what another rank moves are NaN, so whoever reads them
// without fetching them is found out.

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "drivers/engine/simulation.hpp"
#include "kernels/device/device.hpp"
#include "tests/device_cases.hpp"
#include "tests/state_copies.hpp"

namespace tread::samples {

/// Bytes on their way from one thread to another.
class Mail {
 public:
  void put(int from, int to, std::span<const std::byte> bytes) {
    const std::lock_guard held(lock_);
    letters_[{from, to}].emplace_back(bytes.begin(), bytes.end());
    arrived_.notify_all();
  }
  std::vector<std::byte> take(int from, int to) {
    std::unique_lock held(lock_);
    auto& letters = letters_[{from, to}];
    arrived_.wait(held, [&] { return !letters.empty(); });
    std::vector<std::byte> letter = std::move(letters.front());
    letters.pop_front();
    return letter;
  }

 private:
  std::mutex lock_;
  std::condition_variable arrived_;
  std::map<std::pair<int, int>, std::deque<std::vector<std::byte>>> letters_;
};

/// Where threads of a process find one another.
struct Meeting {
  explicit Meeting(int count)
      : barrier(count), values(static_cast<std::size_t>(count)), sent(static_cast<std::size_t>(count)) {}
  Mail mail;
  std::barrier<> barrier;
  std::vector<std::byte*> values;
  std::vector<std::span<const RankSegment>> sent;
};

class ThreadRanks final : public Ranks {
 public:
  ThreadRanks(std::shared_ptr<Meeting> meeting, int rank) : meeting_(std::move(meeting)), rank_(rank) {}

  int rank() const override { return rank_; }
  int count() const override { return static_cast<int>(meeting_->values.size()); }
  bool spoils_copies() const override { return true; }
  void end_all(int code) override { std::exit(code); }

  void exchange(std::span<const RankSegment> sent, std::span<const RankSegment> received) override {
    meeting_->sent[static_cast<std::size_t>(rank_)] = sent;
    meeting_->barrier.arrive_and_wait();
    std::vector<std::size_t> next(meeting_->sent.size(), 0);
    for (const RankSegment& segment : received) {
      const std::span<const RankSegment> from = meeting_->sent[static_cast<std::size_t>(segment.rank)];
      std::size_t& at = next[static_cast<std::size_t>(segment.rank)];
      while (at < from.size() && from[at].rank != rank_) ++at;
      ASSERT_LT(at, from.size()) << "rank " << rank_ << " waits for more than rank " << segment.rank
                                 << " sends";
      ASSERT_EQ(from[at].bytes.size(), segment.bytes.size());
      std::ranges::copy(from[at++].bytes, segment.bytes.begin());
      traffic.received += std::ssize(segment.bytes);
    }
    meeting_->barrier.arrive_and_wait();
  }

  void post(std::span<const RankSegment> sent) override {
    for (const RankSegment& segment : sent) meeting_->mail.put(rank_, segment.rank, segment.bytes);
  }
  void receive(std::span<const RankSegment> received) override {
    for (const RankSegment& segment : received) {
      const std::vector<std::byte> letter = meeting_->mail.take(segment.rank, rank_);
      ASSERT_EQ(letter.size(), segment.bytes.size());
      std::memcpy(segment.bytes.data(), letter.data(), letter.size());
    }
  }

 private:
  void broadcast_bytes(std::span<std::byte> bytes) override {
    meeting_->values[static_cast<std::size_t>(rank_)] = bytes.data();
    meeting_->barrier.arrive_and_wait();
    if (rank_ != 0) std::memcpy(bytes.data(), meeting_->values[0], bytes.size());
    meeting_->barrier.arrive_and_wait();
  }

  void gather_values(std::byte* values, int size, std::span<const std::int64_t> first) override {
    meeting_->values[static_cast<std::size_t>(rank_)] = values;
    meeting_->barrier.arrive_and_wait();
    for (std::size_t other = 0; other + 1 < first.size(); ++other) {
      if (other == static_cast<std::size_t>(rank_)) continue;
      const std::int64_t from = first[other] * size;
      if (first[other + 1] == first[other]) continue;
      std::memcpy(values + from, meeting_->values[other] + from,
                  static_cast<std::size_t>(first[other + 1] * size - from));
    }
    meeting_->barrier.arrive_and_wait();
  }

  std::shared_ptr<Meeting> meeting_;
  int rank_;
};

/// A run that goes on, on several ranks.
class SharedRun {
 public:
  using Devices = std::function<std::shared_ptr<Device>()>;

  /// From the state of `before`. `shares`: of the work, by rank; none: the expected ones. `devices`: makes
  /// one for each rank; none: processors.
  SharedRun(const PreloadedScene& of, Simulation& before, int count, const std::vector<double>& shares = {},
            const Devices& devices = {}) {
    const auto meeting = std::make_shared<Meeting>(count);
    for (int rank = 0; rank < count; ++rank) {
      models_.push_back(std::make_unique<Model>(of.scene(), of.deepest()));
      const auto ranks = ranks_.emplace_back(std::make_shared<ThreadRanks>(meeting, rank));
      ranks->shares = shares;
      choose_ranks(ranks);
      if (devices) choose_device(devices());
      simulations_.push_back(std::make_unique<Simulation>(*models_.back(), of.patch_y(), of.dt()));
      choose_ranks(nullptr);
      choose_device(std::shared_ptr<Device>());
      simulations_.back()->set_sampling_interval(PreloadedScene::kSampling);
      copy(before.state(), simulations_.back()->state());
      models_.back()->keep_masses(simulations_.back()->groups_with_mass());
      if (rank > 0) spoil(simulations_.back()->unshared_state());
    }
    on_threads([](Simulation& simulation) {
      simulation.spread();
      simulation.fields();  // as at the checkpoint before the first step
    });
  }

  /// Until so many steps are taken; then rank 0 has all fields.
  void roll_on(std::int64_t steps) const {
    on_threads([steps](Simulation& simulation) {
      while (simulation.steps() < steps) simulation.step();
      simulation.fields();
    });
  }
  Simulation& front() const { return *simulations_.front(); }
  const std::vector<std::unique_ptr<Simulation>>& simulations() const { return simulations_; }
  /// Bytes that rank 0 has got from single ranks in exchanges.
  std::int64_t received() const { return ranks_.front()->traffic.received; }

 private:
  template <class Call>
  void on_threads(const Call& call) const {
    std::vector<std::thread> threads;
    for (const auto& simulation : simulations_)
      threads.emplace_back([&call, &simulation] { call(*simulation); });
    for (std::thread& thread : threads) thread.join();
  }
  static void spoil(const StateList& list) {
    for (const StateList::Field& field : list.fields())
      std::visit(
          [](auto values) {
            std::fill(values.begin(), values.end(), std::numeric_limits<double>::quiet_NaN());
          },
          field.values);
  }

  std::vector<std::shared_ptr<ThreadRanks>> ranks_;
  std::vector<std::unique_ptr<Model>> models_;
  std::vector<std::unique_ptr<Simulation>> simulations_;
};

}  // namespace tread::samples
