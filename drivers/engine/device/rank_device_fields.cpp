#include "drivers/engine/device/rank_device_fields.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/contract.hpp"
#include "core/index.hpp"
#include "drivers/engine/device/device_movers.hpp"
#include "drivers/engine/model/restraints.hpp"

namespace tread {

template <class Real, class U>
RankDeviceFields<Real, U>::RankDeviceFields(const Model& model, std::shared_ptr<Ranks> ranks,
                                            std::shared_ptr<Device> device)
    : Base(model, std::move(ranks), Borders::halos),
      device_(std::move(device)),
      marches_(*device_),
      arrays_(*device_, model.mesh, this->internal(), this->q(), this->inverse_masses()),
      held_mark_(index(model.mesh.slots / kLanes), kMoves),
      mark_(held_mark_.size(), kKeeps) {
  keep_mark_ = DeviceArray<int>(*device_, std::span<const int>(mark_));
  device_mark_ = DeviceArray<int>(*device_, mark_.size());
  std::vector<unsigned char> held(index(model.mesh.slots), 0);
  for (const std::int64_t unknown : held_unknowns(model.mesh, model.restrained)) {
    held_mark_[index(unknown / kGroupValues)] = kHolds;
    mark_held(unknown, held);
  }
  held_ = DeviceArray<unsigned char>(*device_, std::span<const unsigned char>(held));
  for (int b = 0; b < static_cast<int>(model.mesh.blocks.size()); ++b)
    marches_.add(arrays_.march(*device_, b, {}), arrays_.variant(b));
  choose_tiles();
  // The patch is anywhere on both surfaces as yet: there are never more of the host's groups than now.
  std::size_t most = 0;
  for (const auto* stretches : {&this->own_stretches(), &this->halo()})
    this->cut().for_groups(*stretches, [&](std::int64_t first, std::int64_t last) {
      most += index(std::count(this->deferred().begin() + first, this->deferred().begin() + last, 1));
    });
  packed_f_ = HostArray<Real>(*device_, most * kGroupValues);
  device_f_ = DeviceArray<Real>(*device_, packed_f_.size());
  sent_ = SentGroups<Real, U>(*device_, {}, most, mark_.size());
  shown_ = ShownGroups<Real, U>(*device_, 1);
  patch_chosen();
}

/// Marches go over the rank's tiles. The states of the elements that end in these advance here, too: by
/// teams of their own, which read beyond the halo.
template <class Real, class U>
void RankDeviceFields<Real, U>::choose_tiles() {
  std::size_t first = 0;
  for (int b = 0; b < marches_.blocks(); ++b) {
    std::vector<ChosenTile> chosen(this->mesh().blocks[index(b)].tiles.size(), ChosenTile::no);
    const std::size_t last = first + chosen.size();
    for (const TileStretch& stretch : this->own_stretches())
      for (std::size_t tile = std::max(stretch.first, first); tile < std::min(stretch.last, last); ++tile)
        chosen[tile - first] = ChosenTile::yes;
    if (arrays_.now.state[index(b)].size() > 0)
      for (const std::size_t tile : this->tiles_before())
        if (tile >= first && tile < last) chosen[tile - first] = ChosenTile::apart;
    marches_.block(b).choose(*device_, chosen);
    first = last;
  }
}

template <class Real, class U>
void RankDeviceFields<Real, U>::patch_chosen() {
  forced_.clear();
  sent_.reset();
  this->cut().for_groups(this->own_stretches(), [this](std::int64_t first, std::int64_t last) {
    for (std::int64_t group = first; group < last; ++group) {
      mark_[index(group)] = held_mark_[index(group)];
      if (this->deferred()[index(group)] == 0) continue;
      mark_[index(group)] = static_cast<int>(forced_.size());
      forced_.push_back(group);
      sent_.add(group);
    }
  });
  this->cut().for_groups(this->halo(), [this](std::int64_t first, std::int64_t last) {
    for (std::int64_t group = first; group < last; ++group) sent_.add(group);
  });
  device_mark_.upload(mark_.data());
}

/// Whoever reads about the new patch reads the views.
template <class Real, class U>
void RankDeviceFields<Real, U>::bring(const std::vector<std::int64_t>& groups) {
  if (host_whole_) return;
  send();
  brought_.clear();
  std::copy_if(groups.begin(), groups.end(), std::back_inserter(brought_),
               [this](std::int64_t group) { return this->owns(group); });
  shown_.fetch(brought_, arrays_.now.u.data(), arrays_.now.v.data(), this->u(), this->v());
}

template <class Real, class U>
void RankDeviceFields<Real, U>::copy(Way way, void* on_device, void* on_host, std::size_t bytes) const {
  if (bytes == 0) return;
  if (way == Way::to_device)
    device_->upload(on_device, on_host, bytes);
  else
    device_->download(on_host, on_device, bytes);
}

/// Values of tiles: lag and states of laws, and the motion of the nodes.
template <class Real, class U>
void RankDeviceFields<Real, U>::copy(Way way, const std::vector<TileStretch>& stretches, bool with_motion) {
  const auto copy_values = [&](auto* on_device, auto* on_host, std::int64_t first, std::int64_t last) {
    copy(way, on_device + first, on_host + first, index(last - first) * sizeof(*on_host));
  };
  for (const TileStretch& stretch : stretches) {
    const std::int64_t first = this->cut().first_group(stretch.first) * kGroupValues;
    const std::int64_t last = this->cut().first_group(stretch.last) * kGroupValues;
    if (with_motion) {
      copy_values(arrays_.now.u.data(), this->u().data(), first, last);
      copy_values(arrays_.now.v.data(), this->v().data(), first, last);
    }
    if (this->q()) copy_values(arrays_.lag.data(), this->q()->values().data(), first, last);
    this->for_law_blocks([&](int b, const auto& place) {
      copy_values(arrays_.now.state[index(b)].data(), this->law_state()->values(b), place(stretch.first),
                  place(stretch.last));
    });
  }
}

/// The device holds all values of the present.
template <class Real, class U>
void RankDeviceFields<Real, U>::send() {
  if (device_whole_) {
    if (std::exchange(host_moves_, false))
      sent_.send(this->u(), this->v(), arrays_.now.u.data(), arrays_.now.v.data());
    advance_device_lag();
    return;
  }
  TREAD_EXPECT(host_whole_);
  if (device_->spoils_copies()) spoil_device();
  copy(Way::to_device, this->own_stretches(), true);
  copy(Way::to_device, this->halo(), true);
  device_whole_ = true;
}

/// The views hold the values of the own tiles. They hold the motion of the halo anyway.
template <class Real, class U>
void RankDeviceFields<Real, U>::come_home() {
  if (host_whole_) return;
  send();
  copy(Way::to_host, this->own_stretches(), true);
  copy(Way::to_host, this->halo(), false);
  host_whole_ = true;
}

template <class Real, class U>
void RankDeviceFields<Real, U>::advance_device_lag() {
  if (lag_step_ == 0) return;
  for (const auto* stretches : {&this->own_stretches(), &this->halo()})
    this->cut().for_groups(*stretches, [this](std::int64_t first, std::int64_t last) {
      arrays_.advance_lag(lag_step_, first * kLanes, last * kLanes);
    });
  lag_step_ = 0;
}

template <class Real, class U>
void RankDeviceFields<Real, U>::march(const StepLoads& loads, const DeviceArray<int>& marks) {
  marches_.start_chosen(
      loads, [&](int block) { return arrays_.fields(block, marks.data(), held_.data(), device_f_.data()); });
  marches_.join();
}

template <class Real, class U>
void RankDeviceFields<Real, U>::take_forces() {
  device_f_.download(packed_f_.data(), forced_.size() * kGroupValues);
  for_groups(forced_, 0, std::ssize(forced_), [&](std::int64_t packed, std::int64_t place) {
    std::copy_n(packed_f_.data() + packed, kGroupValues, this->f().data() + place);
  });
}

/// In a measured step no node moves as yet: the host gets all forces, and moves all.
template <class Real, class U>
void RankDeviceFields<Real, U>::internal_force_and_move(const StepLoads& loads, bool measured) {
  send();
  if (measured) {
    march(loads, keep_mark_);
    std::swap(arrays_.now.state, arrays_.next.state);
    host_whole_ = false;
    come_home();
    this->cut().for_groups(this->own_stretches(), [this](std::int64_t first, std::int64_t last) {
      copy(Way::to_host, arrays_.force().data() + first * kGroupValues,
           this->f().data() + first * kGroupValues, index(last - first) * kGroupValues * sizeof(Real));
    });
    changed();
  } else {
    march(loads, device_mark_);
    take_forces();
    std::swap(arrays_.now, arrays_.next);
    host_whole_ = false;
    host_moves_ = true;
    if (device_->spoils_copies()) spoil_host();
  }
  this->exchange_forces();
}

template <class Real, class U>
void RankDeviceFields<Real, U>::move_rest(const StepLoads& loads, bool measured) {
  if (measured) return Base::move_rest(loads, true);
  this->update().move_deferred(loads, {this->u().data(), this->v().data(), this->f().data()});
  if (this->solves()) this->move_patch(loads);
}

/// Who uses what lies beyond the halo is found out.
template <class Real, class U>
void RankDeviceFields<Real, U>::spoil_device() {
  AlignedVector<U> no_u(arrays_.now.u.size(), std::numeric_limits<U>::quiet_NaN());
  for (const auto* stretches : {&this->own_stretches(), &this->halo()})
    this->cut().for_groups(*stretches, [&](std::int64_t first, std::int64_t last) {
      std::fill(no_u.begin() + first * kGroupValues, no_u.begin() + last * kGroupValues, U{0});
    });
  const AlignedVector<Real> no_v(no_u.begin(), no_u.end());
  for (auto* motion : {&arrays_.now, &arrays_.next}) {
    motion->u.upload(no_u.data());
    motion->v.upload(no_v.data());
  }
}

/// Whoever reads what is not fetched is found out.
template <class Real, class U>
void RankDeviceFields<Real, U>::spoil_host() {
  this->cut().for_groups(this->own_stretches(), [this](std::int64_t first, std::int64_t last) {
    for (std::int64_t group = first; group < last; ++group) {
      if (this->deferred()[index(group)] != 0) continue;
      const std::int64_t place = group * kGroupValues;
      std::fill_n(this->f().data() + place, kGroupValues, std::numeric_limits<Real>::quiet_NaN());
      std::fill_n(this->u().data() + place, kGroupValues, std::numeric_limits<U>::quiet_NaN());
      std::fill_n(this->v().data() + place, kGroupValues, std::numeric_limits<Real>::quiet_NaN());
    }
  });
}

template class RankDeviceFields<double, double>;
template class RankDeviceFields<float, double>;
template class RankDeviceFields<float, float>;

}  // namespace tread
