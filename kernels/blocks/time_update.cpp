#include "kernels/blocks/time_update.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contract.hpp"
#include "core/index.hpp"
#include "core/parallel/few_values.hpp"

namespace tread {

namespace {

template <class Real, class U>
void expect_motion(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields) {
  TREAD_EXPECT(loads.dt > 0 && std::isfinite(loads.dt) && std::isfinite(loads.frame.spin));
  TREAD_EXPECT(fields.displacement && fields.velocity && fields.force);
}

}  // namespace

template <class Real>
StepConstants<Real> step_constants(Sweep sweep, const StepLoads& loads) {
  StepConstants<Real> step;
  step.dt = static_cast<Real>(loads.dt);
  if (sweep == Sweep::extruded) {
    step.gravity = static_cast<Real>(loads.gravity);
    return step;
  }
  const double spin = loads.frame.spin;
  step.turn_s = static_cast<Real>(std::sin(2 * spin * loads.dt));
  step.turn_t = static_cast<Real>(std::tan(spin * loads.dt));
  step.spin2 = static_cast<Real>(spin * spin);
  return step;
}

GravityInSweep gravity_at(const SweptBlock& block, int station, const StepLoads& loads) {
  return gravity_in_sweep(loads.gravity, block.stations[index(station)] + loads.frame.angle);
}

template StepConstants<double> step_constants(Sweep, const StepLoads&);
template StepConstants<float> step_constants(Sweep, const StepLoads&);

template <class Real, class U>
BasicTimeUpdate<Real, U>::BasicTimeUpdate(const Mesh& mesh, const Real* inverse_mass)
    : mesh_(mesh), inverse_mass_(inverse_mass), deferred_(index(mesh.slots / kLanes), 0) {
  for (int block = 0; block < static_cast<int>(mesh.blocks.size()); ++block) {
    const SweptBlock& swept = mesh.blocks[index(block)];
    radius_.emplace_back(swept.section.q.begin(), swept.section.q.end());
    for (int tile = 0; tile < static_cast<int>(swept.tiles.size()); ++tile) items_.push_back({block, tile});
    all_nodes_.resize(std::max(all_nodes_.size(), index(swept.section.nodes())));
  }
  std::iota(all_nodes_.begin(), all_nodes_.end(), 0);
  defer({});
}

template <class Real, class U>
void BasicTimeUpdate<Real, U>::defer(const std::vector<std::int64_t>& slots) {
  for (const std::int64_t slot : slots) {
    TREAD_EXPECT(slot >= 0 && slot < mesh_.slots);
    deferred_[index(slot / kLanes)] = kDeferred;
  }
  list_deferred();
}

template <class Real, class U>
void BasicTimeUpdate<Real, U>::defer_only(std::span<const unsigned char> groups,
                                          std::span<const std::int64_t> apart) {
  TREAD_EXPECT(groups.size() == deferred_.size());
  std::copy(groups.begin(), groups.end(), deferred_.begin());
  for (const std::int64_t group : apart) deferred_[index(group)] = kApart;
  list_deferred();
}

template <class Real, class U>
void BasicTimeUpdate<Real, U>::list_deferred() {
  deferred_nodes_.clear();
  first_deferred_.assign(1, 0);
  with_deferred_.clear();
  with_apart_.clear();
  for (const auto [block, tile] : items_) {
    const SweptBlock& swept = mesh_.blocks[index(block)];
    const std::int64_t first = swept.base / kLanes + std::int64_t{tile} * swept.section.nodes();
    for (int node = 0; node < swept.section.nodes(); ++node) {
      const Real* inverse = inverse_mass_ + (first + node) * kLanes;
      const bool moves = std::any_of(inverse, inverse + kLanes, [](Real value) { return value > 0; });
      if (deferred_[index(first + node)] == kDeferred && moves) deferred_nodes_.push_back(node);
    }
    const auto marks = deferred_.begin() + first;
    if (std::find(marks, marks + swept.section.nodes(), kApart) != marks + swept.section.nodes())
      with_apart_.push_back(first_deferred_.size() - 1);
    first_deferred_.push_back(deferred_nodes_.size());
    if (!deferred_nodes(first_deferred_.size() - 2).empty())
      with_deferred_.push_back(first_deferred_.size() - 2);
  }
}

template <class Real, class U>
TileMotion<Real, U> BasicTimeUpdate<Real, U>::motion(int block, int tile, const StepLoads& loads, U* u,
                                                     Real* v) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const std::int64_t slot = swept.base + std::int64_t{tile} * swept.section.nodes() * kLanes;
  TileMotion<Real, U> motion;
  motion.step = step_constants<Real>(swept.sweep, loads);
  motion.u = u + dof(slot, 0);
  motion.v = v + dof(slot, 0);
  motion.inverse_mass = inverse_mass_ + slot;
  motion.deferred = deferred_.data() + slot / kLanes;
  if (swept.sweep == Sweep::extruded) return motion;
  motion.radius = radius_[index(block)].data();
  const Tile& at = swept.tiles[index(tile)];
  for (int l = 0; l < at.stations; ++l) {
    const GravityInSweep gravity = gravity_at(swept, at.first_station + l, loads);
    motion.weight[0][l] = static_cast<Real>(gravity.along);
    motion.weight[1][l] = static_cast<Real>(gravity.outwards);
  }
  return motion;
}

template <class Real, class U>
void BasicTimeUpdate<Real, U>::move(const StepLoads& loads, const BasicUpdateFields<Real, U>& fields,
                                    const unsigned char* whole) const {
  expect_motion(loads, fields);
  parallel_ranges(static_cast<std::int64_t>(items_.size()), [&](std::int64_t from, std::int64_t to) {
    for (std::size_t item = index(from); item < index(to); ++item) {
      const SweptBlock& swept = mesh_.blocks[index(items_[item].block)];
      if (whole != nullptr && whole[item] == 0)
        move_nodes(item, deferred_nodes(item), loads, fields);
      else if (with_apart_.empty())
        move_nodes(item, {all_nodes_.data(), index(swept.section.nodes())}, loads, fields);
      else
        move_marked(
            item, [](unsigned char mark) { return mark != kApart; }, loads, fields);
    }
  });
}

template <class Real, class U>
void BasicTimeUpdate<Real, U>::move_deferred(const StepLoads& loads,
                                             const BasicUpdateFields<Real, U>& fields) const {
  expect_motion(loads, fields);
  const std::int64_t values = 3 * kLanes * std::ssize(deferred_nodes_);
  ranges_of_values(std::ssize(with_deferred_), values, [&](std::int64_t from, std::int64_t to) {
    for (std::int64_t i = from; i < to; ++i) {
      const std::size_t item = with_deferred_[index(i)];
      move_nodes(item, deferred_nodes(item), loads, fields);
    }
  });
}

template <class Real, class U>
void BasicTimeUpdate<Real, U>::move_undeferred(std::size_t item, const StepLoads& loads,
                                               const BasicUpdateFields<Real, U>& fields) const {
  move_marked(
      item, [](unsigned char mark) { return mark == kMoves; }, loads, fields);
}

template <class Real, class U>
void BasicTimeUpdate<Real, U>::move_apart(const StepLoads& loads,
                                          const BasicUpdateFields<Real, U>& fields) const {
  expect_motion(loads, fields);
  for (const std::size_t item : with_apart_)
    move_marked(
        item, [](unsigned char mark) { return mark == kApart; }, loads, fields);
}

template <class Real, class U>
template <class Chosen>
void BasicTimeUpdate<Real, U>::move_marked(std::size_t item, const Chosen& chosen, const StepLoads& loads,
                                           const BasicUpdateFields<Real, U>& fields) const {
  const auto [block, tile] = items_[item];
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const std::int64_t first = swept.base / kLanes + std::int64_t{tile} * swept.section.nodes();
  thread_local std::vector<int> nodes;  // grows in the first calls only
  nodes.clear();
  for (int node = 0; node < swept.section.nodes(); ++node)
    if (chosen(deferred_[index(first + node)])) nodes.push_back(node);
  move_nodes(item, nodes, loads, fields);
}

/// Moves nodes of a tile.
template <class Real, class U>
void BasicTimeUpdate<Real, U>::move_nodes(std::size_t item, std::span<const int> nodes,
                                          const StepLoads& loads,
                                          const BasicUpdateFields<Real, U>& fields) const {
  if (nodes.empty()) return;
  const auto [block, tile] = items_[item];
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const std::int64_t slot = swept.base + std::int64_t{tile} * swept.section.nodes() * kLanes;
  const auto select = tile_forces().front()->loops<Real, U>().move;
  select({.sweep = swept.sweep, .vertical_only = swept.vertical_only})(
      motion(block, tile, loads, fields.displacement, fields.velocity), nodes, fields.force + dof(slot, 0));
}

template <class Real, class U>
std::span<const int> BasicTimeUpdate<Real, U>::deferred_nodes(std::size_t item) const {
  return std::span(deferred_nodes_)
      .subspan(first_deferred_[item], first_deferred_[item + 1] - first_deferred_[item]);
}

template class BasicTimeUpdate<double>;
template class BasicTimeUpdate<float, double>;
template class BasicTimeUpdate<float>;

}  // namespace tread
