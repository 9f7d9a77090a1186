#include "drivers/engine/device_fields.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/contract.hpp"
#include "core/index.hpp"
#include "drivers/engine/featured_nodes.hpp"

namespace tread {

namespace {}  // namespace

DeviceNeed device_need(const Model& model) {
  const std::vector<unsigned char> marks = groups_of(model.mesh, featured_slots(model));
  const std::int64_t groups = std::count(marks.begin(), marks.end(), 1);
  const ValueBytes bytes = value_bytes(model.scene);
  const std::int64_t moved = 2 * (bytes.displacement + bytes.other);  // before and after the step
  const int others = bytes.other * (model.has_branches() ? 2 : 1);    // forces, lag
  DeviceNeed need;
  need.host_nodes = groups * kLanes;
  need.bytes = 3 * model.mesh.slots * (moved + others) + model.mesh.slots * bytes.other +
               groups * kGroupValues * (bytes.displacement + 2 * bytes.other);
  if (has_laws(model.mesh)) need.bytes += 2 * bytes.other * law_state_values(model.mesh);
  need.bytes += model.internal->bytes() * bytes.other / static_cast<std::int64_t>(sizeof(double));
  return need;
}

template <class Real, class U>
DeviceFields<Real, U>::DeviceFields(const Model& model, std::shared_ptr<Device> device)
    : Base(model), device_(std::move(device)) {
  const Mesh& mesh = model.mesh;
  const std::size_t components = index(3 * mesh.slots);
  std::size_t tiles = 0;
  for (Arrays* arrays : {&now_, &next_}) {
    arrays->u = DeviceArray<U>(*device_, components);
    arrays->v = DeviceArray<Real>(*device_, components);
  }
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b) {
    const BlockElements<Real>& elements = this->internal().elements(b);
    const SweptBlock& block = mesh.blocks[index(b)];
    blocks_.push_back(std::make_unique<BlockMarch<Real>>(*device_, elements, this->internal().damping(b)));
    const int law = this->law_state() ? elements.law() : 0;
    const std::size_t values =
        block.tiles.size() * block.section.quads.size() * kLanes * index(state_values(law));
    for (Arrays* arrays : {&now_, &next_}) arrays->state.emplace_back(*device_, values);
    tiles += block.tiles.size();
  }
  if (this->q()) lag_ = DeviceArray<Real>(*device_, components);
  force_ = DeviceArray<Real>(*device_, components);
  inverse_mass_ = DeviceArray<Real>(*device_, std::span(this->inverse_mass(), index(mesh.slots)));
  no_whole_tiles_.assign(tiles, 0);
  choose_host_groups(model);
}

template <class Real, class U>
void DeviceFields<Real, U>::choose_host_groups(const Model& model) {
  const std::vector<std::int64_t> slots = featured_slots(model);
  this->update().defer(slots);
  for (const unsigned char mark : groups_of(model.mesh, slots)) {
    if (mark != 0) groups_.push_back(std::ssize(host_group_));
    host_group_.push_back(mark != 0 ? static_cast<int>(groups_.size()) - 1 : -1);
  }
  const std::size_t values = groups_.size() * kGroupValues;
  packed_u_.resize(values);
  packed_v_.resize(values);
  packed_f_.resize(values);
  device_groups_ = DeviceArray<std::int64_t>(*device_, std::span<const std::int64_t>(groups_));
  device_host_group_ = DeviceArray<int>(*device_, std::span<const int>(host_group_));
  device_u_ = DeviceArray<U>(*device_, values);
  device_v_ = DeviceArray<Real>(*device_, values);
  device_f_ = DeviceArray<Real>(*device_, values);
}

template <class Real, class U>
void DeviceFields<Real, U>::set(const AlignedVector<double>& displacement,
                                const AlignedVector<double>& velocity) {
  Base::set(displacement, velocity);
  changed();
}

template <class Real, class U>
void DeviceFields<Real, U>::changed() {
  host_whole_ = true;
  device_whole_ = false;
  lag_step_ = 0;
}

/// The device holds all values of the present.
template <class Real, class U>
void DeviceFields<Real, U>::send() {
  if (device_whole_) {
    send_host_groups();
    advance_device_lag();
    return;
  }
  TREAD_EXPECT(host_whole_);
  now_.u.upload(this->u().data());
  now_.v.upload(this->v().data());
  if (this->q()) lag_.upload(this->q()->data());
  for (std::size_t b = 0; b < now_.state.size(); ++b)
    if (now_.state[b].size() > 0) now_.state[b].upload(this->law_state()->values(static_cast<int>(b)));
  device_whole_ = true;
}

template <class Real, class U>
void DeviceFields<Real, U>::send_host_groups() {
  for_groups(groups_, 0, std::ssize(groups_), [&](std::int64_t packed, std::int64_t place) {
    std::copy_n(this->u().data() + place, kGroupValues, packed_u_.data() + packed);
    std::copy_n(this->v().data() + place, kGroupValues, packed_v_.data() + packed);
  });
  device_u_.upload(packed_u_.data());
  device_v_.upload(packed_v_.data());
  const GroupValues<Real, U> values{device_groups_.data(), std::ssize(groups_), device_u_.data(),
                                    device_v_.data()};
  device_->place(values, now_.u.data(), now_.v.data());
}

template <class Real, class U>
void DeviceFields<Real, U>::advance_device_lag() {
  if (lag_step_ == 0) return;
  for (int b = 0; b < static_cast<int>(blocks_.size()); ++b) {
    if (!this->q()->branch(b)) continue;
    const auto [kept, gained] = this->q()->advance_of(b, lag_step_);
    const SweptBlock& block = this->mesh().blocks[index(b)];
    const std::int64_t first = dof(block.base, 0);
    device_->advance_lag(3 * block.slots(), kept, gained, now_.v.data() + first, lag_.data() + first);
  }
  lag_step_ = 0;
}

template <class Real, class U>
void DeviceFields<Real, U>::fetch() {
  if (host_whole_) return;
  send();
  now_.u.download(this->u().data());
  now_.v.download(this->v().data());
  if (this->q()) lag_.download(this->q()->values().data());
  fetch_law_state();
  host_whole_ = true;
}

template <class Real, class U>
void DeviceFields<Real, U>::fetch_law_state() {
  for (std::size_t b = 0; b < now_.state.size(); ++b)
    if (now_.state[b].size() > 0) now_.state[b].download(this->law_state()->values(static_cast<int>(b)));
}

template <class Real, class U>
void DeviceFields<Real, U>::march(const StepLoads& loads, bool moves) {
  const auto& internal = this->internal();
  for (int b = 0; b < static_cast<int>(blocks_.size()); ++b) {
    const SweptBlock& block = this->mesh().blocks[index(b)];
    const bool branch = internal.branch(b) != 0;
    MarchFields<Real, U> fields;
    fields.u = now_.u.data();
    fields.v = now_.v.data();
    if (internal.damping(b) != 0) fields.added = branch ? lag_.data() : now_.v.data();
    fields.inverse_mass = inverse_mass_.data();
    if (moves) {
      fields.moved_u = next_.u.data();
      fields.moved_v = next_.v.data();
    }
    fields.force = force_.data();
    fields.host_group = device_host_group_.data();
    fields.host_force = device_f_.data();
    fields.state = now_.state[index(b)].data();
    fields.moved_state = next_.state[index(b)].data();
    const int law = this->law_state() ? internal.law(b) : 0;
    device_->march(
        {block.sweep, fields.added != nullptr, internal.finite_rotation(b), block.vertical_only, law},
        blocks_[index(b)]->at(loads), fields);
  }
  std::swap(now_.state, next_.state);
}

template <class Real, class U>
void DeviceFields<Real, U>::internal_force() {
  fetch();
  send();
  march({}, false);
  force_.download(this->f().data());
  fetch_law_state();
}

template <class Real, class U>
void DeviceFields<Real, U>::internal_force_and_move(const StepLoads& loads) {
  send();
  march(loads, true);
  std::swap(now_.u, next_.u);
  std::swap(now_.v, next_.v);
  device_f_.download(packed_f_.data());
  for_groups(groups_, 0, std::ssize(groups_), [&](std::int64_t packed, std::int64_t place) {
    std::copy_n(packed_f_.data() + packed, kGroupValues, this->f().data() + place);
  });
  host_whole_ = false;
  if (device_->spoils_copies()) spoil();
}

/// Whoever reads what is not fetched is found out.
template <class Real, class U>
void DeviceFields<Real, U>::spoil() {
  for (std::size_t group = 0; group < host_group_.size(); ++group) {
    if (host_group_[group] >= 0) continue;
    const std::size_t place = group * kGroupValues;
    std::fill_n(this->u().data() + place, kGroupValues, std::numeric_limits<U>::quiet_NaN());
    std::fill_n(this->v().data() + place, kGroupValues, std::numeric_limits<Real>::quiet_NaN());
    std::fill_n(this->f().data() + place, kGroupValues, std::numeric_limits<Real>::quiet_NaN());
  }
}

template <class Real, class U>
void DeviceFields<Real, U>::move_all(const StepLoads& loads) {
  Base::move_all(loads);
  changed();
}

template <class Real, class U>
void DeviceFields<Real, U>::move_rest(const StepLoads& loads) {
  this->update().move_rest(loads, {this->u().data(), this->v().data(), this->f().data()}, no_whole_tiles_);
}

template <class Real, class U>
void DeviceFields<Real, U>::advance_lag(double dt) {
  if (!this->q()) return;
  if (host_whole_)
    Base::advance_lag(dt);
  else
    lag_step_ = dt;
}

/// Whoever lists the state may read or restore it.
template <class Real, class U>
void DeviceFields<Real, U>::list_state(StateList& list) {
  fetch();
  changed();
  Base::list_state(list);
}

template class DeviceFields<double, double>;
template class DeviceFields<float, double>;
template class DeviceFields<float, float>;

}  // namespace tread
