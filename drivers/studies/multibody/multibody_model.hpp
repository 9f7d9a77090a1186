#pragma once
// The multi-body model of a scene. [theory.md, Multi-body approach]

#include <optional>
#include <string>
#include <vector>

#include "core/corrugation.hpp"
#include "core/math/hertz.hpp"
#include "core/running_surface.hpp"
#include "drivers/engine/model/station_plan.hpp"
#include "drivers/studies/multibody/modal_passage.hpp"

namespace tread {

enum class BeamTheory {
  euler,
  timoshenko,  ///< Timoshenko's beam; forces act at points
  spread,      ///< Timoshenko's beam; forces on the head are spread for the fastenings, as in rail_beam
  solid        ///< waves of the section by finite elements, once use_solid_rail has made them
};

/// Name for readers, such as "Euler".
const char* name_of(BeamTheory theory);

struct MultibodyModel {
  Scene scene;
  BeamTheory theory = BeamTheory::euler;
  BeamProperties rail;
  std::vector<BeamSupport> supports;       ///< columns on rigid ground; none where there are sleepers
  std::vector<SleeperSupport> sleepers;    ///< fastenings on sleepers
  std::vector<BeamSupport> foot_supports;  ///< along x; none under Euler's beam, which has no foot
  std::vector<FootStretch> foot_holds;     ///< none under Euler's beam
  BeamVehicle vehicle;                     ///< vehicle; the whole wheelset and M_a are one mass
  double contact_y = 0;                    ///< touching point, from the crown's centre line [m]
  double radius_y = 0;                     ///< lateral radius of the gap there [m]
  std::optional<ModalBeam> solid;          ///< the rail as a solid; takes the place of the beam
  ModalWheel wheel;                        ///< a mass, but for use_modal_wheel
  SineContact sine;                        ///< empty, but for use_half_space_contact
  HertzPatch patch;                        ///< patch under the static load
  Corrugation corrugation;  ///< corrugation; its centre is at contact_y unless the scene states one
  double speed = 0;         ///< [m/s]
  double start = 0;         ///< place at which the wheel stands in equilibrium at first [m]
  double end = 0;           ///< end of the passage [m]

  RunningSurface rail_surface, wheel_surface;  ///< depths besides the corrugation

  /// Depth that the wheel follows at x [m]: the corrugation's, and of the other depths the highest places
  /// that a round wheel rolls on.
  double roughness(double x) const;
  /// Depth of the surfaces besides the corrugation that the wheel follows at x, at y across [m].
  double surface_depth(double x, double y) const;
  /// Relief of a sine at x; none without use_half_space_contact.
  ContactRelief relief(double x) const;
  /// The wheel as it spins at a speed [m/s].
  ModalWheel wheel_at(double at_speed) const;
  /// Returns true if use_half_space_contact has not pressed the wheel with as large a force [N].
  bool beyond_half_spaces(double force) const { return !sine.empty() && force > sine.most(); }
  /// Contact stiffness d F / d approach under the static load [N/m].
  double contact_stiffness() const;
};

/// Model of a half wheelset over a rail on fastenings, over the corrugation or the solution zone, whatever
/// the scene's duration. The wheel starts in the middle of the first span that is at least 0.3 m from the
/// rail's end, or, where motion.start is "rigid", at Scene::start_x(). Slab and mortar are rigid; sleepers
/// are rigid bodies on their beds. Throws InputError for scenes that lack a part, whose rail is too short, or
/// whose corrugation or evaluated stretch begins before the wheel's start.
MultibodyModel multibody_model(const Scene& scene, BeamTheory theory);

/// Corrugation as the model's scene states it, before any filter.
Corrugation stated_corrugation(const MultibodyModel& model);

/// The model's corrugation with another wavelength [m]. Throws InputError without a sine.
Corrugation with_wavelength(const MultibodyModel& model, double wavelength);

/// The scene's sine as the wheel meets it.
SineUnderWheel sine_under_wheel(const MultibodyModel& model);

/// Gain of the contact filter [-]: height of a wheel at rest on a crest above one in a trough, over the
/// sine's depth at the contact; 1 where the sine lies beside the contact. The wheel rests on a half-space at
/// the scene's depth and under the static load. [Kalker, ch. 4, by kernels/half_space/half_space]
double contact_filter_gain(const MultibodyModel& model, double wavelength);

/// Throws InputError, which begins with `reason`, unless the corrugation is a sine.
void require_sine(const MultibodyModel& model, const std::string& reason);

/// Makes the scene's sine as deep as the contact filter leaves it and returns the gain [-]. Throws InputError
/// without a sine.
double apply_contact_filter(MultibodyModel& model);

/// The rail with all modes below 20 kHz, of a rail whose foot is held along x below 30 kHz, or as many of the
/// lower branch as stated; a solid rail as it is. Springs of the flexibility that the modes lack stand in for
/// a held foot. [theory.md, eq. M5]
ModalTrack modal_track(const MultibodyModel& model, std::optional<int> modes);

/// Frequency up to which both rail and wheel have modes, but for a wheel that is a mass.
struct TopOfModes {
  double frequency = 0;                                   ///< [Hz]
  std::string part;                                       ///< the part that has no higher ones, for readers
  std::string way_out = "longer waves or a lower speed";  ///< to state
};

/// Top of the modes of modal_track() and the wheel.
TopOfModes top_of_modes(const MultibodyModel& model, std::optional<int> modes);

}  // namespace tread
