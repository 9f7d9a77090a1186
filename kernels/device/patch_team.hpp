#pragma once
// Patch and tractions of a step by one team of threads. Numbers, sums and their orders are those of
// PatchCells and PatchSolver. Written once for a GPU and for its emulation. [docs/records/device.md]
//
// A team has what kernels/device/march_body.hpp says, and `least(at, value)` and `add(at, value)`, which
// change an int that its threads share as one operation; `add` returns the former value.

#include <climits>
#include <cmath>
#include <cstdint>

#include "kernels/device/contact_layout.hpp"
#include "kernels/device/patch_links.hpp"
#include "kernels/lanes/patch_respond_body.hpp"

namespace tread {

/// Search of a step: a candidate a thread.
struct SearchPoints {
  ContactTask task;

  std::int64_t count() const { return task.window.count(); }
  TREAD_BODY void operator()(std::int64_t i) const {
    const FaceWindow& window = task.window;
    const auto of_window = static_cast<int>(i / window.points);
    const auto k = static_cast<int>(i % window.points);
    const std::int64_t face = window.face(of_window);
    task.candidates.kept[i] = 0;
    if (task.bounds.time < task.wake_time[face]) return;
    const ContactState state{task.u, task.v, &task.wheel};
    ContactPoint point{};
    point.history = face * window.points + k;
    double gap = 0;
    const std::array<int, 2> at = {window.first_station + of_window / window.edges,
                                   window.first_edge + of_window % window.edges};
    const bool found = find_point(task.surfaces, state, task.bounds, at, task.quadrature[k],
                                  task.history[point.history], point, gap);
    task.candidates.gap[i] = gap;
    if (!found || stays_open(point, kSpareClosing, task.dt)) return;
    task.candidates.kept[i] = 1;
    task.candidates.point[i] = point;
  }
};

/// One lane of a tile.
struct OneLane {
  int lane;

  TREAD_INLINE double load(const double (&values)[kLanes]) const { return values[lane]; }
  TREAD_INLINE void store(double (&values)[kLanes], double value) const { values[lane] = value; }
};

template <class Law, class Team>
class PatchTeam {
 public:
  TREAD_BODY PatchTeam(const Team& team, const ContactTask& task, const Law& law, typename Law::State* state)
      : team_(team), task_(task), law_(law), state_(state), links_(team, task.links), v_(task.vectors) {
    largest_ = team.template share<double>(2 * kParts);
    sums_ = team.template share<double>(5 * kParts);
    ends_ = team.template share<int>(2);
  }

  static std::size_t shared_bytes() {
    return sizeof(double) * 7 * kParts + sizeof(int) * 2 + LinkedPatch<Team>::shared_bytes();
  }

  TREAD_BODY void run() {
    wake_faces();
    gather();
    if (points_ > 0) {
      links_.link(task_.point, points_);
      solve();
    }
    record();
    sum_up();
  }

 private:
  static constexpr int kParts = kPatchParts;

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

  /// Makes the patch of the candidates that were kept, in their order.
  TREAD_BODY void gather() {
    const auto count = static_cast<int>(task_.window.stations * task_.window.edges * task_.window.points);
    const Candidates& from = task_.candidates;
    points_ = links_.number(from.kept, from.place, count);
    team_.for_each(count, [&](int i) {
      if (from.kept[i] != 0) task_.point[from.place[i]] = from.point[i];
    });
    // First point of each face of the window, and one more.
    const FaceWindow& window = task_.window;
    team_.for_each(window.stations * window.edges + 1, [&](int i) {
      const int first = i * window.points;
      task_.record.first_point[i] = first < count ? from.place[first] : points_;
    });
  }

  TREAD_BODY ContactPoint& point(int i) const { return task_.point[i]; }
  TREAD_BODY PointLane lane(int i) const { return PointLane::of(v_.tile, static_cast<std::size_t>(i)); }
  TREAD_BODY int tiles() const { return (points_ + kLanes - 1) / kLanes; }
  TREAD_BODY double sum(int i, int c) const { return v_.sum[i].value[c] + v_.sum[points_ + i].value[c]; }
  TREAD_BODY Vec3 sum(int i) const { return {sum(i, 0), sum(i, 1), sum(i, 2)}; }

  /// Sets `change` to the inverse mass times the weighted sum of the points' impulses.
  TREAD_BODY void to_nodes() const {
    const PatchLinks& l = task_.links;
    team_.for_each(3 * kCellNodes * links_.cells(), [&](int i) {
      const int c = i % 3;
      const int k = i / 3 % kCellNodes;
      const int cell = i / 3 / kCellNodes;
      double part = 0;
      for (int e = l.first_listed[cell]; e < l.first_listed[cell + 1]; ++e) {
        const int entry = l.listed[e];
        part += node_part(l.weights[entry], k, v_.impulse[entry % points_].value[c]);
      }
      v_.cell_sum[i / 3].value[c] = part;
    });
    team_.for_each(3 * links_.nodes(), [&](int i) {
      const int node = i / 3;
      double all = 0;
      for (int t = l.first_term[node]; t < l.first_term[node + 1]; ++t)
        all += v_.cell_sum[l.term[t]].value[i % 3];
      v_.change[node].value[i % 3] = all * task_.inverse_mass[l.slot[node]];
    });
  }

  /// Sets the sums by entry to the points' weighted sums of the nodes' vectors.
  TREAD_BODY void to_points() const {
    const PatchLinks& l = task_.links;
    team_.for_each(6 * points_, [&](int i) {
      const int entry = i / 3;
      const int c = i % 3;
      const int* const node = l.cell_node + l.cell[entry] * kCellNodes;
      v_.sum[entry].value[c] =
          point_sum<double>(l.weights[entry], [&](int k) { return v_.change[node[k]].value[c]; });
    });
  }

  TREAD_BODY void sum_impulses() const {
    to_nodes();
    to_points();
  }

  TREAD_BODY void solve() {
    set_free();
    team_.for_each(tiles(), [&](int t) { v_.tile[t] = PointTile{}; });
    team_.for_each(points_, [&](int i) {
      lane(i).fill(point(i), task_.dt);
      rub(i);
      v_.impulse[i] = {{0.5 * task_.dt * task_.dt * point(i).area, 0, 0, 0}};
    });
    sum_impulses();
    team_.for_each(points_, [&](int i) {
      const double own = 0.5 * task_.dt * task_.dt * point(i).area * mobility(i);
      const double all = sum(i, 0);
      lane(i).tile.compliance[i % kLanes] = own < all ? all : own;
    });
    iterate();
    team_.for_each(points_, [&](int i) { v_.impulse[i] = lane(i).settle(point(i), task_.dt); });
    sum_impulses();
    team_.for_each(points_, [&](int i) {
      set_speeds(point(i), vector_of(v_.free[i]) + sum(i));
      if constexpr (FrictionOf<Law>::kHasState)
        if (point(i).pressure <= 0) state_[point(i).history] = {};
    });
    write_back();
  }

  /// Sets the points' velocities without contact.
  TREAD_BODY void set_free() const {
    const PatchLinks& l = task_.links;
    team_.for_each(links_.nodes(), [&](int n) {
      const Vec3 velocity = task_.v.at(l.slot[n]);
      v_.change[n] = padded(l.of_wheel[n] != 0 ? globalise(l.basis[2 * n], l.basis[2 * n + 1], velocity)
                                               : -1 * velocity);
    });
    to_points();
    team_.for_each(points_,
                   [&](int i) { v_.free[i] = padded(frame_velocity(point(i), task_.wheel) + sum(i)); });
  }

  TREAD_BODY void rub(int i) const {
    if constexpr (FrictionOf<Law>::kHasState) {
      lane(i).rub(point(i), law_, state_[point(i).history], task_.dt);
    } else {
      typename Law::State none{};
      lane(i).rub(point(i), law_, none, task_.dt);
    }
  }

  /// PatchCells::own_mobility
  TREAD_BODY double mobility(int i) const {
    const PatchLinks& l = task_.links;
    double own = 0;
    const int entries[2] = {i, points_ + i};
    for (const int entry : entries) {
      const int* const node = l.cell_node + l.cell[entry] * kCellNodes;
      for (int k = 0; k < kCellNodes; ++k) {
        const double weight = l.weights[entry].along[k / 4] * l.weights[entry].across[k % 4];
        own += weight * weight * task_.inverse_mass[l.slot[node[k]]];
      }
    }
    return own;
  }

  struct Pair {
    double first, second;
  };

  /// Largest of both of values(point), which are zero or more.
  template <class Values>
  TREAD_BODY Pair find_largest(const Values& values) const {
    team_.for_each(kParts, [&](int part) {
      Pair most{0, 0};
      for (int i = part; i < points_; i += kParts) {
        const Pair both = values(i);
        if (both.first > most.first) most.first = both.first;
        if (both.second > most.second) most.second = both.second;
      }
      largest_[2 * part] = most.first;
      largest_[2 * part + 1] = most.second;
    });
    team_.for_each(2, [&](int j) {
      for (int part = 1; part < kParts; ++part)
        if (largest_[2 * part + j] > largest_[j]) largest_[j] = largest_[2 * part + j];
    });
    return {largest_[0], largest_[1]};
  }

  /// Guesses the tractions. Returns the momentum of the iterations to come.
  TREAD_BODY double begin() const {
    const Pair largest = find_largest([&](int i) { return Pair{lane(i).tile.compliance[i % kLanes], 0}; });
    team_.for_each(points_, [&](int i) { v_.impulse[i] = lane(i).guess(point(i), task_.springs, task_.dt); });
    return momentum_of(task_.springs, largest.first);
  }

  TREAD_BODY void respond(double momentum) const {
    const PointIteration iteration{task_.springs, task_.dt, momentum};
    team_.for_each(points_, [&](int i) {
      double velocity[3];
      for (int c = 0; c < 3; ++c)
        velocity[c] = v_.free[i].value[c] + v_.sum[i].value[c] + v_.sum[points_ + i].value[c];
      double impulse[3];
      respond_in(v_.tile[i / kLanes], OneLane{i % kLanes}, iteration, velocity, impulse);
      v_.impulse[i] = {{impulse[0], impulse[1], impulse[2], 0}};
    });
  }

  /// PatchSolver::iterate
  TREAD_BODY void iterate() const {
    double momentum = begin();
    double first = 0;
    for (int iteration = 1; iteration <= kMostIterations; ++iteration) {
      sum_impulses();
      respond(iteration > 1 ? momentum : 0);
      const Pair largest = find_largest([&](int i) {
        const PointTile& tile = lane(i).tile;
        return Pair{tile.change[i % kLanes], tile.response[0][i % kLanes]};
      });
      const double change = std::sqrt(largest.first);
      if (change <= kTractionTolerance * largest.second) break;
      if (iteration == 1) first = change;
      if (change > kDivergence * first) {
        team_.for_each(points_, [&](int i) { lane(i).tile.compliance[i % kLanes] *= 2; });
        momentum = begin();
      }
    }
  }

  TREAD_BODY void write_back() const {
    const NodeKick kick(task_.wheel.spin, task_.dt);
    const PatchLinks& l = task_.links;
    team_.for_each(links_.nodes(), [&](int n) {
      const Vec3 change =
          kick.local(vector_of(v_.change[n]), l.of_wheel[n] != 0, l.basis[2 * n], l.basis[2 * n + 1]);
      task_.v.add(l.slot[n], change);
      task_.u.add(l.slot[n], task_.dt * change);
    });
  }

  /// Works and forces of the points, each part of them in its order, then the parts in theirs.
  TREAD_BODY void sum_up() const {
    team_.for_each(1, [&](int) { ends_[0] = 0; });
    team_.for_each(kParts, [&](int part) {
      Vec3 force;
      PointWork works{0, 0};
      for (int i = part; i < points_; i += kParts) {
        force += point(i).area * point(i).traction();
        works.frictional += point(i).area * point(i).frictional_work;
        works.damping += task_.vectors.free[i].value[3];
        if (point(i).pressure > 0 && at_the_end(point(i))) team_.add(ends_, 1);
      }
      const double values[5] = {force.x, force.y, force.z, works.frictional, works.damping};
      for (int j = 0; j < 5; ++j) sums_[5 * part + j] = values[j];
    });
    team_.for_each(5, [&](int j) {
      for (int part = 1; part < kParts; ++part) sums_[j] += sums_[5 * part + j];
    });
    team_.for_each(1, [&](int) {
      *task_.result = {{sums_[0], sums_[1], sums_[2]}, sums_[3], sums_[4], points_, ends_[0]};
    });
  }

  TREAD_BODY bool at_the_end(const ContactPoint& of) const {
    return task_.end.has(of.face[1], task_.quadrature[of.history % task_.window.points].across,
                         of.position.x - task_.wheel.origin.x);
  }

  /// Settles the points' histories, and adds averages at the nodes about the patch to the record.
  TREAD_BODY void record() const {
    team_.for_each(points_, [&](int i) {
      const PointWork work =
          settle_history(point(i), task_.history[point(i).history], task_.springs, task_.dt);
      task_.vectors.free[i].value[3] = work.damping;
    });
    const int rows = task_.window.edges + 1;
    team_.for_each((task_.window.stations + 1) * rows, [&](int i) { record_node(i / rows, i % rows); });
  }

  /// The node at a station and row of the window, from the points of the faces about it.
  TREAD_BODY void record_node(int station, int row) const {
    const FaceWindow& window = task_.window;
    const RecordView& to = task_.record;
    const int at = window.first_station + station;
    const double area = to.length[at] * to.width[row];
    NodalContact node;
    for (int corner = 3; corner >= 0; --corner) {
      const int of_station = station - corner / 2;
      const int of_edge = row - corner % 2;
      if (of_station < 0 || of_station >= window.stations || of_edge < 0 || of_edge >= window.edges) continue;
      const int face = of_station * window.edges + of_edge;
      for (int i = to.first_point[face]; i < to.first_point[face + 1]; ++i)
        node.add(point(i), point(i).area * point(i).face_share[static_cast<std::size_t>(corner)] / area);
    }
    const std::int64_t place = std::int64_t{at} * to.rows + row;
    if (node.pressure > to.max_pressure[place]) to.max_pressure[place] = node.pressure;
    const double shear = node.shear_size();
    if (shear > to.max_shear[place]) to.max_shear[place] = shear;
    to.frictional_work[place] += node.frictional_work;
  }

  const Team& team_;
  const ContactTask& task_;
  const Law& law_;
  typename Law::State* state_;
  LinkedPatch<Team> links_;
  const PatchVectors& v_;
  double* largest_;
  double* sums_;
  int* ends_;
  int points_ = 0;
};

}  // namespace tread
