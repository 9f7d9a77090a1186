#include "drivers/results/resolution.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "core/geometry/point_scatter.hpp"
#include "core/geometry/profiles.hpp"
#include "core/mesh/structured.hpp"
#include "drivers/engine/model/body_point.hpp"
#include "drivers/engine/model/lateral_gap.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "drivers/results/depth_warnings.hpp"
#include "drivers/results/way_warnings.hpp"
#include "io/scene/resolving_size.hpp"

namespace tread {

namespace {

/// Elements across the patch below which nodal pressures are more than about 10 % low. [contact-choices.md]
constexpr double kElementsOfPatch = 4;
/// Samples of a blow below which the receptance of its histories is off.
constexpr double kSamplesOfBlow = 8;
/// Elements that a wave passes during a blow, in about as many steps, below which the blow is not resolved.
constexpr double kElementsOfBlow = 10;

/// Length of the shorter axis of the patch; of a slice in plane strain, its length along the rail [m].
double shorter_axis(const Model& model) {
  if (model.line_width > 0 && model.wheel_load() > 0) {
    const double along = 2 * model.line_semi_axis();
    return model.scene.plane_strain ? along : std::min(along, model.line_width);
  }
  return 2 * std::min(model.hertz_patch.semi_axis_x, model.hertz_patch.semi_axis_y);
}

/// Part of patch_warning() on the lengths along which elements pass: those of all speeds.
std::string ripple_text(const Model& model, double across) {
  if (stands(model.scene)) return "";
  const double pitch = 1e3 * model.sizes.contact;
  return fmt::format("; below {:g}, F_N ripples as elements pass, every {}{:.3g} mm beside the solution zone",
                     kElementsOfForce,
                     across < kElementsOfForce ? fmt::format("{:.3g} mm and every ", pitch) : "",
                     pitch * model.sizes.approach_ratio);
}

std::string patch_warning(const Model& model) {
  const std::optional<double> across = too_few_elements_across_patch(model);
  if (!across) return "";
  const double shorter = shorter_axis(model);
  return fmt::format(
      "the contact patch has {:.1f} elements across ({:.3g} mm of Hertz on elements of {:.3g} mm): "
      "below {:g}, pressures and stresses are too low and slip, shear and creepage are not resolved{}; {}",
      *across, 1e3 * shorter, 1e3 * model.sizes.contact, kElementsOfPatch, ripple_text(model, *across),
      resolving_size(shorter / kElementsOfPatch, "it"));
}

/// Sentence where profiles touch at an edge of one of them. A line contact reaches to the edges anyway.
std::string edge_warning(const Model& model) {
  if (model.line_width > 0) return "";
  const SurfaceProfile& rail = model.contact->surfaces().rail_profile();
  const SurfaceProfile& wheel = model.contact->surfaces().wheel_profile();
  const double first = std::max(rail.first_p(), wheel.first_p());
  const double last = std::min(rail.last_p(), wheel.last_p());
  const double lowest = lateral_gap(rail, wheel).lowest;
  const double half = model.hertz_patch.semi_axis_y;
  if (lowest - first >= half && last - lowest >= half) return "";
  const char* way_out = last - first >= 2 * half ? "change wheel.lateral_offset"
                                                 : "state wider bodies, or a smaller radius across the rail";
  return fmt::format(
      "wheel and rail touch first at y = {:.3g} mm, and face one another from y = {:.3g} to {:.3g} mm alone: "
      "an edge cuts the patch of {:.3g} mm off and carries its pressures; {}",
      1e3 * lowest, 1e3 * first, 1e3 * last, 2e3 * half, way_out);
}

/// Mean section of a rail's body [m2].
double section_of(const HexBody& body) {
  double volume = 0, first = 1e30, last = -1e30;
  for (std::size_t e = 0; e < body.mesh.elements.size(); ++e)
    volume += hex_shape(body.mesh.corners(e)).volume;
  for (const Vec3& at : body.mesh.nodes) {
    first = std::min(first, at.x);
    last = std::max(last, at.x);
  }
  return volume / (last - first);
}

/// Part of the rail that differs from the beams that stand for it, or "".
std::string other_than_beam(const Model& model) {
  constexpr double kAlikeSection = 0.03;
  const Scene& scene = model.scene;
  if (!is_of_the_beam(scene, scene.head_material())) return "a head of another Young's modulus or density";
  if (model.index.base_body < 0) return "";
  const HexBody& body = model.mesh.bodies[static_cast<std::size_t>(model.index.base_body)];
  if (!is_of_the_beam(scene, body.materials.front()))
    return fmt::format("body.{} of another Young's modulus or density", body.name);
  const double section = section_of(body);
  const double of_profile = area_moments(rail_sections(scene, model.sizes).base).area;
  if (std::abs(section - of_profile) <= kAlikeSection * of_profile) return "";
  return fmt::format("body.{} of {:.4g} cm2, where the profile has {:.4g} cm2 below its head,", body.name,
                     1e4 * section, 1e4 * of_profile);
}

/// Sentence where the rail is of another stiffness, density or section than the beams that stand for it.
std::string beam_warning(const Model& model) {
  const std::string other = model.scene.start() == "rolling" ? other_than_beam(model) : "";
  if (other.empty()) return "";
  return fmt::format(
      "the start of a rolling wheel takes a rail of rail.profile and rail.material alone: {} makes F_N "
      "swing at first; let the wheel roll further before the corrugation",
      other);
}

/// Sentence where a profile's points scatter. `table`: "wheel" or "rail".
std::string profile_warning(const char* table, const std::vector<double>& y, const std::vector<double>& z) {
  const double scatter = point_scatter(y, z).value_or(0);
  if (scatter < kRoughProfile) return "";
  return fmt::format(
      "the points of {}.profile scatter by {:.2g} um about a smooth line, and pressures with them; "
      "{}.profile_smoothing = \"{:.2g} mm\" smooths it",
      table, 1e6 * scatter, table, 1e3 * smoothing_of(scatter));
}

/// Sentence where a head from a file leans already, or to the field side.
std::string lean_warning(const RailSpec& rail) {
  if (rail.profile_y.empty()) return "";
  const double lean = head_lean(curve_through(rail.profile_y, rail.profile_z, "rail.profile"), 0);
  if (lean == 0 || (lean > 0 && rail.inclination == 0)) return "";
  return "rail.profile: " + lean_hint(lean);
}

/// Sentence where the histories have hardly a sample.
std::string history_warning(const Scene& scene) {
  constexpr double kFewest = 10;
  if (!scene.motion || scene.motion->duration >= kFewest * scene.output.history_interval) return "";
  return fmt::format(
      "output.history_interval = {:.4g} ms gives fewer than {:g} samples of a run of {:.4g} ms: state a "
      "shorter one",
      1e3 * scene.output.history_interval, kFewest, 1e3 * scene.motion->duration);
}

/// Sentence where run, mesh or samples are too short or too coarse for the blow.
std::string hammer_warning(const Model& model) {
  const Scene& scene = model.scene;
  if (!scene.hammer || !scene.motion) return "";
  const double blow = scene.hammer->duration, interval = scene.output.history_interval;
  if (blow > scene.motion->duration)
    return fmt::format(
        "the blow of hammer.duration = {:.4g} ms is cut off at the run's end, {:.4g} ms; state a longer "
        "motion.duration",
        1e3 * blow, 1e3 * scene.motion->duration);
  const double least = kElementsOfBlow * model.sizes.contact / scene.head_material().pressure_wave_speed();
  if (blow < least)
    return fmt::format(
        "hammer.duration = {:.4g} ms is a blow of {:.2g} steps or so: below {:g}, neither steps nor elements "
        "resolve it; state at least {:.3g} ms, or a smaller scene.element_size",
        1e3 * blow, kElementsOfBlow * blow / least, kElementsOfBlow, 1.01e3 * least);
  if (blow >= kSamplesOfBlow * interval) return "";
  return fmt::format(
      "hammer.duration = {:.4g} ms is a blow of {:.2g} samples: below {:g}, the receptance is off; state "
      "output.history_interval = \"{:.3g} ms\"",
      1e3 * blow, blow / interval, kSamplesOfBlow, 1e3 * blow / (kSamplesOfBlow + 1));
}

/// Sentence where the wheel rolls during the blow.
std::string blow_and_passage_warning(const Model& model) {
  if (!model.scene.hammer || !model.contact || stands(model.scene)) return "";
  return "[hammer]: hammer_displacement holds the wheel's passage beside the blow, so that the report shows "
         "no receptance; subtract that of a second run with hammer.force = \"0 kN\"";
}

/// Sentence where the histories of stress have no column: no element's middle lies as high.
std::string stress_depth_warning(const Model& model) {
  const std::optional<double>& deepest = model.scene.output.stress_depth;
  if (!deepest) return "";
  const SurfacePair& surfaces = model.contact->surfaces();
  const double y = lateral_gap(surfaces.rail_profile(), surfaces.wheel_profile()).lowest;
  constexpr double kAnyDepth = std::numeric_limits<double>::infinity();
  const std::vector<QuadBelow> quads = quads_below(model.mesh, model.index.rail(), {y, kAnyDepth});
  if (quads.empty() || quads.front().depth <= *deepest) return "";
  return fmt::format(
      "output.stress_depth = {:.4g} mm adds no stress to the histories: the middle of the first element lies "
      "deeper; state at least {:g} mm, or a smaller scene.element_size",
      1e3 * *deepest, std::ceil(1e5 * quads.front().depth) / 100);
}

/// Sentence where a Maxwell branch stiffens a body at the frequency with which its points pass the patch.
std::string branch_warning(const Model& model, const Material& material) {
  constexpr double kStiffer = 0.1;
  const std::optional<MaxwellBranch> branch = material.branch();
  if (!branch || !model.scene.motion) return "";
  const bool line = model.line_width > 0 && model.wheel_load() > 0;
  const double half = line ? model.line_semi_axis() : model.hertz_patch.semi_axis_x;
  const double frequency = model.scene.motion->speed / (2 * half);
  const double w = 2 * std::numbers::pi * frequency;
  const double square = std::pow(w * branch->time, 2);
  const double rise = branch->strength * square / (1 + square);
  if (rise <= kStiffer) return "";
  const double enough = material.rayleigh_beta * w * w / (6 * std::numbers::pi * kStiffer);
  return fmt::format(
      "material.{0}.damping makes the contact too stiff: its branch raises the modulus by {1:.2g} % at "
      "{2:.3g} kHz, the speed over the length of the patch, above {3:g} %; state "
      "material.{0}.damping_up_to = \"{4:.3g} kHz\" or a smaller value of the damping",
      material.name, 100 * rise, 1e-3 * frequency, 100 * kStiffer, 1.01e-3 * enough);
}

/// Sentence where a material yields under the wheel. [docs/records/verification.md]
std::string plastic_warning(const Model& model, const Material& material) {
  constexpr double kFirstYield = 1.6;  ///< p_0 over the yield stress [theory.md, Plasticity]
  constexpr double kBeyondRails = 6;   ///< p_0 over the yield stress that no wheel or rail bears
  if (material.law != "j2" || model.wheel_load() <= 0) return "";
  const double pressure = model.hertz_pressure();
  const double ratio = pressure / material.yield_stress;
  if (ratio <= kFirstYield) return "";
  return fmt::format(
      "p_0 = {:.4g} MPa of Hertz is {:.3g} times material.{}.yield_stress = {:.4g} MPa: above {}",
      1e-6 * pressure, ratio, material.name, 1e-6 * material.yield_stress,
      ratio > kBeyondRails
          ? fmt::format("{:g} no wheel or rail bears it; look at the unit of yield_stress", kBeyondRails)
          : fmt::format(
                "{:g} the material yields, and plastic work needs a finer mesh than forces (on 2.2 mm a "
                "quarter was missing); a second run with a smaller scene.element_size shows its error",
                kFirstYield));
}

/// Sentence where the mesh does not resolve the waves of slip that decay under falling friction, so that the
/// mesh decides how F_L swings. [contact-choices.md, eq. 10e]
std::string memory_warning(const Model& model) {
  constexpr double kElementsOfSlip = 4;
  const ContactSpec& contact = *model.scene.contact;
  if (contact.friction_law != "falling" || model.wheel_load() <= 0) return "";
  const double shear = model.scene.elastic_pair().alike().shear_modulus();                // [Pa]
  const double radiation = 0.5 * std::sqrt(shear * model.scene.head_material().density);  // G / 2c [Pa s/m]
  // V p |df/dv| is largest at the slip speed v_c.
  const double fall = (contact.friction - contact.friction_fast) / std::numbers::e * model.hertz_pressure();
  const double number = 2 / shear * (fall - radiation * contact.friction_speed);  // L times wavenumber [-]
  const double least = kElementsOfSlip * model.sizes.contact * number / (2 * std::numbers::pi);
  if (contact.friction_memory >= least) return "";
  const double elements = kElementsOfSlip * contact.friction_memory / least;  // in the shortest that grows
  return fmt::format(
      "contact.friction_memory = {:.3g} um lets waves of slip grow down to {:.2g} mm, {:.2g} elements: below "
      "{:g}, the mesh decides how F_L swings; state at least \"{:.2g} um\", or a smaller scene.element_size",
      1e6 * contact.friction_memory, 1e3 * elements * model.sizes.contact, elements, kElementsOfSlip,
      1.05e6 * least);
}

/// Compliances of a slab on its mortar at a point [m/N].
struct SlabCompliance {
  double sheared;  ///< of nodes that move vertically
  double bent;     ///< of a Timoshenko beam
};

/// Both on a Winkler layer, without ends.
SlabCompliance slab_compliance(const Material& concrete, const Material& mortar, const SlabSpec& slab) {
  const double bed =
      (mortar.lame_lambda() + 2 * mortar.shear_modulus()) * slab.width / slab.mortar_thickness;    // [N/m2]
  const double shear = concrete.shear_modulus() * slab.width * slab.thickness;                     // G A [N]
  const double bending = concrete.youngs_modulus * slab.width * std::pow(slab.thickness, 3) / 12;  // [N m2]
  const double root = std::sqrt(bed / shear + 2 * std::sqrt(bed / bending));                       // [1/m]
  return {0.5 / std::sqrt(bed * shear), 0.5 / root * (1 / std::sqrt(bed * bending) + 1 / shear)};
}

/// Sentence where the slab lies so softly that bending, which it lacks, would show under the fastenings.
std::string slab_warning(const Scene& scene) {
  constexpr double kTellingShare = 0.01;  // of a fastening's compliance
  if (!scene.slab_track || !scene.fastenings) return "";
  const SlabSpec& slab = *scene.slab_track;
  const Material& mortar = scene.material(slab.mortar_material);
  const SlabCompliance compliance = slab_compliance(scene.material(slab.material), mortar, slab);
  const double fastening = 1 / scene.fastenings->stiffness;
  const double missing = (compliance.bent - compliance.sheared) / fastening;
  if (missing <= kTellingShare) return "";
  return fmt::format(
      "[slab] is too stiff on its layer of material.{}.youngs_modulus = {:.4g} MPa: its nodes move "
      "vertically, so that it shears and does not bend; it gives way by {:.2g} m/N under a fastening, a slab "
      "that bends by {:.2g} m/N, and the difference is {:.2g} % of a fastening's {:.2g} m/N, above {:g} %; "
      "state a stiffer layer, or [sleepers] on a soft bed in place of the slab",
      mortar.name, 1e-6 * mortar.youngs_modulus, compliance.sheared, compliance.bent, 100 * missing,
      fastening, 100 * kTellingShare);
}

void add_contact_warnings(const Model& model, std::vector<std::string>& warnings) {
  const WheelSpec& wheel = *model.scene.wheel;
  const RailSpec& rail = *model.scene.rail;
  warnings.push_back(profile_warning("wheel", wheel.profile_y, wheel.profile_z));
  warnings.push_back(profile_warning("rail", rail.profile_y, rail.profile_z));
  warnings.push_back(lean_warning(rail));
  warnings.push_back(beam_warning(model));
  warnings.push_back(patch_warning(model));
  warnings.push_back(edge_warning(model));
  warnings.push_back(stress_depth_warning(model));
  const Material &of_wheel = model.scene.wheel_material(), &of_rail = model.scene.head_material();
  for (const auto& warning : {branch_warning, plastic_warning}) {
    warnings.push_back(warning(model, of_wheel));
    if (&of_rail != &of_wheel) warnings.push_back(warning(model, of_rail));
  }
  warnings.push_back(memory_warning(model));
  add_way_warnings(model, warnings);
  add_depth_warnings(model, warnings);
}

}  // namespace

std::optional<double> too_few_elements_across_patch(const Model& model) {
  const double across = shorter_axis(model) / model.sizes.contact;
  if (!model.contact || across <= 0 || across >= kElementsOfPatch) return std::nullopt;
  return across;
}

std::vector<std::string> resolution_warnings(const Model& model) {
  std::vector<std::string> warnings = {history_warning(model.scene), hammer_warning(model),
                                       blow_and_passage_warning(model), slab_warning(model.scene)};
  if (model.contact) add_contact_warnings(model, warnings);
  std::erase(warnings, "");
  return warnings;
}

}  // namespace tread
