#pragma once
// Values that a scene asks for at every sample: probes, forces of the fastenings, stress under the patch.

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/channel.hpp"
#include "drivers/engine/features/feature.hpp"
#include "drivers/engine/model/body_point.hpp"
#include "drivers/engine/model/model.hpp"
#include "kernels/contact/contact_surface.hpp"

namespace tread {

/// A measured column of the histories.
struct MeasuredChannel {
  Channel channel;
  /// The column whose mean rate over the interval between two samples this one is; absent: a value of its
  /// own.
  std::optional<std::size_t> rate_of = {};
  double at = 0;  ///< x of a fastening, depth of a quad under the patch [m]
};

/// Returns true for the names of the columns that the probe of that name has.
bool is_column_of(const std::string& probe, const std::string& column);

/// Observes; changes nothing of the motion and has no state that outlives a step.
class Measurements final : public Feature {
 public:
  /// Keeps a reference. `patch_y`: centre of the preload's patch [m]. InputError where a probe lies outside
  /// its body.
  Measurements(const Model& model, double patch_y);

  /// Columns in the order of values(); empty where the scene asks for nothing.
  const std::vector<MeasuredChannel>& channels() const { return channels_; }
  /// Values of the last sample. Those of rates are zero.
  std::span<const double> values() const { return values_; }

  const char* name() const override { return "measurements"; }
  std::vector<PhaseInfo> phases() const override;
  std::vector<FieldBytes> fields() const override;
  void apply(StepPhase phase, StepState& step) override;
  void watch(const StepState& step, WatchedNodes& nodes) const override;

 private:
  struct Probe {
    ProbeSpec spec;
    std::optional<BodyPoint> point;  ///< absent: the axle box
  };
  struct Depth {
    QuadBelow below;
    StationFinder finder;  ///< of its block
  };
  void add_probe(const std::string& name, const ProbeSpec& spec);
  void add_fastenings();
  void add_depths(double patch_y, double deepest);
  void add_column(const std::string& name, const std::string& unit, const std::string& description);

  std::array<double, 6> stress_of(int block, int quad, int station, const StepState& step) const;
  Vec3 axle_box(const StepState& step) const;
  void measure_probe(const Probe& probe, const StepState& step);
  void measure_fastenings(const StepState& step);
  void measure_depth(const Depth& depth, const StepState& step);
  /// Calls visit(station) for the elements of a depth about the patch.
  template <class Visit>
  void for_each_station(const Depth& depth, double wheel_x, const Visit& visit) const;

  const Model* model_;
  std::vector<Probe> probes_;
  bool fastenings_ = false;
  std::vector<Depth> depths_;
  std::vector<MeasuredChannel> channels_;
  std::vector<double> values_;
};

}  // namespace tread
