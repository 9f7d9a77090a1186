#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/bench/benchmarks.hpp"
#include "drivers/bench/rank_parts.hpp"
#include "drivers/engine/chosen_fields.hpp"
#include "drivers/engine/fields/node_fields.hpp"
#include "drivers/engine/ranks/rank_fields.hpp"
#include "drivers/engine/ranks/rank_shares.hpp"
#include "drivers/results/memory_need.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"

namespace tread {

namespace {

/// A rank whose others are not there: nobody sends it anything.
class LoneRank final : public Ranks {
 public:
  LoneRank(int rank, int count) : rank_(rank), count_(count) {}
  int rank() const override { return rank_; }
  int count() const override { return count_; }
  int on_host() const override { return 1; }
  void exchange(std::span<const RankSegment> /*sent*/, std::span<const RankSegment> /*received*/) override {}
  void post(std::span<const RankSegment> /*sent*/) override {}
  void receive(std::span<const RankSegment> /*received*/) override {}
  [[noreturn]] void end_all(int code) override { std::exit(code); }

 private:
  void broadcast_bytes(std::span<std::byte> /*bytes*/) override {}
  void gather_values(std::byte* /*values*/, int /*size*/, std::span<const std::int64_t> /*first*/) override {}
  int rank_, count_;
};

/// Elements, motion, ties and the packing of messages in the steps of one rank.
template <class Real, class U>
Measurement time_part(const Model& model, int rank, const BenchRanksOptions& options, StepLoads loads) {
  RankFields<Real, U> fields(model, std::make_shared<LoneRank>(rank, options.ranks));
  const auto step = [&] {
    fields.follow_patch(loads.frame, loads.dt);
    fields.internal_force_and_move(loads, false);
    if (model.ties) model.ties->hand_over(fields.force(), fields.tie_items());
    fields.move_rest(loads, false);
    if (model.ties) model.ties->follow({fields.displacement(), fields.velocity()}, fields.tie_items());
    fields.advance_lag(loads.dt);
  };
  return measure({step}, options.plan);
}

Measurement time_part(const Model& model, int rank, const BenchRanksOptions& options,
                      const StepLoads& loads) {
  if (model.scene.precision == "single") return time_part<float, float>(model, rank, options, loads);
  if (model.scene.precision == "mixed") return time_part<float, double>(model, rank, options, loads);
  return time_part<double, double>(model, rank, options, loads);
}

/// A speed of rolling at the start, with a step that the stiffest element bears.
StepLoads loads_of(const Model& model) {
  double omega = 0;
  for (int block = 0; block < static_cast<int>(model.mesh.blocks.size()); ++block)
    omega = std::max(omega, model.internal->max_frequency(block).omega);
  StepLoads loads{model.scene.motion->step_safety * 2 / omega, model.scene.gravity, {}};
  if (!model.scene.wheel) return loads;
  loads.frame.origin = {model.scene.start_x(), 0, model.contact ? model.contact->touching_height() : 0};
  loads.frame.velocity = {model.scene.motion->speed, 0, 0};
  loads.frame.spin = model.scene.motion->speed / model.wheel_radius();
  return loads;
}

struct RankRow {
  int rank;
  RankPart part;
  std::int64_t memory;              ///< of displacement, velocity and force [B]
  std::int64_t sent, received;      ///< in a step [B]
  std::optional<Measurement> step;  ///< timed, without contact
};

class RankRows {
 public:
  RankRows(const Model& model, const std::vector<RankPart>& parts) {
    const ValueBytes bytes = value_bytes(model.scene);
    const int moved = bytes.displacement + bytes.other;
    for (const RankPart& part : parts)
      rows_.push_back({static_cast<int>(rows_.size()), part,
                       (part.own + part.halo) * kGroupValues * (bytes.displacement + 2 * bytes.other),
                       part.sent * bytes.other + part.sent_motion * moved,
                       part.received * bytes.other + part.received_motion * moved, std::nullopt});
  }

  void time(int rank, const Measurement& step) { rows_[index(rank)].step = step; }

  void print(bool json) const { fmt::print("{}", json ? lines() : plain_text(table())); }

 private:
  /// Time of a unit of cost, in the mean of the timed parts [s]. Rank 0's is left out unless it is the only
  /// one, because it packs for all others. 0: there is none.
  double mean_unit() const {
    double sum = 0;
    int parts = 0;
    for (const bool first : {false, true})
      for (const RankRow& row : rows_) {
        if (!row.step || row.part.cost == 0 || (row.rank == kContactRank) != first || (first && parts > 0))
          continue;
        sum += row.step->seconds / static_cast<double>(row.part.cost);
        ++parts;
      }
    return parts > 0 ? sum / parts : 0;
  }
  /// Timed step over the predicted one without contact, less one; nothing where either is missing.
  static std::optional<double> deviation(const RankRow& row, double unit) {
    const double alone = unit * static_cast<double>(row.part.cost);
    if (!row.step || alone == 0) return std::nullopt;
    return row.step->seconds / alone - 1;
  }
  /// Time of a step with contact [s].
  static double predicted(const RankRow& row, double unit) {
    return unit * static_cast<double>(row.part.cost + row.part.contact);
  }

  Table table() const {
    const double unit = mean_unit();
    Table table{"",
                {{"Rank", Align::right},
                 {"Elements", Align::right},
                 {"Nodes of others", Align::right},
                 {"Fields", Align::right},
                 {"Ranks beside", Align::right},
                 {"Sent a step", Align::right},
                 {"Received", Align::right},
                 {"Step, predicted, us", Align::right},
                 {"Timed, us", Align::right},
                 {"Spread", Align::right},
                 {"Deviation", Align::right}},
                {}};
    for (const RankRow& row : rows_) {
      const std::optional<double> off = deviation(row, unit);
      table.rows.push_back(
          {std::to_string(row.rank), grouped(row.part.elements), grouped(row.part.halo * kLanes),
           bytes_text(row.memory), std::to_string(row.part.neighbours), bytes_text(row.sent),
           bytes_text(row.received), unit > 0 ? fmt::format("{:.1f}", 1e6 * predicted(row, unit)) : "",
           row.step ? fmt::format("{:.1f}", 1e6 * row.step->seconds) : "",
           row.step ? fmt::format("{:.0f} %", 100 * row.step->spread) : "",
           off ? fmt::format("{:+.0f} %", 100 * *off) : ""});
    }
    return table;
  }

  std::string lines() const {
    std::string text;
    const double unit = mean_unit();
    for (const RankRow& row : rows_) {
      Json json = {{"rank", row.rank},
                   {"elements", row.part.elements},
                   {"cost", row.part.cost},
                   {"node_slots_own", row.part.own * kLanes},
                   {"node_slots_of_others", row.part.halo * kLanes},
                   {"fields_B", row.memory},
                   {"ranks_beside", row.part.neighbours},
                   {"sent_B", row.sent},
                   {"received_B", row.received}};
      if (unit > 0) json["predicted_seconds_per_step"] = predicted(row, unit);
      if (row.step) {
        json["seconds_per_step"] = row.step->seconds;
        json["spread"] = row.step->spread;
      }
      if (const auto off = deviation(row, unit)) json["deviation"] = *off;
      text += json_line(json);
    }
    return text;
  }

  std::vector<RankRow> rows_;
};

/// Throws InputError for more ranks than pieces of work: a piece is a tile, or tiles that the loop takes
/// together.
void require_pieces(const std::vector<TileWork>& work, int ranks) {
  const auto pieces = std::ranges::count_if(work, [](const TileWork& tile) { return !tile.with_next; });
  if (ranks > pieces)
    throw InputError(fmt::format(
        "bench ranks: --ranks {}: the mesh has {} pieces that ranks can share; state {} at most, or a "
        "smaller scene.element_size",
        ranks, pieces, pieces));
}

}  // namespace

void bench_ranks(const ResolvedScene& resolved, const BenchRanksOptions& options) {
  use_threads(options.threads);
  const Scene& scene = resolved.scene;
  if (!scene.motion)
    throw InputError("bench ranks: the scene has no [motion], so there are no steps to share; add one");
  for (const int part : options.parts)
    if (part >= options.ranks)
      throw InputError(fmt::format("bench ranks: --parts {}: there are the ranks 0 to {}; state some of them",
                                   part, options.ranks - 1));
  require_no_bodies(scene, "bench ranks");
  const auto& corrugation = scene.corrugation;
  const auto centre = corrugation ? std::optional(corrugation->centre.value_or(0)) : std::nullopt;
  const Model model(scene, centre, require_memory_of_mesh);
  const StepLoads loads = loads_of(model);
  const std::vector<TileWork> work = tile_work(model, *model.internal);
  require_pieces(work, options.ranks);
  const RankCut cut(model, work, expected_shares(model, work, options.ranks));
  SharedGroups groups(model, cut);
  groups.follow(loads.frame, 70 * loads.dt);
  RankRows rows(model, rank_parts(model, cut, work, groups));
  for (const int part : options.parts) rows.time(part, time_part(model, part, options, loads));
  rows.print(options.json);
}

}  // namespace tread
