#pragma once
// The contact of a run on a device: search, tractions, histories and record of the passage.
// [docs/records/device.md]

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kernels/contact/contact.hpp"
#include "kernels/contact/surface_fields.hpp"
#include "kernels/device/device.hpp"
#include "kernels/device/host_array.hpp"

namespace tread {

class DeviceContact {
 public:
  /// Copies what does not change. Keeps references. `mass`: on the device, by slot of the mesh [kg].
  DeviceContact(Device& device, Contact& contact, const double* mass);

  /// When a step of dt [s] searches, and where.
  struct Instant {
    BodyFrame wheel;
    double time;  ///< [s]
    double dt;

    bool operator==(const Instant&) const = default;
  };
  /// Starts to find the candidates of a step, beside the march; fields of the device. The contact's search is
  /// aimed. What has been found ahead counts if it was for this instant.
  void search(NodeField displacement, NodeField velocity, const Instant& at);
  /// Starts to find those of the step after the one whose tractions were started last; these come first.
  void search_ahead(NodeField displacement, NodeField velocity, const Instant& at);
  /// Fields have changed: what has been found ahead does not count.
  void forget() { ahead_.reset(); }
  /// Starts to solve the tractions, if the step has searched.
  void start(NodeField displacement, NodeField velocity);
  /// Hands the outcome of what was started to the contact.
  void resolve();

  /// Hands the points of the last step to the contact.
  void fetch_points();
  /// Brings the record of the passage to the host.
  void fetch_record();
  /// Brings the histories, the law's states and the record to the host, which may change them: they go back
  /// before the next step.
  void release();

  /// Memory on the device [B].
  static std::int64_t bytes(const Contact& contact);

 private:
  struct Sizes;
  template <class T>
  T* room(std::size_t count);
  template <class T>
  const T* keep(std::span<const T> values);
  template <class T, class Allocator>
  const T* keep(const std::vector<T, Allocator>& values) {
    return keep(std::span<const T>(values.data(), values.size()));
  }
  SurfaceSide side(const SweptBlock& block, const SurfaceProfile& profile, const StationFinder& stations);
  MonotoneCubicView line(MonotoneCubicView view);
  PlacedDepth placed(PlacedDepth depth);
  RunningSurfaceView surface(RunningSurfaceView view);
  SurfaceDepths depths(SurfaceDepths depths);
  void keep_law();
  void make_room();
  void send();
  void find(NodeField displacement, NodeField velocity, const Instant& at, const ContactSearch::Aim& aim);

  Device* device_;
  Contact* contact_;
  SurfaceFields* record_ = nullptr;          ///< the run's
  std::vector<std::shared_ptr<void>> kept_;  ///< arrays that task_ and law_ point to
  ContactTask task_;
  std::array<Candidates, 2> candidates_;  ///< of the last patch, and of a search after it
  std::size_t solved_ = 0;                ///< the former of these
  FrictionLaw law_;
  void* law_state_ = nullptr;
  std::size_t law_state_bytes_ = 0;
  HostArray<PatchResult> result_;
  HostArray<ContactPoint> points_;
  bool sent_ = false;      ///< the device holds histories and record
  bool searched_ = false;  ///< the step, but it has not started on the tractions
  std::optional<Instant> ahead_;
};

}  // namespace tread
