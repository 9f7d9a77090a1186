#pragma once
// Kernels that sum over nodes and elements, as functions of a thread's number, for every kind of device.
// [kernels/device/sum_layout.hpp]

#include "kernels/device/march_node.hpp"
#include "kernels/device/sum_layout.hpp"
#include "kernels/element/element_body.hpp"
#include "kernels/element/law_body.hpp"
#include "kernels/material/laws.hpp"
#include "kernels/update/turn.hpp"

namespace tread {

/// Place of a thread: a lane of a tile, and a chunk of what the section has.
struct SumPlace {
  int tile, chunk, lane;

  TREAD_INLINE SumPlace(std::int64_t thread, int chunks)
      : tile(static_cast<int>(thread / kLanes / chunks)),
        chunk(static_cast<int>(thread / kLanes % chunks)),
        lane(static_cast<int>(thread % kLanes)) {}
};

template <int values>
TREAD_INLINE void store_sums(const SumParts& to, std::int64_t part, const double (&sum)[values]) {
  for (int value = 0; value < values; ++value) to.part[value * to.parts + part] = sum[value];
}

/// FieldKernels::sum_nodes
template <class Real, class U>
struct SumNodes {
  NodeSumTask<Real, U> task;

  std::int64_t count() const { return task.threads(); }
  TREAD_BODY void operator()(std::int64_t i) const {
    const SumPlace place(i, task.chunks());
    const Tile& tile = task.block.tile[place.tile];
    double sum[node_sums] = {};
    if (place.lane < tile.stations) {
      const int first = place.chunk * NodeSumTask<Real, U>::kNodes;
      const int all = task.block.section_nodes;
      const int last =
          first + NodeSumTask<Real, U>::kNodes < all ? first + NodeSumTask<Real, U>::kNodes : all;
      const std::int64_t group = task.block.first_group + std::int64_t{place.tile} * all;
      if (task.spins)
        add_spinning(group, first, last, tile.first_station + place.lane, place.lane, sum);
      else
        add_fixed(group, first, last, place.lane, sum);
    }
    store_sums(task.to, task.first_part + i, sum);
  }

 private:
  static TREAD_BODY std::int64_t at(std::int64_t group, int lane) { return group * (3 * kLanes) + lane; }

  TREAD_BODY void add_fixed(std::int64_t group, int first, int last, int lane,
                            double (&sum)[node_sums]) const {
    for (int node = first; node < last; ++node) {
      const std::int64_t slot = (group + node) * kLanes + lane;
      const std::int64_t place = at(group + node, lane);
      const double mass = task.mass[slot];
      sum[sum_displacement + 2] += mass * task.motion.u[place + 2 * kLanes];
      double square = 0;
      for (int c = 0; c < 3; ++c) {
        const double v = task.motion.v[place + c * kLanes];
        square += v * v;
      }
      sum[sum_kinetic] += mass * square;
      const Real weight[2] = {};
      if (task.before.u != nullptr && task.vertical_only)
        sum[sum_excess] += excess<Sweep::extruded, 2>(slot, place, weight, Real{});
      else if (task.before.u != nullptr)
        sum[sum_excess] += excess<Sweep::extruded, 0>(slot, place, weight, Real{});
    }
  }

  TREAD_BODY void add_spinning(std::int64_t group, int first, int last, int station, int lane,
                               double (&sum)[node_sums]) const {
    const double angle = task.block.angle[station];
    const Turn turn(angle + task.frame.angle);
    const Vec3 carried = Turn(angle + task.half_frame.angle).to_cylindrical(task.half_frame.velocity);
    Real weight[2];
    weigh(task.block, station, weight);
    Vec3 displacement;
    Vec3 velocity;
    for (int node = first; node < last; ++node) {
      const std::int64_t slot = (group + node) * kLanes + lane;
      const std::int64_t place = at(group + node, lane);
      const double mass = task.mass[slot];
      const double radius = task.radius[node];
      Vec3 u;
      Vec3 w;
      for (int c = 0; c < 3; ++c) {
        u[c] = task.motion.u[place + c * kLanes];
        w[c] = task.motion.v[place + c * kLanes];
      }
      displacement += mass * u;
      velocity += mass * w;
      sum[sum_rotation] += mass * radius * u.x;
      sum[sum_spin] += mass * radius * w.x;
      const Vec3 absolute = carried + w + spin_cross(task.half_frame.spin, Vec3{u.x, 0, radius + u.z});
      sum[sum_kinetic] += mass * dot(absolute, absolute);
      if (task.before.u != nullptr)
        sum[sum_excess] += excess<Sweep::revolved, 0>(slot, place, weight, static_cast<Real>(radius));
    }
    const Vec3 in_space = turn.to_cartesian(displacement);
    const Vec3 speed = turn.to_cartesian(velocity + spin_cross(task.frame.spin, displacement));
    for (int c = 0; c < 3; ++c) {
      sum[sum_displacement + c] = in_space[c];
      sum[sum_velocity + c] = speed[c];
    }
  }

  /// The force shows in the difference from the motion without it.
  template <Sweep sweep, int from>
  TREAD_BODY double excess(std::int64_t slot, std::int64_t place, const Real (&weight)[2],
                           Real radius) const {
    const Real inverse_mass = task.inverse_mass[slot];
    if (!(inverse_mass > 0)) return 0;
    U u[3];
    Real v[3];
    for (int c = 0; c < 3; ++c) {
      u[c] = task.before.u[place + c * kLanes];
      v[c] = task.before.v[place + c * kLanes];
    }
    const Real none[3] = {};
    if constexpr (sweep == Sweep::revolved)
      move_spinning(task.block.step, weight, radius, inverse_mass, none, u, v);
    else
      move_fixed<from>(task.block.step, inverse_mass, none, u, v);
    double square = 0;
    for (int c = from; c < 3; ++c) {
      const double change = double{task.motion.v[place + c * kLanes]} - double{v[c]};
      if ((task.fixed[slot] >> c & 1U) == 0) square += change * change;
    }
    return square / double{inverse_mass};
  }
};

/// FieldKernels::sum_elements
template <class Real, class U, Sweep sweep, bool finite_rotation, template <class> class Law>
struct SumElements {
  ElementSumTask<Real, U> task;

  std::int64_t count() const { return task.threads(); }
  TREAD_BODY void operator()(std::int64_t i) const {
    const SumPlace place(i, task.chunks());
    const Tile& tile = task.block.tile[place.tile];
    double sum[element_sums] = {};
    if (place.lane < tile.elements) {
      const int first = place.chunk * ElementSumTask<Real, U>::kQuads;
      for (int quad = first; quad < first + ElementSumTask<Real, U>::kQuads && quad < task.block.quads;
           ++quad)
        add_element(tile, place.tile, quad, place.lane, sum);
    }
    store_sums(task.to, task.first_part + i, sum);
  }

 private:
  static constexpr bool kLinear = Law<Real>::kLinear;
  static constexpr int kValues = kStateValues<Law>;
  using State = typename Law<Real>::template State<U>;

  /// Sums and differences, [component][corner], of what value(section node, tile, lane, component) gives at
  /// both ends of an element.
  template <class V, class Value>
  TREAD_BODY void ends(const Tile& tile, int number, int quad, int lane, const Value& value, V (&s)[3][4],
                       V (&d)[3][4]) const {
    const bool inside = lane + 1 < tile.elements;
    for (int j = 0; j < 4; ++j) {
      const int node = task.corner[4 * quad + j];
      V sums[3];
      V differences[3];
      for (int c = 0; c < 3; ++c) {
        const V near = value(node, number, lane, c);
        const V far = inside ? value(node, number, lane + 1, c) : value(node, tile.next, 0, c);
        sums[c] = near + far;
        differences[c] = far - near;
      }
      if constexpr (sweep == Sweep::revolved) {
        const HalfPitch& half = task.block.half_pitch[tile.pitch_class];
        turn_to_middle(static_cast<V>(half.cosine), static_cast<V>(half.sine), sums, differences);
      }
      for (int c = 0; c < 3; ++c) {
        s[c][j] = sums[c];
        d[c][j] = differences[c];
      }
    }
  }

  TREAD_BODY std::int64_t at(int node, int tile, int lane, int c) const {
    const std::int64_t group = task.block.first_group + std::int64_t{tile} * task.block.section_nodes + node;
    return (group * 3 + c) * kLanes + lane;
  }

  TREAD_BODY void add_element(const Tile& tile, int number, int quad, int lane,
                              double (&sum)[element_sums]) const {
    const std::int64_t place = std::int64_t{tile.pitch_class} * task.block.quads + quad;
    const SweptConstants<Real>& constants = task.block.constants[place];
    if (task.block.perturbs(task.block.row_of(number), quad)) {
      U s[3][4];
      U d[3][4];
      U shifts[3][kModes];
      ends(
          tile, number, quad, lane,
          [&](int node, int of_tile, int of_lane, int c) {
            return static_cast<U>(task.block.shift(task.block.row_of(of_tile), node).shift[c][of_lane]);
          },
          s, d);
      for (int c = 0; c < 3; ++c) to_modes(s[c], d[c], shifts[c]);
      add(tile, number, quad, lane, place, PerturbedElement<U, Real>(constants, shifts), sum);
    } else {
      add(tile, number, quad, lane, place, SweptElement<sweep, Real>{constants}, sum);
    }
  }

  template <class Element, class Value>
  TREAD_BODY Strain<U> strain_of(const Tile& tile, int number, int quad, int lane, const Element& element,
                                 const Value& value) const {
    U s[3][4];
    U d[3][4];
    ends(tile, number, quad, lane, value, s, d);
    Strain<U> strain;
    for (int c = 0; c < 3; ++c) element.strain(c, s[c], d[c], strain);
    return strain;
  }

  template <class Element>
  TREAD_BODY void add(const Tile& tile, int number, int quad, int lane, std::int64_t place,
                      const Element& element, double (&sum)[element_sums]) const {
    const SweptConstants<Real>& constants = task.block.constants[place];
    const auto displacement = [&](int node, int of_tile, int of_lane, int c) {
      return task.u[at(node, of_tile, of_lane, c)];
    };
    const Strain<U> strain = strain_of(tile, number, quad, lane, element, displacement);
    add_law_energy(constants, number, quad, lane, place, element, strain, sum);
    if (task.lag == nullptr) return;
    const auto lag = [&](int node, int of_tile, int of_lane, int c) {
      return static_cast<U>(task.lag[at(node, of_tile, of_lane, c)]);
    };
    const Strain<U> of_lag = strain_of(tile, number, quad, lane, element, lag);
    const double stored = task.strength * half_work(constants, element, of_lag);
    sum[sum_branch] += stored;
    sum[sum_power] += task.power * stored;
  }

  /// Half of the work of a strain under its linear forces.
  template <class Element>
  TREAD_BODY static double half_work(const SweptConstants<Real>& constants, const Element& element,
                                     const Strain<U>& strain) {
    Strain<U> force;
    strain_forces<false>(constants, element, strain, force);
    double work = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) work += force.g[i][j] * strain.g[i][j];
      for (int m = 0; m < kHourglassModes; ++m) work += force.q[i][m] * strain.q[i][m];
    }
    return 0.5 * work;
  }

  /// Adds the energies of the law, and of the hourglass stiffness.
  template <class Element>
  TREAD_BODY void add_law_energy(const SweptConstants<Real>& constants, int tile, int quad, int lane,
                                 std::int64_t place, const Element& element, const Strain<U>& strain,
                                 double (&sum)[element_sums]) const {
    if constexpr (kLinear) {
      sum[sum_stored] += linear_energy<finite_rotation>(constants, element, strain);
    } else {
      const Real* const state =
          task.state + (std::int64_t{tile} * task.block.quads + quad) * kValues * kLanes + lane;
      const LawEnergy<U> energy =
          law_energy<finite_rotation>(static_cast<const ElementLaw<Law<Real>, Real>*>(task.block.laws)[place],
                                      element, strain, load_state<State, kValues, U>(state));
      sum[sum_stored] += energy.stored;
      sum[sum_dissipated] += energy.dissipated;
    }
    hourglass_works(constants.hourglass, strain, [&](U work) { sum[sum_stored] += 0.5 * work; });
  }
};

/// FieldKernels::fold
struct FoldSums {
  FoldTask task;

  std::int64_t count() const { return task.threads(); }
  TREAD_INLINE void operator()(std::int64_t i) const {
    const std::int64_t value = i / FoldTask::kFolds % task.values;
    const bool second = i / FoldTask::kFolds >= task.values;
    const std::int64_t end = second ? task.end : task.split;
    const double* const of_value = task.from.part + value * task.from.parts;
    double sum = 0;
    for (std::int64_t part = (second ? task.split : 0) + i % FoldTask::kFolds; part < end;
         part += FoldTask::kFolds)
      sum += of_value[part];
    task.to[i] = sum;
  }
};

}  // namespace tread
