#include "drivers/run/followers.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <optional>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/process/interruption.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/results/memory_need.hpp"
#include "drivers/run/program_hash.hpp"
#include "drivers/run/run_checkpoint.hpp"
#include "drivers/run/run_model.hpp"
#include "io/report/plain_text.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

enum class Word : std::int64_t { device, begin, step, fetch, times, end, dismiss };

template <class T>
void broadcast_value(Ranks& ranks, T& value) {
  ranks.broadcast(std::as_writable_bytes(std::span(&value, 1)));
}

void say(Ranks& ranks, Word word) {
  broadcast_value(ranks, word);
}

Word next_word(Ranks& ranks) {
  Word word = Word::dismiss;
  broadcast_value(ranks, word);
  return word;
}

/// Text or array of rank 0.
template <class Values>
void broadcast_values(Ranks& ranks, Values& values) {
  auto count = static_cast<std::int64_t>(values.size());
  broadcast_value(ranks, count);
  values.resize(static_cast<std::size_t>(count));
  ranks.broadcast(std::as_writable_bytes(std::span(values.data(), values.size())));
}

/// A value of the type with this index.
template <std::size_t i = 0>
SealedValues empty_values(std::size_t type) {
  if constexpr (i + 1 < std::variant_size_v<SealedValues>)
    if (type != i) return empty_values<i + 1>(type);
  return std::variant_alternative_t<i, SealedValues>{};
}

void send(Ranks& ranks, SealedContent content) {
  auto count = static_cast<std::int64_t>(content.size());
  broadcast_value(ranks, count);
  while (!content.empty()) {
    auto entry = content.extract(content.begin());
    broadcast_values(ranks, entry.key());
    auto type = static_cast<std::int64_t>(entry.mapped().index());
    broadcast_value(ranks, type);
    std::visit([&](auto& values) { broadcast_values(ranks, values); }, entry.mapped());
  }
}

SealedContent receive(Ranks& ranks) {
  SealedContent content;
  std::int64_t count = 0;
  broadcast_value(ranks, count);
  for (; count > 0; --count) {
    std::string name;
    broadcast_values(ranks, name);
    std::int64_t type = 0;
    broadcast_value(ranks, type);
    SealedValues& entry = content[name] = empty_values(static_cast<std::size_t>(type));
    std::visit([&](auto& values) { broadcast_values(ranks, values); }, entry);
  }
  return content;
}

const std::string kThreads = "ranks/threads";
const std::string kBackend = "ranks/backend";
const std::string kBound = "ranks/bound";
const std::string kShares = "ranks/shares";
const std::string kProgram = "ranks/program";  ///< program_hash()

/// The run of rank 0 on this rank.
class FollowedRun {
 public:
  FollowedRun(const SealedContent& content, Ranks& ranks) : ranks_(&ranks) {
    if (sealed_value<std::int64_t>(content, kProgram) != static_cast<std::int64_t>(program_hash()))
      throw ResourceError(
          "this program has other bytes than that of rank 0; start all ranks with the same program");
    ranks.shares = sealed_entry<std::vector<double>>(content, kShares);
    use_threads({static_cast<int>(sealed_value<std::int64_t>(content, kThreads)),
                 sealed_entry<std::string>(content, kBackend),
                 sealed_value<std::int64_t>(content, kBound) != 0});
    const RunOrder order = unpack_order(content);
    unpack_results(content, results_);
    const ResolvedScene made = resolve_scene(order.scene, order.overrides);
    model_.emplace(made.scene, deepest_line(made.scene, results_.preload), require_memory);
    adopt_later_values(*model_, resolve_with_later(order).scene);
    if (const std::string other = other_origin(content, *model_); !other.empty())
      throw ResourceError(fmt::format(
          "{}, so ranks would not have the same bits; start all of them with the same program, and "
          "the environment's TREAD_INSTRUCTION_SET=avx2 on different processors",
          other));
    simulation_.emplace(*model_, results_.preload.contact.centre.y, results_.dt);
    unpack_followed(content, *model_, *simulation_);
    model_->keep_masses(simulation_->groups_with_mass());
    simulation_->set_sampling_interval(sampling_interval(model_->scene, results_.dt));
  }

  /// Gets the nodes' values, once the content is gone.
  void take_values() { simulation_->spread(); }

  /// Steps and fetches until another word.
  Word follow() {
    for (Word word = next_word(*ranks_);; word = next_word(*ranks_)) {
      if (word == Word::step)
        clock_.time(*ranks_, [this] { step(); });
      else if (word == Word::fetch)
        simulation_->fields();
      else if (word == Word::times)
        clock_.take(*ranks_);
      else
        return word;
    }
  }

 private:
  /// Every rank meets a numerical error in the same step; rank 0 reports it and ends all. If it goes on, it
  /// has met none.
  void step() {
    if (error_) std::rethrow_exception(error_);
    try {
      simulation_->step();
    } catch (const NumericalError&) {
      error_ = std::current_exception();
    }
  }

  Ranks* ranks_;
  RankClock clock_;
  RunResults results_;
  std::optional<Model> model_;
  std::optional<Simulation> simulation_;
  std::exception_ptr error_;  ///< of the last step
};

/// ResourceError where the chosen device is not rank 0's: ranks would not have the same bits.
void require_device(const std::string& of_rank_0, int rank) {
  if (device_name() == of_rank_0) return;
  throw ResourceError(
      fmt::format("rank {} has {}, rank 0 has {}; state --device gpu:N, or let CUDA_VISIBLE_DEVICES show "
                  "equal cards",
                  rank, device_name(), of_rank_0));
}

/// Until a word that is not about the run.
Word follow_run(Ranks& ranks) {
  FollowedRun run(receive(ranks), ranks);
  run.take_values();
  return run.follow();
}

}  // namespace

Followers::Followers() : ranks_(chosen_ranks()) {}

void Followers::begin(SealedContent run, Simulation& simulation, const ThreadOptions& threads) {
  if (absent()) return;
  clock_ = {};
  leave_to_spread(simulation, run);
  say(*ranks_, Word::begin);
  run[kThreads] = std::vector<std::int64_t>{threads.number};
  run[kBackend] = threads.backend;
  run[kBound] = std::vector<std::int64_t>{threads.bind ? 1 : 0};
  run[kShares] = ranks_->shares;
  run[kProgram] = std::vector<std::int64_t>{static_cast<std::int64_t>(program_hash())};
  send(*ranks_, std::move(run));
  simulation.spread();
  begin_seconds_ = clock_.passed();
  clock_ = {};
}

void Followers::step(Simulation& simulation) {
  if (absent()) return simulation.step();
  const RankTraffic before = ranks_->traffic;
  say(*ranks_, Word::step);
  clock_.time(*ranks_, [&] { simulation.step(); });
  traffic_ += ranks_->traffic - before;
}

bool Followers::find_better_shares(double left) {
  constexpr int kLonger = 4;         // each interval than the last
  constexpr double kGain = 0.03;     // part of a step that is saved
  constexpr double kWorthwhile = 2;  // saved time over that of begin(): as measured, it may not come true
  if (absent() || ranks_->dealt.empty() || clock_.steps() < interval_) return false;
  interval_ *= kLonger;
  say(*ranks_, Word::times);
  const std::vector<double> worked = clock_.take(*ranks_);
  const TimedShares now{ranks_->shares, *std::max_element(worked.begin(), worked.end())};
  const std::optional<TimedShares> before = std::exchange(before_, std::nullopt);
  const bool worse = before && before->seconds < now.seconds;
  const TimedShares next = worse ? *before : evened_shares(ranks_->dealt, worked);
  const double saved = 1 - next.seconds / now.seconds;
  if (saved < kGain || saved * left < kWorthwhile * begin_seconds_) return false;
  if (!worse) before_ = now;
  ranks_->shares = next.shares;
  return true;
}

void Followers::fetch(const Simulation& simulation) const {
  if (absent()) return;
  say(*ranks_, Word::fetch);
  simulation.fields();
}

void Followers::end() const {
  if (absent()) return;
  say(*ranks_, Word::end);
  ranks_->shares.clear();
}

std::string Followers::shares() const {
  const auto [least, most] = std::minmax_element(ranks_->shares.begin() + 1, ranks_->shares.end());
  return fmt::format("elements of rank 0: {:.1f} %, of each other: {:.1f} to {:.1f} %",
                     100 * ranks_->shares[0], 100 * *least, 100 * *most);
}

std::string Followers::description(std::int64_t steps) const {
  std::string text = fmt::format("{} ranks, threads of each: {}", ranks_->count(), threads());
  if (steps == 0) return text;
  const auto per_step = [steps](auto sum) { return static_cast<double>(sum) / static_cast<double>(steps); };
  return text +
         fmt::format("; in a step rank 0 sends {:.0f} B, receives {:.0f} B, waits {:.2f} times, {:.1f} us",
                     per_step(traffic_.sent), per_step(traffic_.received), per_step(traffic_.waits),
                     1e6 * per_step(traffic_.seconds));
}

void follow(Ranks& ranks) {
  // Rank 0 obeys signals. The launcher sends them to all.
  for (const StopSignal& signal : kStopSignals) std::signal(signal.number, SIG_IGN);
  std::signal(SIGUSR1, SIG_IGN);
  for (Word word = next_word(ranks); word != Word::dismiss;) {
    if (word == Word::device) {
      std::string name;
      std::string of_rank_0;
      broadcast_values(ranks, name);
      broadcast_values(ranks, of_rank_0);
      choose_device(name, ranks.place_on_host());
      require_device(of_rank_0, ranks.rank());
    }
    word = word == Word::begin ? follow_run(ranks) : next_word(ranks);
  }
}

void choose_devices(Ranks& ranks, const std::string& name) {
  choose_device(name, ranks.place_on_host());
  std::string of_others = !chosen_device() ? "cpu" : name == "auto" ? "gpu" : name;
  std::string of_rank_0 = device_name();
  say(ranks, Word::device);
  broadcast_values(ranks, of_others);
  broadcast_values(ranks, of_rank_0);
}

void dismiss(Ranks& ranks) {
  say(ranks, Word::dismiss);
}

}  // namespace tread
