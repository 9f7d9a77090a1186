#include "kernels/blocks/internal_force.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel/parallel.hpp"
#include "kernels/blocks/law_stress.hpp"

namespace tread {

namespace {

/// Scratch of a thread; grows in its first calls only.
template <class Real>
Real* front_of(const FrontPlan& plan, int law) {
  const int values = kFrontValues + kShiftValues + (is_linear(law) ? 0 : kRateValues);
  thread_local AlignedVector<Real> front;
  front.resize(std::max(front.size(), index(plan.slots) * kTilesAbreast * index(values)));
  return front.data();
}

}  // namespace

double von_mises(const std::array<double, 6>& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

template <class Real, class U>
BasicInternalForce<Real, U>::BasicInternalForce(const Mesh& mesh)
    : mesh_(mesh), forces_(tile_forces().front()) {
  cost_.push_back(0);
  for (int block = 0; block < static_cast<int>(mesh.blocks.size()); ++block) {
    const SweptBlock& swept = mesh.blocks[index(block)];
    BlockData& data = blocks_.emplace_back(mesh, block);
    data.carry_stride = index(3 * swept.section.nodes() + kLanes);
    carries_.emplace_back(swept.tiles.size() * data.carry_stride);
    no_carry_.resize(std::max(no_carry_.size(), data.carry_stride), 0);
    data.first_item = items_.size();
    for (int tile = 0; tile < static_cast<int>(swept.tiles.size()); ++tile) {
      items_.push_back({block, tile});
      cost_.push_back(cost_.back() + data.elements.cost(tile));
    }
  }
  halves_.resize(items_.size(), 0);
  unmoved_.resize(items_.size(), 0);
}

template <class Real, class U>
void BasicInternalForce<Real, U>::internal_force(int block, const U* u, const Real* v, Real* f) const {
  const std::size_t first = blocks_[index(block)].first_item;
  evaluate(first, first + mesh_.blocks[index(block)].tiles.size(), {u, v, nullptr, f, false});
}

template <class Real, class U>
Real* BasicInternalForce<Real, U>::carry(const Item& item) const {
  return carries_[index(item.block)].data() + index(item.tile) * blocks_[index(item.block)].carry_stride +
         kLanes;
}

template <class Real, class U>
std::span<const Real> BasicInternalForce<Real, U>::carry(std::size_t tile) const {
  const SweptBlock& swept = mesh_.blocks[index(items_[tile].block)];
  return {carry(items_[tile]), index(3 * swept.section.nodes())};
}

/// First of the items [first, last) that has this cost before it; tiles that the loop joins stay together.
template <class Real, class U>
std::size_t BasicInternalForce<Real, U>::item_at(std::size_t first, std::size_t last,
                                                 std::int64_t cost) const {
  const auto begin = cost_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = cost_.begin() + static_cast<std::ptrdiff_t>(last);
  const auto i = static_cast<std::size_t>(std::lower_bound(begin, end, *begin + cost) - cost_.begin());
  return i > first && i < last && joined(i - 1) ? i + 1 : i;
}

template <class Real, class U>
void BasicInternalForce<Real, U>::move(std::span<const TileStretch> stretches,
                                       const BasicTimeUpdate<Real, U>& update, const StepLoads& loads,
                                       const ForceFields<Real, U>& at) const {
  evaluate(stretches, moved_fields(update, loads, at));
}

template <class Real, class U>
void BasicInternalForce<Real, U>::move(const WorkBeside& work, const BasicTimeUpdate<Real, U>& update,
                                       const StepLoads& loads, const ForceFields<Real, U>& at) const {
  const Fields fields = moved_fields(update, loads, at);
  begin();
  const auto move_share = [&](std::span<const TileStretch> stretches) {
    return [this, stretches, &fields](std::int64_t from, std::int64_t to) {
      evaluate_share(stretches, from, to, fields);
    };
  };
  const auto near = move_share(work.near);
  const auto then = [&](std::int64_t, std::int64_t) { work.then(); };
  const std::array<Link, 3> links = {{{work.n, work.first}, {cost_of(work.near), near}, {1, then}}};
  ranges_beside(links, cost_of(work.elsewhere), move_share(work.elsewhere));
}

template <class Real, class U>
void BasicInternalForce<Real, U>::evaluate(std::span<const TileStretch> stretches,
                                           const Fields& fields) const {
  begin();
  parallel_ranges(cost_of(stretches),
                  [&](std::int64_t from, std::int64_t to) { evaluate_share(stretches, from, to, fields); });
}

template <class Real, class U>
std::int64_t BasicInternalForce<Real, U>::cost_of(std::span<const TileStretch> stretches) const {
  std::int64_t cost = 0;
  for (const TileStretch& stretch : stretches) cost += cost_[stretch.last] - cost_[stretch.first];
  return cost;
}

/// Successive items, by the cost before them.
template <class Real, class U>
void BasicInternalForce<Real, U>::evaluate_share(std::span<const TileStretch> stretches, std::int64_t from,
                                                 std::int64_t to, const Fields& fields) const {
  Item before;
  for (const TileStretch& stretch : stretches) {
    const std::int64_t cost = cost_of({&stretch, 1});
    if (from < cost && to > 0) {
      const auto item = [&](std::int64_t at) {
        return item_at(stretch.first, stretch.last, std::clamp(at, std::int64_t{0}, cost));
      };
      evaluate_items(item(from), item(to), before, fields);
    }
    from -= cost;
    to -= cost;
  }
  leave(before, fields);
}

/// An item is evaluated, and the one behind it is not next.
template <class Real, class U>
void BasicInternalForce<Real, U>::leave(const Item& item, const Fields& fields) const {
  if (item.block < 0) return;
  const Tile& tile = mesh_.blocks[index(item.block)].tiles[index(item.tile)];
  if (tile.elements > 0) complete({item.block, tile.next}, fields);
}

/// The item, or the one before it, is evaluated: the thread that comes second adds the force between them,
/// and moves the item's nodes, which nobody reads any more.
template <class Real, class U>
void BasicInternalForce<Real, U>::complete(const Item& item, const Fields& fields) const {
  const std::size_t i = blocks_[index(item.block)].first_item + index(item.tile);
  if (std::atomic_ref(halves_[i]).fetch_add(1) == 0) return;
  add_carry(item, fields.f);
  const Moved& moved = fields.moved;
  if (moved.update == nullptr) return;
  moved.update->move_undeferred(i, *moved.loads, {moved.u, moved.v, fields.f});
  unmoved_[i] = 0;
}

template <class Real, class U>
void BasicInternalForce<Real, U>::add_carry(const Item& item, Real* f) const {
  const SweptBlock& swept = mesh_.blocks[index(item.block)];
  const Real* carry = this->carry({item.block, blocks_[index(item.block)].elements.previous(item.tile)});
  f += dof(swept.base + std::int64_t{item.tile} * swept.section.nodes() * kLanes, 0);
  for (int value = 0; value < 3 * swept.section.nodes(); ++value)
    f[std::ptrdiff_t{value} * kLanes] += carry[value];
}

template <class Real, class U>
void BasicInternalForce<Real, U>::evaluate_items(std::size_t first, std::size_t last, Item& before,
                                                 const Fields& fields) const {
  const int most = forces_->loops<Real, U>().tiles;
  for (std::size_t i = first; i < last;) {
    const Item item = items_[i];
    const BlockData& data = blocks_[index(item.block)];
    const int previous = data.elements.previous(item.tile);
    const bool at_hand = previous >= 0 && before.block == item.block && before.tile == previous;
    const bool empty = mesh_.blocks[index(item.block)].tiles[index(item.tile)].elements == 0;
    const int tiles = joined(i) ? most : 1;
    const bool half = previous >= 0 && !at_hand;
    if (!at_hand) leave(before, fields);
    // The tile before reads what this one holds, maybe later.
    unmoved_[i] = half || empty;
    if (tiles > 1) unmoved_[i + 1] = 0;
    const Real* carry_in = at_hand ? carry({item.block, previous}) : no_carry_.data() + kLanes;
    if (empty)
      pass_carry(item, carry_in, fields.f);
    else
      evaluate_tiles(i, tiles, carry_in, fields);
    if (half) complete(item, fields);
    i += static_cast<std::size_t>(tiles);
    before = items_[i - 1];
  }
}

/// To the last station of an open block in a tile of its own.
template <class Real, class U>
void BasicInternalForce<Real, U>::pass_carry(const Item& item, const Real* carry_in, Real* f) const {
  const SweptBlock& swept = mesh_.blocks[index(item.block)];
  const std::int64_t slots = std::int64_t{swept.section.nodes()} * kLanes;
  f += dof(swept.base + item.tile * slots, 0);
  std::fill_n(f, 3 * slots, Real{0});
  for (std::int64_t value = 0; value < 3 * swept.section.nodes(); ++value)
    f[value * kLanes] = carry_in[value];
}

template <class Real, class U>
void BasicInternalForce<Real, U>::evaluate_tiles(std::size_t first, int tiles, const Real* carry_in,
                                                 const Fields& fields) const {
  const Item& item = items_[first];
  const Item& last = items_[first + static_cast<std::size_t>(tiles) - 1];
  const SweptBlock& swept = mesh_.blocks[index(item.block)];
  const BlockData& data = blocks_[index(item.block)];
  const Tile& last_tile = swept.tiles[index(last.tile)];
  const std::int64_t slots = std::int64_t{swept.section.nodes()} * kLanes;
  const std::int64_t own = dof(swept.base + item.tile * slots, 0);
  const std::int64_t next = dof(swept.base + last_tile.next * slots, 0);
  const Real* const added = data.branch != 0 ? fields.q : data.beta != 0 ? fields.v : nullptr;

  TileView<Real, U> view;
  view.u = fields.u + own;
  view.u_next = fields.u + next;
  if (added != nullptr) {
    view.added = added + own;
    view.added_next = added + next;
  }
  view.f = fields.f + own;
  TileMotion<Real, U> motion[kTilesAbreast];
  for (int tile = 0; tile < tiles; ++tile) {
    const Moved& moved = fields.moved;
    if (moved.update == nullptr || unmoved_[first + static_cast<std::size_t>(tile)]) continue;
    motion[tile] = moved.update->motion(item.block, item.tile + tile, *moved.loads, moved.u, moved.v);
    view.motion[tile] = &motion[tile];
  }
  view.carry_in = carry_in;
  view.carry_out = carry(last);
  view.elements = last_tile.elements;
  view.tiles = tiles;
  view.stride = 3 * slots;

  const int law = fields.laws != nullptr ? data.elements.law() : 0;
  if (law != 0) {
    view.advanced_state = fields.laws->values(item.block) + data.elements.state_place(item.tile);
    view.state = view.advanced_state;
  }
  const TileVariant variant{swept.sweep, added != nullptr, data.finite_rotation && !fields.linear,
                            swept.vertical_only, law};
  forces_->loops<Real, U>().force(variant)(data.elements.tile_elements(item.tile, tiles, data.damping()),
                                           view, front_of<Real>(data.elements.plan(), law));
}

template <class Real, class U>
DeformationEnergy BasicInternalForce<Real, U>::energy(int block, const U* u,
                                                      const LawState<Real>* laws) const {
  return sum_tiles<DeformationEnergy>(mesh_, std::span(&block, 1), nullptr, [&](int /*block*/, int tile) {
    return tile_energy(block, tile, u, laws);
  });
}

template <class Real, class U>
DeformationEnergy BasicInternalForce<Real, U>::tile_energy(int block, int tile, const U* u,
                                                           const LawState<Real>* laws) const {
  return sum_elements(block, tile, u, blocks_[index(block)].finite_rotation, laws);
}

template <class Real, class U>
double BasicInternalForce<Real, U>::linear_energy(int block, int tile, const Real* q) const {
  const DeformationEnergy sum = sum_elements(block, tile, q, false, nullptr);
  return sum.strain + sum.hourglass;
}

template <class Real, class U>
template <class Value>
DeformationEnergy BasicInternalForce<Real, U>::sum_elements(int block, int number, const Value* field,
                                                            bool finite_rotation,
                                                            const LawState<Real>* laws) const {
  const SweptBlock& swept = mesh_.blocks[index(block)];
  const BlockData& data = blocks_[index(block)];
  const Tile& tile = swept.tiles[index(number)];
  if (tile.elements == 0) return {};
  const int law = laws != nullptr ? data.elements.law() : 0;
  const std::int64_t slots = std::int64_t{swept.section.nodes()} * kLanes;
  TileView<Real, Value> view;
  view.u = field + dof(swept.base + number * slots, 0);
  view.u_next = field + dof(swept.base + tile.next * slots, 0);
  view.elements = tile.elements;
  if (law != 0) view.state = laws->values(block) + data.elements.state_place(number);
  const TileEnergy<Real, Value> of_tile =
      forces_->loops<Real, Value>().energy({swept.sweep, false, finite_rotation, false, law});
  return of_tile(data.elements.tile_elements(number, 1, 0), view, front_of<Real>(data.elements.plan(), law));
}

template <class Real, class U>
std::array<double, 6> BasicInternalForce<Real, U>::stress(int block, int quad, int station, ConstNodeField u,
                                                          ConstNodeField q, ConstLawState laws) const {
  const BlockData& data = blocks_[index(block)];
  const BlockElements<Real>& elements = data.elements;
  const ElementPlace at = elements.locate(quad, station);
  const Material& material = elements.block().material(quad, at.pitch_class);
  const int law = laws ? elements.law() : 0;
  const auto strength = static_cast<Real>(q ? data.branch : 0);
  Real values[8][3];
  Real lags[8][3] = {};
  elements.gather(at, u, values);
  if (strength != 0) elements.gather(at, q, lags);
  if (law == 0)
    for (int node = 0; node < 8; ++node)
      for (int i = 0; i < 3; ++i)
        if (strength != 0) values[node][i] += strength * lags[node][i];
  Real s[6];
  Real e[6];
  const bool finite_rotation = data.finite_rotation;
  elements.with_element(at, [&](const auto& element) {
    Real sums[4][3];
    Real differences[4][3];
    const auto strain_of = [&](const Real(&nodal)[8][3]) {
      elements.spread(
          at, [&](int node, int i) { return nodal[node][i]; }, sums, differences);
      return element_strain(element, sums, differences);
    };
    const Strain<Real> strain = strain_of(values);
    law_strain(finite_rotation, strain, e);
    if (law == 0) {
      LinearElastic<Real>::of(material).stress(e, s);
      return;
    }
    const std::int64_t first = elements.state_place(elements.block().tile_of_station[index(station)]) +
                               std::int64_t{at.place} * state_values(law) * kLanes +
                               elements.block().slot(0, station) % kLanes;
    law_stress(
        law, material, [&](int i) { return laws.value(block, first + std::int64_t{i} * kLanes); }, e, s);
    if (strength == 0) return;
    Real added[6];
    const Strain<Real> lag = strain_of(lags);
    if (finite_rotation)
      point_strain_rate<true>(strain.g, lag.g, e);
    else
      point_strain_rate<false>(strain.g, lag.g, e);
    LinearElastic<Real>::of(material).stress(e, added);
    for (int i = 0; i < 6; ++i) s[i] += strength * added[i];
  });
  return {s[0], s[1], s[2], s[3], s[4], s[5]};
}

template <class Real, class U>
void BasicInternalForce<Real, U>::lumped_mass(double* mass) const {
  std::fill_n(mass, mesh_.slots, 0.0);
  for (const BlockData& data : blocks_) add_lumped_mass(data.elements, mass);
}

template <class Real, class U>
void BasicInternalForce<Real, U>::diagonal(double* d) const {
  std::fill_n(d, 3 * mesh_.slots, 0.0);
  for (const BlockData& data : blocks_) add_diagonal(data.elements, d);
}

template <class Real, class U>
std::int64_t BasicInternalForce<Real, U>::perturbed_elements() const {
  std::int64_t count = 0;
  for (const BlockData& data : blocks_) count += data.elements.perturbed_elements();
  return count;
}

template <class Real, class U>
std::int64_t BasicInternalForce<Real, U>::bytes() const {
  std::int64_t sum = 0;
  for (const BlockData& data : blocks_) sum += data.elements.bytes();
  for (const PageVector<Real>& carries : carries_)
    sum += static_cast<std::int64_t>(carries.size() * sizeof(Real));
  return sum;
}

template <class Real, class U>
std::vector<const char*> BasicInternalForce<Real, U>::instruction_sets() {
  std::vector<const char*> names;
  for (const TileForces* forces : tile_forces()) names.push_back(forces->name);
  return names;
}

template <class Real, class U>
void BasicInternalForce<Real, U>::use_instruction_set(const char* name) {
  for (const TileForces* forces : tile_forces())
    if (std::strcmp(forces->name, name) == 0) {
      forces_ = forces;
      return;
    }
  throw InputError(fmt::format("instruction set '{}' is not available on this processor", name));
}

template class BasicInternalForce<double>;
template class BasicInternalForce<float, double>;
template class BasicInternalForce<float>;

}  // namespace tread
