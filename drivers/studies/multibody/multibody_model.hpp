#pragma once
// What the multi-body approach makes of a scene. [theory.md, Multi-body approach]

#include <optional>
#include <string>
#include <vector>

#include "core/corrugation.hpp"
#include "core/math/hertz.hpp"
#include "drivers/engine/station_plan.hpp"
#include "drivers/studies/multibody/modal_passage.hpp"

namespace tread {

enum class BeamTheory {
  euler,
  timoshenko,  ///< forces act at points
  spread       ///< Timoshenko's with forces on the head spread for the fastenings, as in rail_beam
};

/// For readers: "Euler".
const char* name_of(BeamTheory theory);

struct MultibodyModel {
  Scene scene;
  BeamTheory theory = BeamTheory::euler;
  BeamProperties rail;
  std::vector<BeamSupport> supports;
  BeamVehicle vehicle;      ///< the whole wheelset and M_a as one mass
  double contact_y = 0;     ///< of the touching point, from the crown's centre line [m]
  double radius_y = 0;      ///< lateral radius of the gap there [m]
  HertzPatch patch;         ///< under the static load
  Corrugation corrugation;  ///< its centre at contact_y unless the scene states one
  double speed = 0;         ///< [m/s]
  double start = 0;         ///< where the wheel stands in equilibrium at first [m]
  double end = 0;           ///< of its way [m]

  double roughness(double x) const { return corrugation.depth(x, contact_y); }  ///< [m]
  /// d F / d approach under the static load [N/m].
  double contact_stiffness() const;
};

/// A half wheelset over a rail on fastenings, over the corrugation or the solution zone whatever the scene's
/// duration. It starts in the middle of the first span unless motion.start is "rigid" (then at x = 0). Slab
/// and mortar are rigid. InputError for scenes that lack a part or whose rail is too short.
MultibodyModel multibody_model(const Scene& scene, BeamTheory theory);

/// What of vehicle, rail and fastenings differs first, "the wheel load is 87560 N here and 70000 N there";
/// empty where nothing does.
std::string track_difference(const MultibodyModel& here, const MultibodyModel& there);

/// The same of the corrugations as the scenes state them, before any filter.
std::string corrugation_difference(const MultibodyModel& here, const MultibodyModel& there);

/// The same over a corrugation of another wavelength [m]. InputError without a sine.
Corrugation with_wavelength(const MultibodyModel& model, double wavelength);

/// How much of a sine's depth the height of a wheel at rest on a half-space shows, crest against trough, at
/// the scene's depth and under the static load [-]. [Kalker, ch. 4, by kernels/half_space/half_space]
double contact_filter_gain(const MultibodyModel& model, double wavelength);

/// Makes the scene's sine as deep as the contact filter leaves it; the gain. InputError without a sine.
double apply_contact_filter(MultibodyModel& model);

/// The rail with all modes below 20 kHz, or as many as stated.
ModalTrack modal_track(const MultibodyModel& model, std::optional<int> modes);

}  // namespace tread
