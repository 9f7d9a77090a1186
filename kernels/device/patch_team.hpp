#pragma once
// Patch and tractions of a step by one team of threads, with the numbers of PatchCells and PatchSolver.
// Written once for a GPU and for its emulation. [docs/records/device.md]
//
// An iteration waits for memory, not for arithmetic: what it touches lies in the memory that the threads
// share, as far as that goes, and an item reads a cell's weights or nodes once for all that it adds.

#include <cmath>
#include <cstdint>
#include <new>

#include "kernels/contact/patch_point_body.hpp"
#include "kernels/device/contact_layout.hpp"
#include "kernels/device/patch_links.hpp"
#include "kernels/lanes/patch_respond_body.hpp"

namespace tread {

template <class Law, class Team>
class PatchTeam {
 public:
  TREAD_BODY PatchTeam(const Team& team, const ContactTask& task, const Law& law, typename Law::State* state)
      : team_(team),
        task_(task),
        law_(law),
        state_(state),
        sums_(team.template share<double>(kSums * kParts)),
        ends_(team.template share<int>(1)),
        links_(team, PatchArena(team.spare()), task.links) {}

  TREAD_BODY void run() {
    wake_faces();
    number_points();
    if (points_ > 0) {
      links_.link({task_.candidates.point, task_.origin}, points_, task_.inverse_mass);
      solve();
      record();
    }
    sum_up();
  }

 private:
  static constexpr int kParts = 32;  ///< of sums over the points
  static constexpr int kSums = PointOutcome::kSums;

  /// Sets when faces that were searched may close.
  TREAD_BODY void wake_faces() const {
    const FaceWindow& window = task_.window;
    team_.for_each(window.stations * window.edges, [&](int i) {
      double& wake = task_.wake_time[window.face(i)];
      if (task_.bounds.time < wake) return;
      double smallest = task_.candidates.gap[std::int64_t{i} * window.points];
      for (int k = 1; k < window.points; ++k) {
        const double gap = task_.candidates.gap[std::int64_t{i} * window.points + k];
        if (gap < smallest) smallest = gap;
      }
      wake = task_.bounds.wake_time(smallest);
    });
  }

  /// Numbers the candidates that were kept, in their order.
  TREAD_BODY void number_points() {
    const FaceWindow& window = task_.window;
    const int faces = window.stations * window.edges;
    const Candidates& from = task_.candidates;
    points_ = team_.number(
        faces * window.points, [&](int i) { return from.kept[i]; },
        [&](int i, int place) {
          if (i % window.points == 0) task_.record.first_point[i / window.points] = place;
          if (from.kept[i] != 0) task_.origin[place] = i;
        });
    team_.for_each(1, [&](int) {
      task_.record.first_point[faces] = points_;
      ends_[0] = 0;
    });
  }

  TREAD_BODY ContactPoint& point(int i) const { return task_.candidates.point[task_.origin[i]]; }
  TREAD_BODY TeamTile& tile(int i) const { return tile_[i / kLanes]; }
  TREAD_BODY PointLane lane(int i) const { return {tile(i), static_cast<std::size_t>(i % kLanes)}; }
  TREAD_BODY double sum(int i, int c) const {
    return sum_[3 * links_.links().place[i] + c] + sum_[3 * links_.links().place[points_ + i] + c];
  }
  /// Velocity of the wheel against the rail.
  TREAD_BODY double velocity(int i, int c) const { return tile(i).free[c][i % kLanes] + sum(i, c); }
  TREAD_BODY static void put(double* vectors, int i, const Vec3& value) {
    for (int c = 0; c < 3; ++c) vectors[3 * i + c] = value[c];
  }

  TREAD_BODY void solve() {
    make_room();
    set_free();
    team_.for_each(points_, [&](int i) { fill(i); });
    sum_impulses();
    set_mobilities();
    iterate_from_near();
    team_.for_each(points_, [&](int i) { put(impulse_, i, vector_of(lane(i).settle(point(i)))); });
    sum_impulses();
    finish();
  }

  TREAD_BODY void make_room() {
    const PatchVectors& room = task_.vectors;
    PatchArena& arena = links_.arena();
    impulse_ = arena.keep(3 * points_, room.impulse);
    change_ = arena.keep(3 * links_.nodes(), room.change);
    // Sums by cell are read before those by entry are written, and the other way round.
    const int sums = kSumStride * links_.cells();
    cell_sum_ = arena.keep(sums > 6 * points_ ? sums : 6 * points_, room.cell_sum);
    sum_ = cell_sum_;
    near_ = arena.near();
    tile_ = arena.keep((points_ + kLanes - 1) / kLanes, room.tile);
  }

  /// The compiler of a card is told where the arrays lie: loads of shared memory are shorter than those from
  /// anywhere.
  TREAD_BODY void iterate_from_near() {
    if (!near_) {
      iterate();
      return;
    }
    name_near();
    if (links_.arena().near()) {
      tile_ = team_.near(tile_);
      iterate();
    } else {
      tile_ = task_.vectors.tile;
      iterate();
    }
  }
  TREAD_BODY void name_near() {
    links_.name_near();
    impulse_ = team_.near(impulse_);
    change_ = team_.near(change_);
    cell_sum_ = team_.near(cell_sum_);
    sum_ = cell_sum_;
  }

  /// Sets `change` to the inverse mass times the weighted sum of the points' impulses.
  TREAD_BODY void to_nodes() const {
    const PatchLinks& l = links_.links();
    team_.for_each(3 * links_.cells(), [&](int i) {
      const int cell = i / 3;
      const int c = i % 3;
      double part[kCellNodes] = {};
      const int end = l.first_entry[cell + 1];
      for (int e = l.first_entry[cell]; e < end; ++e) {
        const LinkedEntry& entry = l.entry[e];
        const double value = impulse_[3 * entry.point + c];
        for (int k = 0; k < kCellNodes; ++k) part[k] += node_part(entry.weights, k, value);
      }
      double* const to = cell_sum_ + cell * kSumStride + c;
      for (int k = 0; k < kCellNodes; ++k) to[3 * k] = part[k];
    });
    team_.for_each(3 * links_.nodes(), [&](int i) {
      const int node = i / 3;
      const double* const sums = cell_sum_ + i % 3;
      const int end = l.first_term[node + 1];
      double all = 0;
      for (int t = l.first_term[node]; t < end; ++t) all += sums[l.term[t]];
      change_[i] = all * l.inverse_mass[node];
    });
  }

  /// Sets the sums by entry to the points' weighted sums of the nodes' vectors.
  TREAD_BODY void to_points() const {
    const PatchLinks& l = links_.links();
    team_.for_each(3 * links_.cells(), [&](int i) {
      const int cell = i / 3;
      const int c = i % 3;
      double value[kCellNodes];
      for (int k = 0; k < kCellNodes; ++k) value[k] = change_[l.cell_node[cell * kCellStride + k] + c];
      const int end = l.first_entry[cell + 1];
      for (int e = l.first_entry[cell]; e < end; ++e)
        sum_[3 * e + c] = point_sum<double>(l.entry[e].weights, [&](int k) { return value[k]; });
    });
  }

  TREAD_BODY void sum_impulses() const {
    to_nodes();
    to_points();
  }

  /// Sets the nodes' and the points' velocities without contact.
  TREAD_BODY void set_free() const {
    const PatchLinks& l = links_.links();
    team_.for_each(links_.nodes(), [&](int n) {
      const PatchNode& node = l.node[n];
      const Vec3 velocity = task_.v.at(node.slot);
      put(change_, n, node.of_wheel != 0 ? globalise(node.cosine, node.sine, velocity) : -1 * velocity);
    });
    to_points();
  }

  /// Sets the constants of a point, and a unit pressure.
  TREAD_BODY void fill(int i) const {
    const ContactPoint& of = point(i);
    const Vec3 frame = frame_velocity(of, task_.wheel);
    for (int c = 0; c < 3; ++c) tile(i).free[c][i % kLanes] = frame[c] + sum(i, c);
    lane(i).fill(of, task_.dt);
    rub(i);
    put(impulse_, i, {0.5 * task_.dt * task_.dt * of.area, 0, 0});
  }

  TREAD_BODY void rub(int i) const {
    if constexpr (FrictionOf<Law>::kHasState) {
      lane(i).rub(point(i), law_, state_[point(i).history], task_.dt);
    } else {
      typename Law::State none{};
      lane(i).rub(point(i), law_, none, task_.dt);
    }
  }

  /// PatchCells::own_mobility, in place of the second component of the sums, which unit pressures do not use.
  TREAD_BODY void set_mobilities() const {
    const PatchLinks& l = links_.links();
    team_.for_each(links_.cells(), [&](int cell) {
      double mobility[kCellNodes];
      for (int k = 0; k < kCellNodes; ++k)
        mobility[k] = l.inverse_mass[l.cell_node[cell * kCellStride + k] / 3];
      for (int e = l.first_entry[cell]; e < l.first_entry[cell + 1]; ++e) {
        const PatchWeights& weights = l.entry[e].weights;
        double own = 0;
        for (int k = 0; k < kCellNodes; ++k) {
          const double weight = weights.along[k / 4] * weights.across[k % 4];
          own += weight * weight * mobility[k];
        }
        sum_[3 * e + 1] = own;
      }
    });
  }

  /// Guesses the tractions under compliance(point).
  template <class Compliance>
  TREAD_BODY HeavyBall begin(const Compliance& compliance) const {
    const LargestPair largest = team_.largest(points_, [&](int i) {
      const double own = compliance(i);
      tile(i).compliance[i % kLanes] = own;
      put(impulse_, i, vector_of(lane(i).guess(point(i), task_.springs, task_.dt)));
      return LargestPair{own, 0};
    });
    return {task_.springs, largest.first};
  }

  /// Returns the largest change and the largest pressure, the former squared.
  TREAD_BODY LargestPair respond(const PointIteration& iteration) const {
    return team_.largest(points_, [&](int i) {
      const double motion[3] = {velocity(i, 0), velocity(i, 1), velocity(i, 2)};
      double impulse[3];
      respond_in(tile(i), OneLane{i % kLanes}, iteration, motion, impulse);
      for (int c = 0; c < 3; ++c) impulse_[3 * i + c] = impulse[c];
      return LargestPair{tile(i).change[i % kLanes], tile(i).response[0][i % kLanes]};
    });
  }

  /// PatchSolver::iterate
  TREAD_BODY void iterate() const {
    HeavyBall ball = begin([&](int i) {
      const double own = 0.5 * task_.dt * task_.dt * point(i).area * sum(i, 1);
      const double all = sum(i, 0);
      return own < all ? all : own;
    });
    double first = 0;
    for (int iteration = 1; iteration <= kMostIterations; ++iteration) {
      sum_impulses();
      const LargestPair largest = respond(ball.next(task_.springs, task_.dt));
      const double change = std::sqrt(largest.first);
      if (change <= kTractionTolerance * largest.second) break;
      if (iteration == 1) first = change;
      if (change > kDivergence * first)
        ball = begin([&](int i) { return 2 * tile(i).compliance[i % kLanes]; });
    }
  }

  /// The points' outcomes lie where their weights lay, which no one reads any more.
  TREAD_BODY PointOutcome* outcomes() const {
    static_assert(sizeof(PointOutcome) <= 2 * sizeof(LinkedEntry));
    return reinterpret_cast<PointOutcome*>(links_.links().entry);
  }

  /// Outcomes of the points, and motion of the nodes.
  TREAD_BODY void finish() const {
    const NodeKick kick(task_.wheel.spin, task_.dt);
    team_.for_each(points_ + links_.nodes(), [&](int i) {
      if (i < points_)
        finish_point(i);
      else
        write_back(kick, i - points_);
    });
  }

  TREAD_BODY void finish_point(int i) const {
    ContactPoint& of = point(i);
    set_speeds(of, {velocity(i, 0), velocity(i, 1), velocity(i, 2)});
    if constexpr (FrictionOf<Law>::kHasState)
      if (of.pressure <= 0) state_[of.history] = {};
    const PointWork work = settle_history(of, task_.history[of.history], task_.springs, task_.dt);
    const Vec3 force = of.area * of.traction();
    new (outcomes() + i) PointOutcome{of.pressure,
                                      of.shear,
                                      of.frictional_work,
                                      {of.area * of.face_share[0], of.area * of.face_share[1],
                                       of.area * of.face_share[2], of.area * of.face_share[3]},
                                      {force.x, force.y, force.z, work.frictional, work.damping}};
    if (of.pressure > 0 && at_the_end(of)) team_.add(ends_, 1);
  }

  TREAD_BODY bool at_the_end(const ContactPoint& of) const {
    return task_.end.has(of.face[1], task_.quadrature[of.history % task_.window.points].across,
                         of.position.x - task_.wheel.origin.x);
  }

  TREAD_BODY void write_back(const NodeKick& kick, int n) const {
    const PatchNode& node = links_.links().node[n];
    const Vec3 of_node = {change_[3 * n], change_[3 * n + 1], change_[3 * n + 2]};
    const Vec3 change = kick.local(of_node, node.of_wheel != 0, node.cosine, node.sine);
    const Vec3 v = task_.v.at(node.slot) + change;
    const Vec3 u = task_.u.at(node.slot) + task_.dt * change;
    task_.v.set(node.slot, v);
    task_.u.set(node.slot, u);
  }

  /// Adds averages at the nodes about the patch to the record.
  TREAD_BODY void record() const {
    const int rows = task_.window.edges + 1;
    team_.for_each((task_.window.stations + 1) * rows, [&](int i) { record_node(i / rows, i % rows); });
  }

  /// The node at a station and row of the window, from the points of the faces about it.
  TREAD_BODY void record_node(int station, int row) const {
    const FaceWindow& window = task_.window;
    const RecordView& to = task_.record;
    const int at = window.first_station + station;
    const double area = to.length[at] * to.width[row];
    int first[4];
    int last[4];
    for (int corner = 0; corner < 4; ++corner) {
      const int of_station = station - corner / 2;
      const int of_edge = row - corner % 2;
      const bool there =
          of_station >= 0 && of_station < window.stations && of_edge >= 0 && of_edge < window.edges;
      const int face = there ? of_station * window.edges + of_edge : 0;
      first[corner] = to.first_point[face];
      last[corner] = there ? to.first_point[face + 1] : first[corner];
    }
    if (first[0] == last[0] && first[1] == last[1] && first[2] == last[2] && first[3] == last[3]) return;
    NodalStress node;
    for (int corner = 3; corner >= 0; --corner)
      for (int i = first[corner]; i < last[corner]; ++i)
        node.add(outcomes()[i], outcomes()[i].share[corner] / area);
    const std::int64_t place = std::int64_t{at} * to.rows + row;
    if (node.pressure > to.max_pressure[place]) to.max_pressure[place] = node.pressure;
    const double shear = node.shear_size();
    if (shear > to.max_shear[place]) to.max_shear[place] = shear;
    to.frictional_work[place] += node.frictional_work;
  }

  /// Works and forces of the points, each part of them in its order, then the parts in theirs.
  TREAD_BODY void sum_up() const {
    team_.for_each(kSums * kParts, [&](int i) {
      double own = 0;
      for (int of = i / kSums; of < points_; of += kParts) own += outcomes()[of].sum[i % kSums];
      sums_[i] = own;
    });
    team_.for_each(kSums, [&](int j) {
      for (int part = 1; part < kParts; ++part) sums_[j] += sums_[kSums * part + j];
    });
    team_.for_each(1, [&](int) {
      *task_.result = {{sums_[0], sums_[1], sums_[2]}, sums_[3], sums_[4], points_, ends_[0]};
    });
  }

  const Team& team_;
  const ContactTask& task_;
  const Law& law_;
  typename Law::State* state_;
  double* sums_;
  int* ends_;
  LinkedPatch<Team> links_;
  int points_ = 0;
  double* impulse_ = nullptr;   ///< by point
  double* change_ = nullptr;    ///< by node
  double* cell_sum_ = nullptr;  ///< kSumStride by cell
  double* sum_ = nullptr;       ///< by entry
  TeamTile* tile_ = nullptr;
  bool near_ = false;  ///< all but the tiles lies in shared memory
};

}  // namespace tread
