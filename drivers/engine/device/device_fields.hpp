#pragma once
// The fields of a run on a device. [docs/records/device.md]
//
// The device moves every node but those on which connectors and loads act, and restrains and ties them. The
// others are the host's: the device hands it their forces, the host moves them and hands their motion back.
// Contact with surfaces of which the host moves nodes runs on the host, with copies of both about the patch.
// The views of NodeFields show the host's copies.

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "drivers/engine/device/device_looks.hpp"
#include "drivers/engine/device/device_movers.hpp"
#include "drivers/engine/device/sent_groups.hpp"
#include "drivers/engine/device/shown_groups.hpp"
#include "drivers/engine/fields/march_arrays.hpp"
#include "drivers/engine/fields/precise_fields.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/device_contact.hpp"
#include "kernels/device/device_ties.hpp"
#include "kernels/device/host_array.hpp"
#include "kernels/device/march_fan.hpp"
#include "kernels/device/surface_copies.hpp"

namespace tread {

template <class Real, class U>
class DeviceFields final : public PreciseFields<Real, U>, private ContactSteps {
 public:
  DeviceFields(const Model& model, std::shared_ptr<Device> device);
  ~DeviceFields() override;

  void set(const AlignedVector<double>& displacement, const AlignedVector<double>& velocity) override;
  void fetch() override;
  void changed() override;
  bool elsewhere() const override { return !host_whole_; }
  void show(const WatchedNodes& nodes) override {
    send();
    shown_.fetch(nodes.groups(), arrays_.now.u.data(), arrays_.now.v.data(), this->u(), this->v());
    if (this->q()) arrays_.lag.download(this->q()->values().data());
    fetch_law_state();
  }
  bool ties_follow() const override { return ties_ && !host_whole_; }

  void internal_force_and_move(const StepLoads& loads, bool measured) override;
  void move_rest(const StepLoads& loads, bool measured) override;
  /// The device holds those of its own as they move. The host's are so few that waking threads takes longer.
  void hold(std::span<const std::int64_t> unknowns) override {
    if (host_whole_) return Base::hold(unknowns);
    for (const std::int64_t unknown : host_held_) this->u()[index(unknown)] = this->v()[index(unknown)] = 0;
  }
  void advance_lag(double dt) override {
    if (!this->q()) return;
    if (host_whole_) Base::advance_lag(dt);
    if (device_whole_) lag_step_ = dt;
  }

  ElementEnergy element_energy() override {
    return host_whole_ ? Base::element_energy() : ElementEnergy{energies().stored, energies().dissipated};
  }
  BranchEnergy branch_energy() override {
    return host_whole_ ? Base::branch_energy() : BranchEnergy{energies().branch, energies().power};
  }
  double fixed_kinetic_energy() override {
    return host_whole_ ? Base::fixed_kinetic_energy() : sums().fixed_kinetic;
  }
  double fixed_gravity_potential() override {
    return host_whole_ ? Base::fixed_gravity_potential() : this->model().scene.gravity * sums().fixed_moment;
  }
  double half_step_excess(double dt) override {
    return host_whole_ ? Base::half_step_excess(dt) : 0.25 * sums().excess;
  }
  MeanMotion mean_motion(const SpinningBody& body, const BodyFrame& wheel) override {
    return host_whole_ ? Base::mean_motion(body, wheel) : mean_of(body, sums(wheel));
  }
  double kinetic_energy(const SpinningBody& body, const BodyFrame& wheel, double dt) override {
    return host_whole_ ? Base::kinetic_energy(body, wheel, dt) : sums(wheel).spinning_kinetic;
  }
  void anchor(const SpinningBody& body, const MeanMotion& mean, BodyFrame& wheel, double dt) override;

  void list_state(StateList& list) override;

 private:
  using Base = PreciseFields<Real, U>;
  void choose_movers(const Model& model, Movers movers);
  void make_room();
  MarchFields<Real, U> march_fields(int block) {
    return arrays_.fields(block, device_group_mark_.data(), held_.data(), device_f_.data());
  }
  void begin_next();
  void move_primary(const StepLoads& loads);
  void tie(const StepLoads& loads);
  void start_contact();
  void begin_motion(const StepLoads& loads);
  /// The host needs not wait for the march about the patch, which waits for the tractions.
  void start_host_forces() {
    if (packed_f_.size() == 0) return;
    const Beside beside(*device_, kCopyQueue);
    marches_.await_forces();
    device_->start_download(packed_f_.data(), device_f_.data(), packed_f_.size() * sizeof(Real));
  }
  void finish_motion(const StepLoads& loads);
  void take_host_forces();
  void fetch_surfaces(const BodyFrame& wheel, double dt);
  void fetch_nodes();
  bool has_contact() const;
  void search(const BodyFrame& wheel, double time, double dt) override;
  void resolve() override;
  void send();
  void add_patch_groups();
  void fetch_law_state() {
    for (std::size_t b = 0; b < arrays_.now.state.size(); ++b)
      if (arrays_.now.state[b].size() > 0)
        arrays_.now.state[b].download(this->law_state()->values(static_cast<int>(b)));
  }
  typename DeviceLooks<Real, U>::Motions motions();
  const NodeSums& sums(const BodyFrame& wheel) { return looks_.nodes(marches_, motions(), wheel); }
  const NodeSums& sums() { return looks_.nodes(marches_, motions()); }
  const ElementSums& energies();
  void advance_device_lag();
  void spoil();

  std::shared_ptr<Device> device_;
  FieldKernels<Real, U>& kernels_;
  MarchFan<Real, U> marches_;
  MarchArrays<Real, U> arrays_;

  std::vector<std::int64_t> host_groups_;  ///< the host's groups of kLanes slots, ascending
  std::vector<int> group_mark_;            ///< by group: its place in host_groups_, kMoves, kKeeps or kHolds
  DeviceArray<int> device_group_mark_;
  BasicTimeUpdate<Real, U> host_update_;  ///< of the host's groups alone
  HostArray<Real> packed_f_;              ///< of the host's groups: [group][component][lane]
  DeviceArray<Real> device_f_;

  std::optional<DeviceTies> ties_;       ///< none: there are no ties, or connectors act on tied nodes
  bool host_ties_ = false;               ///< connectors act on tied nodes
  DeviceArray<unsigned char> held_;      ///< MarchFields::held
  DeviceArray<std::int64_t> held_ties_;  ///< unknowns of tied nodes that stay zero
  std::vector<std::int64_t> host_held_;  ///< the host's groups' among them

  Contact* contact_;                                ///< null: absent
  std::optional<SurfaceCopies<Real, U>> surfaces_;  ///< with contact
  std::optional<DeviceContact> device_contact_;     ///< none: the host searches and solves
  std::vector<std::int64_t> copied_;                ///< by group: step of its last copy to the host
  std::int64_t step_ = 0;                           ///< number of the step, from 1 on

  SentGroups<Real, U> sent_;           ///< the host's groups, and those that its tractions moved
  std::array<LockedPages, 2> locked_;  ///< the host's copies of displacement and velocity

  StepLoads loads_;  ///< of the last step
  double time_ = 0;  ///< at which it began, with contact [s]
  DeviceLooks<Real, U> looks_;
  ShownGroups<Real, U> shown_;

  bool host_whole_ = true;     ///< the host's copies hold all values of the present
  bool host_moves_ = false;    ///< its groups since they were sent
  bool device_whole_ = false;  ///< the device holds those of all nodes that are not the host's
  double lag_step_ = 0;        ///< by which the device's lag has still to advance [s]
};

extern template class DeviceFields<double, double>;
extern template class DeviceFields<float, double>;
extern template class DeviceFields<float, float>;

}  // namespace tread
