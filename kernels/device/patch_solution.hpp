#pragma once
// Tractions of the points of a patch by teams of threads, with the iteration of PatchSolver.
//
// Each team has a run of the points and one of the nodes. What others read, impulses and changes of velocity,
// is told to all of them: then an iteration reads from the memory of the own team alone.

#include <cmath>
#include <cstdint>

#include "kernels/contact/patch_point_body.hpp"
#include "kernels/device/contact_layout.hpp"
#include "kernels/device/patch_room.hpp"
#include "kernels/lanes/patch_respond_body.hpp"

namespace tread {

struct SolutionArrays {
  TeamArray<double> impulse, change;  ///< copies; the others are runs
  TeamArray<double> part, sum;
  TeamArray<TeamTile> tile;
  TeamArray<TeamSupport> support;
  TeamArray<int> first_item;
  TeamArray<NodeItem> item;
  bool near;  ///< all but the items lies in the teams' memories
};

/// Finds room for the arrays of a patch.
template <class Teams>
TREAD_BODY SolutionArrays room_of(const Teams& teams, const PatchVectors& far, const PatchCounts& counts) {
  const int points = teams.run(counts.points);
  const int nodes = teams.run(counts.nodes);
  int items = 0;
  for (int first = 0; first < counts.nodes; first += nodes) {
    const int last = first + nodes < counts.nodes ? first + nodes : counts.nodes;
    const int own = far.first_item[last] - far.first_item[first];
    if (own > items) items = own;
  }
  PatchRoom room(teams.memory());
  SolutionArrays arrays{room.keep(3 * counts.points, far.impulse),
                        room.keep(3 * counts.nodes, far.change),
                        room.keep(kPartStride * nodes, far.part),
                        room.keep(6 * points, far.sum),
                        room.keep((points + kLanes - 1) / kLanes, far.tile),
                        room.keep(2 * points, far.support),
                        room.keep(nodes + 1, far.first_item, nodes),
                        {},
                        false};
  arrays.near = room.near();
  arrays.item = room.keep(items, far.item);
  return arrays;
}

template <class Law, class Teams, bool kNear>
class PatchSolution {
 public:
  TREAD_BODY PatchSolution(const Teams& teams, const ContactTask& task, const Law& law,
                           typename Law::State* state, const PatchCounts& counts,
                           const SolutionArrays& arrays)
      : teams_(teams),
        task_(task),
        law_(law),
        state_(state),
        points_(counts.points),
        nodes_(counts.nodes),
        own_points_(teams.run(counts.points)),
        own_nodes_(teams.run(counts.nodes)),
        arrays_(arrays) {}

  TREAD_BODY void run() const {
    fetch();
    set_free();
    fill_points();
    sum_impulses();
    iterate();
    teams_.for_each(points_, [&](int i) { put_impulse(i, vector_of(lane(i).settle(point(i)))); });
    sum_impulses();
    finish();
  }

 private:
  TREAD_BODY ContactPoint& point(int i) const { return task_.candidates.point[task_.candidates.origin[i]]; }

  template <class T>
  TREAD_BODY T* copy(const TeamArray<T>& of) const {
    if constexpr (kNear) return teams_.near(of.values);
    return of.far ? of.values : teams_.here(of.values);
  }
  template <class T>
  TREAD_BODY T* run(const TeamArray<T>& of) const {
    if constexpr (kNear) return teams_.near(of.values);
    return of.far ? of.values + std::int64_t{teams_.team()} * of.stride : teams_.here(of.values);
  }
  TREAD_BODY void tell(const TeamArray<double>& of, int i, double value) const {
    if (!kNear && of.far)
      of.values[i] = value;
    else
      teams_.tell(of.values + i, value);
  }
  TREAD_BODY int of_run(int i) const { return i - teams_.team() * own_points_; }
  TREAD_BODY int of_nodes(int n) const { return n - teams_.team() * own_nodes_; }
  TREAD_BODY NodeItem* items() const {
    const TeamArray<NodeItem>& of = arrays_.item;
    return of.far ? of.values : teams_.here(of.values);
  }

  TREAD_BODY TeamTile& tile(int i) const { return run(arrays_.tile)[of_run(i) / kLanes]; }
  TREAD_BODY PointLane lane(int i) const { return {tile(i), static_cast<std::size_t>(of_run(i) % kLanes)}; }
  TREAD_BODY double sum(int i, int c) const {
    const double* const of = run(arrays_.sum) + 6 * of_run(i);
    return of[c] + of[3 + c];
  }
  /// Velocity of the wheel against the rail.
  TREAD_BODY double velocity(int i, int c) const { return tile(i).free[c][of_run(i) % kLanes] + sum(i, c); }
  TREAD_BODY void put_impulse(int i, const Vec3& value) const {
    for (int c = 0; c < 3; ++c) tell(arrays_.impulse, c * points_ + i, value[c]);
  }

  /// Copies the supports and lists of the own run.
  TREAD_BODY void fetch() const {
    const PatchVectors& from = task_.vectors;
    if (!arrays_.support.far)
      teams_.template for_own<2>(points_, [&](int j) {
        run(arrays_.support)[j - 2 * teams_.team() * own_points_] = from.support[j];
      });
    if (arrays_.first_item.far) return;
    const bool near = !arrays_.item.far;
    const auto base = [&] { return near ? from.first_item[teams_.team() * own_nodes_] : 0; };
    teams_.for_own(nodes_, [&](int n) {
      int* const first = run(arrays_.first_item) + of_nodes(n);
      first[0] = from.first_item[n] - base();
      if (of_nodes(n) == own_nodes_ - 1 || n == nodes_ - 1) first[1] = from.first_item[n + 1] - base();
    });
    if (near)
      teams_.for_lists(
          nodes_, [&](int n) { return from.first_item[n]; },
          [&](int j) { items()[j - base()] = from.item[j]; });
  }

  /// Sets `change` to the inverse mass times the weighted sum of the points' impulses.
  TREAD_BODY void to_nodes() const {
    teams_.template for_own<kNodeParts>(nodes_, [&](int j) {
      const int n = of_nodes(j / kNodeParts);
      const int part = j % kNodeParts;
      const int* const first = run(arrays_.first_item) + n;
      const int end = first[1];
      const NodeItem* const item = items();
      const double* const impulse = copy(arrays_.impulse);
      double all[3] = {};
      for (int k = first[0] + part; k < end; k += kNodeParts)
        for (int c = 0; c < 3; ++c) all[c] += item[k].weight * impulse[c * points_ + item[k].point];
      double* const to = run(arrays_.part) + kPartStride * n + 3 * part;
      for (int c = 0; c < 3; ++c) to[c] = all[c];
    });
    teams_.template for_each<3>(nodes_, [&](int j) {
      const double* const part = run(arrays_.part) + kPartStride * of_nodes(j / 3) + j % 3;
      double all = part[0];
      for (int k = 1; k < kNodeParts; ++k) all += part[3 * k];
      tell(arrays_.change, j, all);
    });
  }

  /// Sets the points' weighted sums of the nodes' vectors, in both bodies.
  TREAD_BODY void to_points() const {
    teams_.template for_own<6>(points_, [&](int j) {
      const int of = j - 6 * teams_.team() * own_points_;
      const TeamSupport& support = run(arrays_.support)[of / 3];
      const double* const change = copy(arrays_.change) + j % 3;
      run(arrays_.sum)[of] =
          point_sum<double>(support.weights, [&](int k) { return change[3 * support.node[k]]; });
    });
  }

  TREAD_BODY void sum_impulses() const {
    to_nodes();
    to_points();
  }

  /// Sets the nodes' and the points' velocities without contact.
  TREAD_BODY void set_free() const {
    teams_.for_each(nodes_, [&](int n) {
      const PatchNode& node = task_.links.node[n];
      const Vec3 velocity = task_.v.at(node.slot);
      const Vec3 free = node.of_wheel != 0 ? globalise(node.cosine, node.sine, velocity) : -1 * velocity;
      for (int c = 0; c < 3; ++c) tell(arrays_.change, 3 * n + c, free[c]);
    });
    to_points();
  }

  /// Sets the constants of the points, and unit pressures.
  TREAD_BODY void fill_points() const {
    teams_.for_each(points_, [&](int i) {
      const ContactPoint& of = point(i);
      const Vec3 frame = frame_velocity(of, task_.wheel);
      for (int c = 0; c < 3; ++c) tile(i).free[c][of_run(i) % kLanes] = frame[c] + sum(i, c);
      lane(i).fill(of, task_.dt);
      rub(i);
      put_impulse(i, {0.5 * task_.dt * task_.dt * of.area, 0, 0});
    });
  }

  TREAD_BODY void rub(int i) const {
    if constexpr (FrictionOf<Law>::kHasState) {
      lane(i).rub(point(i), law_, state_[point(i).history], task_.dt);
    } else {
      typename Law::State none{};
      lane(i).rub(point(i), law_, none, task_.dt);
    }
  }

  /// Guesses the tractions under compliance(point).
  template <class Compliance>
  TREAD_BODY HeavyBall begin(const Compliance& compliance) const {
    const LargestPair largest = teams_.largest(points_, [&](int i) {
      const double own = compliance(i);
      tile(i).compliance[of_run(i) % kLanes] = own;
      put_impulse(i, vector_of(lane(i).guess(point(i), task_.springs, task_.dt)));
      return LargestPair{own, 0};
    });
    return {task_.springs, largest.first};
  }

  /// Returns the largest change and the largest pressure, the former squared.
  TREAD_BODY LargestPair respond(const PointIteration& iteration) const {
    return teams_.largest(points_, [&](int i) {
      const double motion[3] = {velocity(i, 0), velocity(i, 1), velocity(i, 2)};
      TeamTile& of = tile(i);
      const int l = of_run(i) % kLanes;
      double impulse[3];
      respond_in(of, OneLane{l}, iteration, motion, impulse);
      put_impulse(i, {impulse[0], impulse[1], impulse[2]});
      return LargestPair{of.change[l], of.response[0][l]};
    });
  }

  /// PatchSolver::iterate
  TREAD_BODY void iterate() const {
    HeavyBall ball = begin([&](int i) {
      const TeamSupport* const support = run(arrays_.support) + 2 * of_run(i);
      const double own =
          0.5 * task_.dt * task_.dt * point(i).area * (support[0].mobility + support[1].mobility);
      const double all = sum(i, 0);
      return own < all ? all : own;
    });
    double first = 0;
    for (int iteration = 1; iteration <= kMostIterations; ++iteration) {
      sum_impulses();
      const LargestPair largest = respond(ball.next(task_.springs, task_.dt));
      const double change = std::sqrt(largest.first);
      if (change <= kTractionTolerance * largest.second) break;
      if (iteration == kMostIterations)
        teams_.for_each(1, [&](int) { task_.counts->unsettled = change / largest.second; });
      if (iteration == 1) first = change;
      if (change > kDivergence * first)
        ball = begin([&](int i) { return 2 * tile(i).compliance[of_run(i) % kLanes]; });
    }
  }

  /// Outcomes of the points, and motion of the nodes.
  TREAD_BODY void finish() const {
    const NodeKick kick(task_.wheel.spin, task_.dt);
    teams_.for_own(points_, [&](int i) { finish_point(i); });
    teams_.for_each(nodes_, [&](int n) { write_back(kick, n); });
  }

  TREAD_BODY void finish_point(int i) const {
    ContactPoint& of = point(i);
    set_speeds(of, {velocity(i, 0), velocity(i, 1), velocity(i, 2)});
    if constexpr (FrictionOf<Law>::kHasState)
      if (of.pressure <= 0) state_[of.history] = {};
    const PointWork work = settle_history(of, task_.history[of.history], task_.springs, task_.dt);
    const Vec3 force = of.area * of.traction();
    task_.vectors.outcome[i] = {of.pressure,
                                of.shear,
                                of.frictional_work,
                                {of.area * of.face_share[0], of.area * of.face_share[1],
                                 of.area * of.face_share[2], of.area * of.face_share[3]},
                                {force.x, force.y, force.z, work.frictional, work.lost}};
    if (of.pressure > 0 && at_the_end(of)) teams_.add(&task_.counts->at_the_end, 1);
  }

  TREAD_BODY bool at_the_end(const ContactPoint& of) const {
    return task_.end.has(of.face[1], task_.quadrature[of.history % task_.window.points].across,
                         of.position.x - task_.wheel.origin.x);
  }

  TREAD_BODY void write_back(const NodeKick& kick, int n) const {
    const PatchNode& node = task_.links.node[n];
    const double* const own = copy(arrays_.change) + 3 * n;
    const Vec3 change = kick.local({own[0], own[1], own[2]}, node.of_wheel != 0, node.cosine, node.sine);
    const Vec3 v = task_.v.at(node.slot) + change;
    const Vec3 u = task_.u.at(node.slot) + task_.dt * change;
    task_.v.set(node.slot, v);
    task_.u.set(node.slot, u);
  }

  const Teams& teams_;
  const ContactTask& task_;
  const Law& law_;
  typename Law::State* state_;
  int points_, nodes_;
  int own_points_, own_nodes_;  ///< of a run
  SolutionArrays arrays_;
};

/// Sets when faces that were searched may close, and solves the tractions. `state`: of the law, by
/// integration point.
template <class Law>
struct SolvePatch {
  static constexpr bool kNeedsMemory = true;  ///< of its teams

  ContactTask task;
  Law law;
  typename Law::State* state;

  template <class Teams>
  TREAD_BODY void operator()(const Teams& teams) const {
    wake_faces(teams);
    const PatchCounts counts = *task.counts;
    if (counts.points == 0) return;
    const SolutionArrays arrays = room_of(teams, task.vectors, counts);
    // The compiler of a card is told where the arrays lie: loads of shared memory are shorter than those from
    // anywhere.
    if (arrays.near)
      PatchSolution<Law, Teams, true>(teams, task, law, state, counts, arrays).run();
    else
      PatchSolution<Law, Teams, false>(teams, task, law, state, counts, arrays).run();
  }

 private:
  template <class Teams>
  TREAD_BODY void wake_faces(const Teams& teams) const {
    const FaceWindow& window = task.window;
    teams.for_own(window.stations * window.edges, [&](int i) {
      double& wake = task.wake_time[window.face(i)];
      if (task.bounds.time < wake) return;
      double smallest = task.candidates.gap[std::int64_t{i} * window.points];
      for (int k = 1; k < window.points; ++k) {
        const double gap = task.candidates.gap[std::int64_t{i} * window.points + k];
        if (gap < smallest) smallest = gap;
      }
      wake = task.bounds.wake_time(smallest);
    });
  }
};

}  // namespace tread
