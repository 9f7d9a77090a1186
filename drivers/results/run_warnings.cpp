#include "drivers/results/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>

#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/model/surfaces.hpp"
#include "drivers/engine/start/traction.hpp"
#include "drivers/results/force_spectrum.hpp"
#include "drivers/results/resolution.hpp"

namespace tread {

namespace {

/// Share of a body's energy in hourglass modes above which its deformation is one of the mesh. Measured: 7 %
/// in the tread on 6 mm, 1 % on 2.2 mm.
constexpr double kHourglass = 0.2;

/// Slab and sleepers have few elements in their depth. The slab's move vertically: it shears and does not
/// bend. Those of sleepers bend correctly: the energy of bending is in hourglass modes, all of it in one
/// element, a quarter in two. [explanation/element.md]
bool is_plate(const BlockIndex& index, int block) {
  return block == index.slab || std::ranges::count(index.sleepers, block) > 0;
}

/// Sag of the rail under the wheel at rest beyond which its supports are doubted [m]. Soft ballasted tracks
/// sag by 5 mm; springs stay linear, however far they are pressed.
constexpr double kSag = 0.02;

std::string sag_warning(const Model& model, const Preload& preload) {
  if (preload.rail_deflection <= kSag) return "";
  return fmt::format(
      "the rail sinks by {:.3g} mm under the wheel: above {:.3g} mm its supports are doubted; a larger {} "
      "holds "
      "it",
      1e3 * preload.rail_deflection, 1e3 * kSag,
      model.scene.sleepers ? "fastenings.stiffness or sleepers.stiffness" : "fastenings.stiffness");
}

/// Change of F_N from span to span, over the load, at which a rolling start is as after a long way.
constexpr double kRestless = 0.01;

std::string run_in_warning(const Preload& preload) {
  if (preload.run_in_change <= kRestless) return "";
  return fmt::format(
      "the way before a start = \"rolling\" was too short: F_N still changed by {:.2g} % of the load "
      "from span to span, above {:.2g} % it swings at first; let the wheel roll further before what is "
      "evaluated, or state stiffer fastenings or more fastenings.damping",
      100 * preload.run_in_change, 100 * kRestless);
}

/// Sentence where the static state, which is elastic, yields as soon as the wheel rolls. F_N alone may have
/// another cause.
std::string yield_warning(const RunResults& r) {
  constexpr double kYieldedShare = 0.1;
  const double load = -r.preload.contact.force_on_rail.z;
  const double first = r.samples.front().vertical_force;
  const bool yielded = !r.origin && r.samples.front().energy.plastic_work > 0;
  if (!yielded || std::abs(first - load) <= kYieldedShare * load) return "";
  return fmt::format(
      "F_N is {:.4g} kN in the first sample and {:.4g} kN at rest, more than {:g} % apart: the static "
      "state is elastic, and wheel or rail yields in the first step; let the wheel roll further before what "
      "is evaluated",
      1e-3 * first, 1e-3 * load, 100 * kYieldedShare);
}

/// Residual over what was dissipated or stored above which losses are doubted.
constexpr double kEnergyError = 0.02;

std::string balance_warning(const Model& model, const RunResults& r) {
  if (r.energy_error <= kEnergyError) return "";
  return fmt::format(
      "the energies miss by {:.3g} % of what was dissipated and stored: above {:g} % frictional work and "
      "losses are in doubt; a smaller motion.step_safety shows whether the time step is the cause{}",
      100 * r.energy_error, 100 * kEnergyError, uncounted_loss(model));
}

/// Key that moves the steady stretch on, "a later solution_zone.start": it ends with the run, ahead of the
/// corrugation or with the zone.
const char* later_stretch(const Model& model, const RunResults& r) {
  if (r.reached <= r.steady_last) return "a longer motion.duration";
  return model.contact->corrugation().smooth() ? "a later solution_zone.start" : "a later corrugation.start";
}

/// Place of the wheel from which a torque that grows counts as settled [m]; nothing after the run's end.
std::optional<double> settled_torque_place(const Scene& scene, const RunResults& r) {
  const double time = settled_torque_time(scene);
  const auto settled = std::ranges::find_if(r.samples, [&](const Sample& s) { return s.time >= time; });
  return settled == r.samples.end() ? std::nullopt : std::optional(settled->wheel_x);
}

/// Sentence where the torque changes along the steady stretch.
std::string torque_warning(const Model& model, const RunResults& r) {
  const Scene& scene = model.scene;
  const std::string changes = fmt::format(
      "the torque of motion.traction still changes or has just changed on the steady stretch (x = {:.3f} to "
      "{:.3f} m): traction and creepage are not steady there",
      r.steady_first, r.steady_last);
  if (stands(scene))
    return fmt::format(
        "{}; the wheel stands, and its static state is without the torque: read the last samples of the "
        "histories in place of the means",
        changes);
  if (const std::optional<double> place = settling_place(scene, r))
    return fmt::format(
        "{}; motion.traction.ramp = \"0 ms\" lets it act at once on a static state without it, and it counts "
        "as "
        "settled from x = {:.3f} m on: {} gives it the way",
        changes, *place, later_stretch(model, r));
  const double time = settled_torque_time(scene);
  const std::optional<double> place = settled_torque_place(scene, r);
  return fmt::format(
      "{}; it counts as settled from {:.4g} ms on, {}: {} or {} gives it the way", changes, 1e3 * time,
      place ? fmt::format("x = {:.3f} m", *place) : "after the run's end",
      scene.motion->reversals > 0 ? "fewer motion.traction.reversals" : "a smaller motion.traction.ramp",
      later_stretch(model, r));
}

/// Advice where the traction changes along the steady stretch, by the shapes and the torque that the wheel
/// meets there or within its length ahead of it.
std::string steadiness_advice(const Model& model, const RunResults& r) {
  const Span near{std::max(model.scene.start_x(), 2 * r.steady_first - r.steady_last), r.steady_last};
  std::vector<std::string> shapes;
  for (const auto& [name, spec] : model.scene.surfaces)
    if (!places_of(model.scene, spec, near).empty()) shapes.push_back("surface." + name);
  const std::optional<double> place = settled_torque_place(model.scene, r);
  const bool risen = model.scene.motion->ramp > 0 && place && *place >= near.first && *place <= near.last;
  const std::string way = fmt::format(
      "{}{} gives it the way", risen ? "a smaller motion.traction.ramp or " : "", later_stretch(model, r));
  if (shapes.empty()) return way;
  return fmt::format(
      "the wheel meets {} there or shortly before, and the forces follow: a run without it shows the "
      "traction alone{}{}",
      fmt::join(shapes, ", "), risen ? "; " : "", risen ? way : "");
}

std::string steadiness_warning(const Model& model, const RunResults& r) {
  if (full_torque(model) == 0 || r.steady_samples == 0 || traction_is_steady(model.scene, r)) return "";
  if (traction_slides(r))
    return fmt::format(
        "the whole patch slides in {:.0f} % of the samples of the steady stretch (x = {:.3f} to {:.3f} m): "
        "friction does not carry the torque of motion.traction, so that the wheel spins up or brakes to a "
        "stop",
        100 * r.steady_slip_share, r.steady_first, r.steady_last);
  if (!torque_has_settled(model.scene, r)) return torque_warning(model, r);
  if (!r.traction_drift) return "";  // empty_half_warning()
  const double half = 0.5 * *r.traction_drift;
  return fmt::format(
      "F_L / F_N goes from {:.4f} to {:.4f} along the steady stretch (x = {:.3f} to {:.3f} m): traction and "
      "creepage are not steady there; {}",
      r.traction_coefficient - half, r.traction_coefficient + half, r.steady_first, r.steady_last,
      steadiness_advice(model, r));
}

/// Sentence where a steady traction is not that of the torque.
std::string target_warning(const Model& model, const RunResults& r) {
  const Scene& scene = model.scene;
  if (!traction_misses(r) || !traction_is_steady(scene, r)) return "";
  const double vertical = r.vertical_force_steady / model.wheel_load();
  const double longitudinal = r.traction_coefficient / *r.traction_target * vertical;
  const bool risen = scene.motion->ramp > 0 && scene.start() != "rigid" && !model.guide;
  return fmt::format(
      "F_L / F_N is {:.4f} over the steady stretch (x = {:.3f} to {:.3f} m), motion.traction gives {:.4f}: "
      "F_L is {:+.1f} % off there and F_N {:+.1f} %, as both swing; {}{} gives them the way to settle",
      r.traction_coefficient, r.steady_first, r.steady_last, *r.traction_target, 100 * (longitudinal - 1),
      100 * (vertical - 1),
      risen ? "motion.traction.ramp = \"0 ms\" starts under the steady torque, or " : "",
      later_stretch(model, r));
}

/// Sentence where no sample lies in the stretch that the summary evaluates.
std::string empty_warning(const RunResults& r) {
  if (r.evaluated_samples > 0) return "";
  return fmt::format(
      "no sample lies in the evaluated stretch, x = {:.6g} to {:.6g} m: its values in the summary are 0 and "
      "no results; a longer solution_zone.length or corrugation, or a shorter output.history_interval gives "
      "some",
      r.evaluated_first, r.evaluated_last);
}

/// Sentence where no sample lies in the steady stretch.
std::string empty_steady_warning(const RunResults& r) {
  if (r.steady_samples > 0) return "";
  return fmt::format(
      "no sample lies in the steady stretch, which ends at x = {:.6g} m: its values in the summary are 0 and "
      "no results; a later corrugation.start or solution_zone.start, or a longer motion.duration, gives it "
      "the way",
      r.steady_last);
}

/// Sentence where one half of the steady stretch holds no sample.
std::string empty_half_warning(const RunResults& r) {
  if (r.steady_samples == 0 || r.traction_drift) return "";
  return fmt::format(
      "one half of the steady stretch, x = {:.6g} to {:.6g} m, holds no sample: traction_drift is null and "
      "traction_steady false in the summary; a shorter output.history_interval fills both halves",
      r.steady_first, r.steady_last);
}

/// Sentence where the interval of samples changes along the evaluated stretch.
std::string interval_warning(const RunResults& r) {
  const SampleIntervals intervals = sample_intervals(r.samples, r.evaluated_first, r.evaluated_last);
  if (intervals.even(r.dt)) return "";
  return fmt::format(
      "samples lie {:.3g} to {:.3g} us apart in the evaluated stretch: its means count each of them alike, "
      "and its third octaves are left out; one output.history_interval for the whole run gives both",
      1e6 * intervals.least, 1e6 * intervals.most);
}

/// Sentence where elements that pass make a large part of the range of F_N.
std::string ripple_warning(const Model& model, const RunResults& r) {
  constexpr double kShare = 0.25;    // of the range
  constexpr double kTelling = 0.01;  // of the mean, below which no range matters
  const std::optional<double> across = too_few_elements_across_patch(model);
  const auto largest = std::ranges::max_element(r.ripples, {}, &ForceSine::amplitude);
  if (!across || largest == r.ripples.end()) return "";
  const double ripple = 2 * largest->amplitude, range = r.vertical_force.range();
  const bool coarse = *across * model.sizes.contact < kElementsOfForce * largest->length;
  if (!coarse || ripple <= std::max(kShare * range, kTelling * r.vertical_force.mean)) return "";
  return fmt::format(
      "F_N ripples by {:.3g} kN at {:.3g} kHz, as elements of {:.3g} mm pass: {:.0f} % of its range in "
      "the evaluated stretch, above {:g} %, comes from the mesh, and part of the dynamic factor with it; a "
      "smaller scene.element_size lessens it",
      1e-3 * ripple, 1e-3 * largest->frequency, 1e3 * largest->length, 100 * std::min(1.0, ripple / range),
      100 * kShare);
}

std::string hourglass_warning(const std::string& body, const DeformationEnergy& energy) {
  const double whole = energy.strain + energy.hourglass;
  if (whole <= 0 || energy.hourglass <= kHourglass * whole) return "";
  return fmt::format(
      "{:.0f} % of the energy in the body '{}' is in hourglass modes: above {:.0f} % the elements are too "
      "coarse for its deformation; a smaller scene.element_size resolves it",
      100 * energy.hourglass / whole, body, 100 * kHourglass);
}

void add_rolling_warnings(const Model& model, const RunResults& r, std::vector<std::string>& warnings) {
  if (model.contact) {
    warnings.push_back(yield_warning(r));
    warnings.push_back(empty_warning(r));
    warnings.push_back(interval_warning(r));
    warnings.push_back(ripple_warning(model, r));
    warnings.push_back(empty_steady_warning(r));
    warnings.push_back(empty_half_warning(r));
    warnings.push_back(steadiness_warning(model, r));
    warnings.push_back(target_warning(model, r));
  }
  warnings.push_back(balance_warning(model, r));
  for (std::size_t b = 0; b < r.part_energy.size(); ++b)
    if (!is_plate(model.index, static_cast<int>(b)))
      warnings.push_back(hourglass_warning(model.mesh.part_name(static_cast<int>(b)), r.part_energy[b]));
}

}  // namespace

std::string uncounted_loss(const Model& model) {
  std::set<std::string> keys;
  const auto look_at = [&](const std::vector<Material>& materials) {
    for (const Material& material : materials)
      if (material.high_frequency_fraction > 0 || (material.rayleigh_beta > 0 && !material.branch()))
        keys.insert(fmt::format("material.{}.damping", material.name));
  };
  for (const SweptBlock& block : model.mesh.blocks) look_at(block.materials);
  for (const HexBody& body : model.mesh.bodies) look_at(body.materials);
  if (keys.empty()) return "";
  return fmt::format("; the loss of {}, which no energy counts, is part of the miss", fmt::join(keys, ", "));
}

std::vector<std::string> run_warnings(const Model& model, const RunResults& r) {
  std::vector<std::string> warnings = resolution_warnings(model);
  warnings.push_back(sag_warning(model, r.preload));
  warnings.push_back(run_in_warning(r.preload));
  if (!r.samples.empty()) add_rolling_warnings(model, r, warnings);
  std::erase(warnings, "");
  return warnings;
}

}  // namespace tread
