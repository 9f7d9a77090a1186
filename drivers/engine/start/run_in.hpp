#pragma once
// Start of rolling as after a long way: the state of rail and vehicle comes from a beam on the scene's
// fastenings over which the vehicle has run. [theory.md, Start]

#include <memory>
#include <span>
#include <vector>

#include "core/state_list.hpp"
#include "drivers/engine/beam/beam_passage.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

/// Bending of the wheelset under the load on its journal.
struct AxleBending {
  double journal = 0;  ///< deflection of the journal beyond the rim's, downwards [m]
  double wheelset_share =
      0;  ///< wheelset's mass times its deflection beyond the rim's over the journal's [kg]
  BeamVehicle::Bending bending;

  bool rigid() const { return bending.stiffness == 0; }
};

/// From the static displacement; of a wheel that hardly bends: rigid.
AxleBending axle_bending(const Model& model, ConstNodeField displacement, const BodyFrame& wheel);

/// Mean displacement of the rim, Cartesian [m].
Vec3 rim_displacement(const Model& model, ConstNodeField displacement, const BodyFrame& wheel);

/// The model's wheelset with M_a, its vehicle or load, the Hertz spring of its undeformed surfaces.
BeamVehicle beam_vehicle(const Model& model, const AxleBending& axle);

/// A wheel at the start on a scene's rail that has rolled over its fastenings, continued to the left, until
/// the force over the last span changes by less than a thousandth of the load from the span before, or by a
/// way of twice the length; its sprung mass where the suspension bears it in the mean.
struct RunningWheel {
  std::unique_ptr<TrackBeam> beam;  ///< that the passage refers to
  BeamPassage passage;
  double bending_at_rest = 0;  ///< [m]
  double change = 0;           ///< of the force over the last span, as above, over the load [-]
};
RunningWheel running_wheel(const Scene& scene, const BeamVehicle& vehicle);

/// The state at the start less the static one under the same contact force; deflections and speeds downwards.
struct RunIn {
  double change = 0;         ///< of the running wheel; a Preload keeps it [-]
  double force = 0;          ///< F_N [N]
  double wheel_speed = 0;    ///< of the rim [m/s]
  double bending_speed = 0;  ///< of the journal beyond the rim's over its static deflection [1/s]
  /// Forces on the wheelset besides those of statics, downwards: at the journal, and on its mass.
  double journal_force = 0;  ///< [N]
  double inertia_force = 0;  ///< [N]
  double stretch = 0;        ///< of the sprung mass towards the journal, more than under its weight [m]
  double sprung_speed = 0;   ///< [m/s]

  /// Motion of a section of the beam beyond the static state; rates as seen from the wheel.
  struct Section {
    SectionMotion displacement, rate;
  };
  Section at(double x) const;

  double left = 0, pitch = 0;     ///< of the sections [m]
  std::vector<Section> sections;  ///< at least two

  /// A sleeper's deflection beyond the static state, and its speed, downwards.
  struct Sleeper {
    double deflection = 0;  ///< [m]
    double speed = 0;       ///< [m/s]
  };
  std::vector<Sleeper> sleepers;  ///< along x; empty: the track has none

  void list_state(StateList& list) {
    list.add("force", force);
    list.add("wheel_speed", wheel_speed);
    list.add("bending_speed", bending_speed);
    list.add("journal_force", journal_force);
    list.add("inertia_force", inertia_force);
    list.add("stretch", stretch);
    list.add("sprung_speed", sprung_speed);
    list.add("left", left);
    list.add("pitch", pitch);
    list.add_records("sections", std::span(sections));
    list.add_records("sleepers", std::span(sleepers));
  }
};

/// From the running wheel.
RunIn run_in(const Model& model, const AxleBending& axle);

}  // namespace tread
