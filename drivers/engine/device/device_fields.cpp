#include "drivers/engine/device/device_fields.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "core/contract.hpp"
#include "core/index.hpp"
#include "drivers/engine/fields/featured_nodes.hpp"

namespace tread {

template <class Real, class U>
DeviceFields<Real, U>::DeviceFields(const Model& model, std::shared_ptr<Device> device)
    : Base(model),
      device_(std::move(device)),
      kernels_(device_->template kernels<Real, U>()),
      marches_(*device_),
      arrays_(*device_, model.mesh, this->internal(), this->q(), this->take_masses()),
      host_update_(model.mesh, this->inverse_masses()),
      contact_(model.contact.get()),
      looks_(*device_, model, this->unforced()) {
  Movers movers = movers_of(model);
  for (int b = 0; b < static_cast<int>(model.mesh.blocks.size()); ++b) {
    marches_.add(arrays_.march(*device_, b, movers.marks), arrays_.variant(b));
    looks_.sums().add(this->internal().elements(b));
  }
  choose_movers(model, std::move(movers));
  if (contact_ != nullptr) surfaces_.emplace(*device_, model.mesh, *contact_);
  if (device_contact_) contact_->run_on(this);
  make_room();
}

template <class Real, class U>
DeviceFields<Real, U>::~DeviceFields() {
  device_->let_end();
  if (has_contact()) contact_->run_on(nullptr);
}

/// False where another run of the model has taken its contact.
template <class Real, class U>
bool DeviceFields<Real, U>::has_contact() const {
  return device_contact_ && contact_->steps() == this;
}

template <class Real, class U>
void DeviceFields<Real, U>::choose_movers(const Model& model, Movers movers) {
  group_mark_ = std::move(movers.marks);
  device_group_mark_ = DeviceArray<int>(*device_, std::span<const int>(group_mark_));
  host_groups_ = std::move(movers.hosted);
  std::vector<std::int64_t> slots;
  for (const std::int64_t group : host_groups_) slots.push_back(group * kLanes);
  host_update_.defer(slots);
  host_held_ = std::move(movers.held_hosts);
  held_ = DeviceArray<unsigned char>(*device_, std::span<const unsigned char>(movers.held));
  held_ties_ = DeviceArray<std::int64_t>(*device_, std::span<const std::int64_t>(movers.held_ties));
  if (movers.contact) device_contact_.emplace(*device_, *contact_, looks_.sums().mass());
  if (std::count(group_mark_.begin(), group_mark_.end(), kKeeps) > 0)
    ties_.emplace(*device_, model.mesh, *model.ties);
  host_ties_ = model.ties && !ties_;
}

template <class Real, class U>
void DeviceFields<Real, U>::make_room() {
  locked_ = {lock_pages(*device_, this->u()), lock_pages(*device_, this->v())};
  packed_f_ = HostArray<Real>(*device_, host_groups_.size() * kGroupValues);
  device_f_ = DeviceArray<Real>(*device_, packed_f_.size());
  copied_.assign(group_mark_.size(), 0);
  sent_ =
      SentGroups<Real, U>(*device_, host_groups_, surfaces_ ? surfaces_->capacity() : 0, group_mark_.size());
  shown_ = ShownGroups<Real, U>(*device_, host_groups_.size() + 1);
}

template <class Real, class U>
void DeviceFields<Real, U>::set(const AlignedVector<double>& displacement,
                                const AlignedVector<double>& velocity) {
  Base::set(displacement, velocity);
  changed();
}

template <class Real, class U>
void DeviceFields<Real, U>::changed() {
  marches_.forget();
  if (device_contact_) device_contact_->forget();
  host_whole_ = true;
  device_whole_ = host_moves_ = false;
  lag_step_ = 0;
}

/// The device holds all values of the present.
template <class Real, class U>
void DeviceFields<Real, U>::send() {
  if (device_whole_) {
    if (std::exchange(host_moves_, false)) {
      add_patch_groups();
      sent_.send(this->u(), this->v(), arrays_.now.u.data(), arrays_.now.v.data());
    }
    advance_device_lag();
    return;
  }
  TREAD_EXPECT(host_whole_);
  arrays_.now.u.upload(this->u().data());
  arrays_.now.v.upload(this->v().data());
  if (this->q()) arrays_.lag.upload(this->q()->data());
  for (std::size_t b = 0; b < arrays_.now.state.size(); ++b)
    if (arrays_.now.state[b].size() > 0)
      arrays_.now.state[b].upload(this->law_state()->values(static_cast<int>(b)));
  device_whole_ = true;
}

/// Adds the groups that the tractions have moved. Those of tied nodes follow on the device.
template <class Real, class U>
void DeviceFields<Real, U>::add_patch_groups() {
  if (contact_ == nullptr || device_contact_) return;
  sent_.reset();
  for (const PatchCells::Node& node : contact_->patch()) {
    const std::int64_t group = node.slot / kLanes;
    if (sent_.has(group) || group_mark_[index(group)] == kKeeps) continue;
    if (!host_whole_ && copied_[index(group)] != step_)
      throw std::logic_error("the tractions moved nodes that the host had no copy of");
    sent_.add(group);
  }
}

template <class Real, class U>
void DeviceFields<Real, U>::advance_device_lag() {
  if (lag_step_ == 0) return;
  arrays_.advance_lag(std::exchange(lag_step_, 0), 0, this->mesh().slots);
}

template <class Real, class U>
void DeviceFields<Real, U>::fetch() {
  fetch_nodes();
  if (!device_contact_) return;
  device_contact_->fetch_record();
  if (has_contact() && step_ > 0) device_contact_->fetch_points();
}

template <class Real, class U>
void DeviceFields<Real, U>::fetch_nodes() {
  if (host_whole_) return;
  send();
  arrays_.now.u.download(this->u().data());
  arrays_.now.v.download(this->v().data());
  if (this->q()) arrays_.lag.download(this->q()->values().data());
  fetch_law_state();
  host_whole_ = true;
}

/// Begins the next step by teams that do not await the host, about the patch when the tractions of this one
/// are there, and searches. It counts if no one changes the fields before.
template <class Real, class U>
void DeviceFields<Real, U>::begin_next() {
  if (!has_contact() || host_ties_ || this->q()) return;
  const std::array<SurfacePart, 2> parts = contact_->near(loads_.frame, loads_.dt);
  const auto reached = [&](int block, const SurfacePart& part) {
    return ReachedTiles{block, tiles_of(this->mesh().blocks[index(block)], part)};
  };
  StepLoads next = loads_;
  next.frame = loads_.frame.after(loads_.dt);
  marches_.begin_ahead(
      next,
      {reached(contact_->options().rail_block, parts[0]), reached(contact_->options().wheel_block, parts[1])},
      [&](int block) { return march_fields(block); });
  device_contact_->search_ahead(arrays_.now.u.data(), arrays_.now.v.data(),
                                {next.frame, time_ + loads_.dt, loads_.dt});
}

template <class Real, class U>
void DeviceFields<Real, U>::move_primary(const StepLoads& loads) {
  kernels_.sum_stations(ties_->sums(), arrays_.force().data());
  PrimaryBlocks<Real> primary;
  for (int b = 0; b < marches_.blocks(); ++b) {
    if (const PrimaryNodes nodes = ties_->primary(b); nodes.count > 0)
      primary.add(nodes, marches_.block(b).at(loads), marches_.variant(b));
    if (primary.blocks == PrimaryBlocks<Real>::kMost)
      kernels_.move_primary(std::exchange(primary, {}), march_fields(b));
  }
  kernels_.move_primary(primary, march_fields(0));
}

/// Moves and restrains the primary nodes, and lets the secondary nodes follow.
template <class Real, class U>
void DeviceFields<Real, U>::tie(const StepLoads& loads) {
  if (!ties_) return;
  move_primary(loads);
  kernels_.hold(static_cast<std::int64_t>(held_ties_.size()), held_ties_.data(), arrays_.next.u.data(),
                arrays_.next.v.data());
  kernels_.follow(ties_->secondary(), arrays_.next.u.data(), arrays_.next.v.data());
}

template <class Real, class U>
void DeviceFields<Real, U>::start_contact() {
  if (!device_contact_) return;
  device_->use(kPatchQueue);
  marches_.await_near();
  device_->use(kMainQueue);
  device_contact_->start(arrays_.next.u.data(), arrays_.next.v.data());
}

/// Tractions wait for the nodes about the patch alone.
template <class Real, class U>
void DeviceFields<Real, U>::begin_motion(const StepLoads& loads) {
  marches_.start(loads, [&](int block) { return march_fields(block); });
  start_contact();
  start_host_forces();
  marches_.join();
}

template <class Real, class U>
void DeviceFields<Real, U>::finish_motion(const StepLoads& loads) {
  tie(loads);
  std::swap(arrays_.now, arrays_.next);
  ++step_;
  loads_ = loads;
  host_moves_ = true;
}

template <class Real, class U>
void DeviceFields<Real, U>::internal_force_and_move(const StepLoads& loads, bool measured) {
  send();
  begin_motion(loads);
  finish_motion(loads);
  looks_.open(loads, measured);
  if (!measured) begin_next();  // it writes over the motion before
  take_host_forces();
  if (!device_contact_) fetch_surfaces(loads.frame, loads.dt);
  host_whole_ = false;
  if (device_->spoils_copies()) spoil();
}

template <class Real, class U>
void DeviceFields<Real, U>::take_host_forces() {
  device_->finish(kCopyQueue);
  for_groups(host_groups_, 0, std::ssize(host_groups_), [&](std::int64_t packed, std::int64_t place) {
    std::copy_n(packed_f_.data() + packed, kGroupValues, this->f().data() + place);
  });
}

/// Copies all that the contact may read until the next step has moved. The host's groups are its own.
template <class Real, class U>
void DeviceFields<Real, U>::fetch_surfaces(const BodyFrame& wheel, double dt) {
  if (!surfaces_) return;
  surfaces_->fetch(contact_->near(wheel, dt), arrays_.now.u.data(), arrays_.now.v.data());
  const std::int64_t groups = surfaces_->groups();
  ranges_of_values(groups, kGroupValues * groups, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i) {
      const std::int64_t group = surfaces_->group(i);
      if (group_mark_[index(group)] >= 0) continue;
      copied_[index(group)] = step_;
      std::copy_n(surfaces_->u(i), kGroupValues, this->u().data() + group * kGroupValues);
      std::copy_n(surfaces_->v(i), kGroupValues, this->v().data() + group * kGroupValues);
    }
  });
}

template <class Real, class U>
void DeviceFields<Real, U>::search(const BodyFrame& wheel, double time, double dt) {
  send();
  time_ = time;
  device_contact_->search(arrays_.now.u.data(), arrays_.now.v.data(), {wheel, time, dt});
}

/// Samples read the points of the patch.
template <class Real, class U>
void DeviceFields<Real, U>::resolve() {
  if (marches_.has_begun()) {
    send();
    marches_.go_on_ahead([&](int block) { return march_fields(block); });
  }
  device_contact_->resolve();
  if (looks_.measured()) device_contact_->fetch_points();
}

/// Whoever reads what is not fetched is found out.
template <class Real, class U>
void DeviceFields<Real, U>::spoil() {
  for (std::size_t group = 0; group < group_mark_.size(); ++group) {
    if (group_mark_[group] >= 0) continue;
    const std::size_t place = group * kGroupValues;
    std::fill_n(this->f().data() + place, kGroupValues, std::numeric_limits<Real>::quiet_NaN());
    if (copied_[group] == step_) continue;
    std::fill_n(this->u().data() + place, kGroupValues, std::numeric_limits<U>::quiet_NaN());
    std::fill_n(this->v().data() + place, kGroupValues, std::numeric_limits<Real>::quiet_NaN());
  }
}

template <class Real, class U>
void DeviceFields<Real, U>::move_rest(const StepLoads& loads, bool /*measured*/) {
  looks_.close();
  host_update_.move_deferred(loads, {this->u().data(), this->v().data(), this->f().data()});
}

template <class Real, class U>
typename DeviceLooks<Real, U>::Motions DeviceFields<Real, U>::motions() {
  if (!looks_.opening()) send();
  return {{arrays_.now.u.data(), arrays_.now.v.data()},
          {arrays_.next.u.data(), arrays_.next.v.data()},
          arrays_.inverse_mass()};
}

template <class Real, class U>
const ElementSums& DeviceFields<Real, U>::energies() {
  return looks_.elements(marches_, [&](int b) {
    typename DeviceSums<Real, U>::ElementFields of;
    of.u = arrays_.next.u.data();
    of.state = arrays_.now.state[index(b)].data();
    if (!this->q() || !this->q()->branch(b)) return of;
    of.branch = &*this->q()->branch(b);
    of.lag = arrays_.lag.data();
    return of;
  });
}

template <class Real, class U>
void DeviceFields<Real, U>::anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel,
                                   double dt) {
  if (host_whole_) {
    Base::anchor(body, mean, wheel, dt);
    return;
  }
  send();
  marches_.forget();
  marches_.join();  // they read what moves
  if (device_contact_) device_contact_->forget();
  device_->after(kSearchQueue);
  const Anchoring anchoring(mean, wheel, dt);
  for (const int b : body.blocks())
    kernels_.anchor(looks_.sums().anchored(marches_.block(b).at(loads_), b, anchoring), arrays_.now.u.data(),
                    arrays_.now.v.data());
  wheel = anchoring.moved();
  looks_.forget();
  if (ties_) kernels_.follow(ties_->secondary(), arrays_.now.u.data(), arrays_.now.v.data());
  shown_.fetch(host_groups_, arrays_.now.u.data(), arrays_.now.v.data(), this->u(), this->v());
  host_moves_ = host_ties_;  // tied nodes have still to follow there
  if (!device_contact_) fetch_surfaces(wheel, dt);
}

/// Whoever lists the state may read or restore it.
template <class Real, class U>
void DeviceFields<Real, U>::list_state(StateList& list) {
  fetch();
  changed();
  if (has_contact()) device_contact_->release();
  Base::list_state(list);
}

template class DeviceFields<double, double>;
template class DeviceFields<float, double>;
template class DeviceFields<float, float>;

}  // namespace tread
