#include "drivers/studies/multibody/multibody_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/model/lateral_gap.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/model/surfaces.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

namespace {

constexpr double kTopFrequency = 20e3;        ///< highest frequency of the modes [Hz]
constexpr double kTopFrequencyOfFoot = 30e3;  ///< the same where the foot is held along x [Hz]
constexpr double kTopOfTrack = 6e3;           ///< highest frequency of a solid rail on its supports [Hz]
constexpr double kBeyond = 0.1;               ///< length of the passage beyond the evaluated stretch [m]
constexpr double kEndOfRail = 0.3;            ///< least distance of the wheel from the rail's ends [m]

void require_parts(const Scene& scene) {
  const auto need = [](bool there, const char* what) {
    if (!there)
      throw InputError(fmt::format(
          "tread multibody: the scene has no {}; it needs a half wheelset under [vehicle] or [load], a rail "
          "on fastenings, and [motion] with a speed",
          what));
  };
  if (!scene.bodies.empty())
    throw InputError(
        fmt::format("tread multibody: body.{} has no section, from which masses and modes are made; state "
                    "body.{}.present = false",
                    scene.bodies.begin()->first, scene.bodies.begin()->first));
  need(scene.wheel && scene.wheel->shape == "half_wheelset", "half wheelset ([wheel])");
  need(scene.rail && scene.fastenings, "rail on fastenings ([rail], [fastenings])");
  need(scene.contact.has_value(), "[contact]");
  need(scene.motion && scene.motion->speed > 0, "speed ([motion])");
}

BeamVehicle lumped_vehicle(const Scene& scene) {
  BeamVehicle vehicle;
  vehicle.gravity = scene.gravity;
  vehicle.unsprung_mass = scene.wheel->mass;
  if (scene.vehicle) {
    vehicle.unsprung_mass += scene.vehicle->unsprung_mass;
    vehicle.sprung_mass = scene.vehicle->sprung_mass;
    vehicle.stiffness = scene.vehicle->suspension_stiffness;
    vehicle.damping = scene.vehicle->suspension_damping;
  }
  if (scene.load) vehicle.pressed = scene.load->wheel_load;
  return vehicle;
}

/// Place at which the wheel stands at first [m]: the scene's, or the middle of the first span that is far
/// enough from the rail's left end.
double first_place(const Scene& scene) {
  if (scene.start() == "rigid") return scene.start_x();
  const double left = -scene.rail->origin;
  double middle = left + scene.fastenings->first + 0.5 * scene.fastenings->spacing;
  while (middle < left + kEndOfRail) middle += scene.fastenings->spacing;
  return middle;
}

}  // namespace

const char* name_of(BeamTheory theory) {
  switch (theory) {
    case BeamTheory::euler:
      return "Euler";
    case BeamTheory::timoshenko:
      return "Timoshenko";
    case BeamTheory::solid:
      return "Solid";
    default:
      return "Timoshenko (spread)";
  }
}

double MultibodyModel::surface_depth(double x, double y) const {
  if (rail_surface.smooth() && wheel_surface.smooth()) return 0;
  return traced_depth(rail_surface, wheel_surface, 0.5 * scene.wheel->diameter, x, y);
}

double MultibodyModel::roughness(double x) const {
  return corrugation.depth(x, contact_y) + surface_depth(x, contact_y);
}

ContactRelief MultibodyModel::relief(double x) const {
  const double first = corrugation.first();
  const double last = corrugation.last();
  if (sine.empty() || x <= first || x >= last) return {};
  // Within a quarter of a wave from either end the patch also stands on the smooth rail.
  const double wavelength = scene.corrugation->wavelength;
  const double share = std::min(1.0, 4 * std::min(x - first, last - x) / wavelength);
  return sine.at(2 * std::numbers::pi * (x - first) / wavelength, share);
}

ModalWheel MultibodyModel::wheel_at(double at_speed) const {
  ModalWheel at = wheel;
  at.spin = at_speed / (0.5 * scene.wheel->diameter);
  return at;
}

double MultibodyModel::contact_stiffness() const {
  return 1.5 * vehicle.contact * std::cbrt(vehicle.load() / vehicle.contact);
}

Corrugation stated_corrugation(const MultibodyModel& model) {
  const auto& spec = model.scene.corrugation;
  return spec ? corrugation_of(*spec, spec->centre.value_or(model.contact_y)) : Corrugation{};
}

MultibodyModel multibody_model(const Scene& scene, BeamTheory theory) {
  require_parts(scene);
  MultibodyModel model;
  model.scene = scene;
  model.theory = theory;
  const BeamSection section = rail_beam_section(scene);
  const Material& material = scene.rail_material();
  model.rail = theory == BeamTheory::euler ? euler(section, material) : timoshenko(section, material);
  if (theory == BeamTheory::timoshenko || theory == BeamTheory::solid) model.rail.depth = 0;
  model.sleepers = rail_sleepers(scene);
  if (model.sleepers.empty()) model.supports = rail_supports(scene);
  if (model.rail.has_foot()) {
    model.foot_supports = rail_foot_supports(scene);
    model.foot_holds = rail_foot_holds(scene);
  }
  model.vehicle = lumped_vehicle(scene);

  const MeshSizes sizes = mesh_sizes(scene);
  const double radius = 0.5 * scene.wheel->diameter;
  const Section rail =
      scene.rail->profile == "box" ? box_rail_section(scene, sizes) : rail_sections(scene, sizes).cap;
  const Section tread = wheel_sections(scene, sizes, plan_wheel(radius, {}, sizes)).sections.tread;
  const LateralGap gap = lateral_gap(SurfaceProfile(rail), SurfaceProfile(tread));
  model.contact_y = gap.lowest;
  model.radius_y = gap.radius;
  model.patch = hertz(radius, gap.radius, scene.elastic_pair().contact_modulus(), model.vehicle.load());
  model.vehicle.contact = model.vehicle.load() / std::pow(model.patch.approach, 1.5);

  model.corrugation = stated_corrugation(model);
  model.rail_surface = rail_surface(scene);
  model.wheel_surface = wheel_surface(scene);
  model.speed = scene.motion->speed;
  model.start = first_place(scene);
  model.end = std::max(evaluated_stretch(scene, model.corrugation).last, model.corrugation.last()) + kBeyond;
  const double left = -scene.rail->origin;
  const double last = left + scene.rail->length - kEndOfRail;
  if (model.start < left + kEndOfRail || model.end > last || model.start >= model.end)
    throw InputError(
        fmt::format("tread multibody: the wheel would roll from x = {:.3f} to {:.3f} m, the rail lets it go "
                    "from {:.3f} to "
                    "{:.3f} m; state a longer rail.length or another rail.origin",
                    model.start, model.end, left + kEndOfRail, last));
  const double first = model.corrugation.smooth() ? evaluated_stretch(scene, model.corrugation).first
                                                  : model.corrugation.first();
  if (model.start > first)
    throw InputError(
        fmt::format("tread multibody: the wheel would start at x = {:.3f} m, but the corrugation or the "
                    "stretch that is evaluated begins at x = {:.3f} m; state {}, or a later "
                    "corrugation.start and solution_zone.start",
                    model.start, first,
                    scene.start() == "rigid" ? "a longer motion.run_up"
                                             : "a larger rail.origin with a longer rail.length"));
  return model;
}

Corrugation with_wavelength(const MultibodyModel& model, double wavelength) {
  if (!model.scene.corrugation || model.scene.corrugation->kind != "sine")
    throw InputError("tread multibody: the wavelength can only be changed where [corrugation] is a sine");
  CorrugationSpec spec = *model.scene.corrugation;
  spec.wavelength = wavelength;
  return corrugation_of(spec, spec.centre.value_or(model.contact_y));
}

SineUnderWheel sine_under_wheel(const MultibodyModel& model) {
  const CorrugationSpec& spec = *model.scene.corrugation;
  const double radius = 0.5 * model.scene.wheel->diameter;
  const double centre = model.corrugation.centre() - model.contact_y;
  return {radius, model.radius_y, spec.depth, spec.wavelength, spec.width, centre};
}

double contact_filter_gain(const MultibodyModel& model, double wavelength) {
  SineUnderWheel sine = sine_under_wheel(model);
  sine.wavelength = wavelength;
  const double depth = sine.depth_at(0, 0, std::numbers::pi);
  if (depth <= 0) return 1;
  const half_space::Influence influence(sine.grid(model.patch), model.scene.elastic_pair().alike());
  const auto approach = [&](double phase) {
    return half_space::press(influence, sine.gap(phase), model.vehicle.load()).approach;
  };
  return (approach(std::numbers::pi) - approach(0)) / depth;
}

void require_sine(const MultibodyModel& model, const std::string& reason) {
  const std::optional<CorrugationSpec>& corrugation = model.scene.corrugation;
  if (corrugation && corrugation->kind == "sine") return;
  throw InputError(fmt::format("{}, and {}; state corrugation.kind = \"sine\", or leave the option out",
                               reason,
                               corrugation ? fmt::format("corrugation.kind is \"{}\"", corrugation->kind)
                                           : "there is no [corrugation]"));
}

double apply_contact_filter(MultibodyModel& model) {
  require_sine(model, "tread multibody --filter: the gain is that of a sine");
  CorrugationSpec spec = *model.scene.corrugation;
  const double gain = contact_filter_gain(model, spec.wavelength);
  spec.depth *= gain;
  model.corrugation = corrugation_of(spec, spec.centre.value_or(model.contact_y));
  return gain;
}

namespace {

/// Motion of the foot beyond its plane section's by a force per length along it [m2/N].
double whole_foot_compliance(const BeamProperties& beam) {
  return beam.foot_compliance + beam.foot_warping * beam.foot_warping / beam.shear_stiffness;
}

/// The hold of a foot along x over a stretch.
struct FootHolding {
  double length = 0;      ///< [m]
  double pitch = 0;       ///< of the places that stand for it, at the most [m]
  double compliance = 0;  ///< that the modes have not [m2/N]
};

FootHolding foot_holding(const MultibodyModel& model) {
  constexpr double kPitch = 0.02;  // a beam's foot gives way over 31 mm at the ends of a pad [m]
  const FootStretch& one = model.foot_holds.front();  // all are of the same length
  if (model.solid) return {one.last - one.first, kFootPitch, 0};
  return {one.last - one.first, kPitch, whole_foot_compliance(model.rail)};
}

/// Stands in for a stretch from x = 0 on where the rail's foot is held along x: the inverse of the
/// flexibility that the modes lack at places along it, as springs of 1 N/m on weighted sums of the motions
/// there. [theory.md, eq. M5]
std::vector<FootSpring> springs_of_held_foot(const ModalBeam& beam, const FootHolding& held) {
  const auto parts = static_cast<std::size_t>(std::ceil(held.length / held.pitch));
  const double pitch = parts > 0 ? held.length / static_cast<double>(parts) : 0;
  // Row i of the inverse of the Cholesky factor L of the flexibility is spring i.
  std::vector<std::vector<double>> factor(parts + 1, std::vector<double>(parts + 1));
  std::vector<std::vector<double>> inverse = factor;
  for (std::size_t i = 0; i <= parts; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = beam.foot_residual_flexibility(static_cast<double>(i - j) * pitch);
      if (i == j && parts > 0) rest += held.compliance / (i == 0 || i == parts ? 0.5 * pitch : pitch);
      for (std::size_t k = 0; k < j; ++k) rest -= factor[i][k] * factor[j][k];
      factor[i][j] = i == j ? std::sqrt(rest) : rest / factor[j][j];
    }
  std::vector<FootSpring> springs(parts + 1);
  for (std::size_t i = 0; i <= parts; ++i) {
    springs[i].stiffness = 1;
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = i == j ? 1 : 0;
      for (std::size_t k = j; k < i; ++k) sum -= factor[i][k] * inverse[k][j];
      inverse[i][j] = sum / factor[i][i];
      springs[i].places.push_back({static_cast<double>(j) * pitch, inverse[i][j]});
    }
  }
  return springs;
}

bool foot_is_bound(const MultibodyModel& model) {
  return !model.foot_supports.empty() || !model.foot_holds.empty();
}

/// Frequency below which a beam has modes unless their number is stated [Hz].
double top_of_beam(const MultibodyModel& model) {
  return foot_is_bound(model) ? kTopFrequencyOfFoot : kTopFrequency;
}

}  // namespace

TopOfModes top_of_modes(const MultibodyModel& model, std::optional<int> modes) {
  TopOfModes top{top_of_beam(model), "the beam"};
  if (model.solid)
    top = {kTopOfTrack, "--beam solid"};
  else if (modes)
    top = {wave_frequency(model.rail, (*modes - 1) * std::numbers::pi / model.scene.rail->length),
           fmt::format("--modes {}", *modes), "more modes, or none"};
  if (!model.wheel.modes.empty() && model.wheel.top < top.frequency) top = {model.wheel.top, "--wheel modal"};
  return top;
}

ModalTrack modal_track(const MultibodyModel& model, std::optional<int> modes) {
  const bool foot = foot_is_bound(model);
  const double length = model.scene.rail->length;
  const int count = modes.value_or(modes_below(model.rail, length, top_of_beam(model)));
  ModalBeam beam = model.solid ? *model.solid
                               : ModalBeam(model.rail, -model.scene.rail->origin, length, count,
                                           head_spread(model.scene, model.rail),
                                           foot ? ModalBeam::Foot::moves : ModalBeam::Foot::still);
  std::vector<FootSpring> along;
  if (!model.foot_supports.empty()) {
    const double missing = beam.foot_residual_flexibility(0);
    for (const BeamSupport& s : model.foot_supports)
      along.push_back({{{s.x, 1}}, 1 / (1 / s.stiffness + missing), s.damping});
  }
  if (!model.foot_holds.empty()) {
    const std::vector<FootSpring> springs = springs_of_held_foot(beam, foot_holding(model));
    for (const FootStretch& s : model.foot_holds)
      for (FootSpring spring : springs) {
        for (FootSpring::Place& place : spring.places) place.x += s.first;
        along.push_back(std::move(spring));
      }
  }
  ModalTrack track(std::move(beam), model.supports, along, model.sleepers);
  return model.solid ? track.diagonal(kTopOfTrack) : track;
}

}  // namespace tread
