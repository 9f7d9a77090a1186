#include "drivers/report/report_references.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/report/markup.hpp"

namespace tread {

namespace {

bool is(double value, double wanted) {
  return std::abs(value - wanted) <= 1e-6 * std::abs(wanted);
}

/// The vehicle and track of the paper's Table 1, whatever runs on them.
bool has_paper_vehicle(const Scene& s) {
  return s.wheel && s.wheel->shape == "half_wheelset" && s.wheel->profile == "LMA" &&
         is(s.wheel->diameter, 0.86) && s.rail && s.rail->profile == "CN60" && s.vehicle &&
         is(s.vehicle->sprung_mass, 8000) && is(s.vehicle->unsprung_mass, 340) &&
         is(s.vehicle->suspension_stiffness, 880e3) && is(s.steel.youngs_modulus, 205.9e9);
}

bool has_paper_track(const Scene& s) {
  return s.slab_track && s.fastenings && is(s.fastenings->spacing, 0.65) &&
         is(s.fastenings->stiffness, 22e6) && is(s.fastenings->damping, 200e3);
}

bool rolls_at_300(const Scene& s) {
  return s.motion && is(s.motion->speed, 300 / 3.6) && s.motion->traction_mu &&
         is(*s.motion->traction_mu, 0.3) && s.contact && is(s.contact->friction, 0.5);
}

bool is_corrugation_d(const Scene& s) {
  return s.corrugation && s.corrugation->kind == "sine" && is(s.corrugation->wavelength, 0.08) &&
         is(s.corrugation->depth, 0.14e-3) && is(s.corrugation->width, 0.03) && is(s.corrugation->start, 2.4);
}

/// Whether the whole stretch of a figure has been rolled over.
bool reached(const RunResults& r, double x) {
  return !r.samples.empty() && r.samples.back().wheel_x >= x;
}

/// Steady values are worth comparing once the torque has ramped up and the smooth rail before the corrugation
/// is behind.
bool steady(const Model& model, const RunResults& r) {
  const MotionSpec& motion = *model.scene.motion;
  return reached(r, r.steady_last) && r.steady_first >= 1.5 * motion.ramp * motion.speed;
}

std::optional<double> when(bool valid, double value) {
  return valid ? std::optional(value) : std::nullopt;
}

}  // namespace

double paper_creepage(const Scene& scene) {
  return has_paper_vehicle(scene) && has_paper_track(scene) && rolls_at_300(scene) ? 0.276e-2 : 0.0;
}

std::vector<Comparison> paper_comparisons(const Model& model, const RunResults& r) {
  const Scene& scene = model.scene;
  std::vector<Comparison> rows;
  if (!model.contact || !has_paper_vehicle(scene)) return rows;
  rows.push_back({"Static wheel load", "kN", 87.56, -1e-3 * r.preload.contact.force_on_rail.z,
                  "weight of 8000 + 340 + 586 kg (Table 1), gravity 9.81 m/s²"});
  if (!has_paper_track(scene) || !rolls_at_300(scene)) return rows;
  rows.push_back({"Creepage, steady, smooth rail", "%", 0.276, when(steady(model, r), 100 * r.creepage),
                  "mean of 28 tread nodes; section 4.2 and Fig. 18"});
  if (is_corrugation_d(scene)) {
    const Corrugation& corrugation = model.contact->corrugation();
    const bool passed = reached(r, corrugation.last());
    rows.push_back({"Largest F_N over corrugation D", "kN", 193.19, when(passed, 1e-3 * r.vertical_force.max),
                    "section 4.2, Fig. 15"});
    rows.push_back({"Smallest F_N over corrugation D", "kN", 3.02, when(passed, 1e-3 * r.vertical_force.min),
                    "section 4.2, Fig. 15"});
    rows.push_back({"Largest creepage over the steady", "-", 2.0,
                    when(passed && r.creepage > 0, r.creepage_max / r.creepage),
                    "\"close to double\" in section 4.2; here of the mean of 28 nodes"});
  }
  rows.push_back({"Time step", "s", 8.9e-8, r.dt,
                  fmt::format("paper: contact elements of 1.1 mm; here {} mm (quality \"{}\")",
                              readable(1e3 * model.sizes.contact, 3), scene.quality)});
  rows.push_back({"Elements", "million", 1.46, 1e-6 * static_cast<double>(model.elements()), "as above"});
  return rows;
}

std::vector<Comparison> theory_comparisons(const Model& model, const RunResults& r) {
  std::vector<Comparison> rows;
  if (!model.contact) return rows;
  const Scene& scene = model.scene;
  const HertzPatch& hertz = model.hertz_patch;
  const bool sphere = scene.wheel->profile == "arc" && scene.rail->profile == "box";
  const std::string shape =
      fmt::format("Hertz for radii {} and {} mm", readable(1e3 * model.wheel_radius(), 4),
                  readable(1e3 * model.hertz_radius_y, 4));
  const std::string remark =
      sphere ? shape : shape + "; the profiles' curvature varies over the patch: not Hertzian";
  rows.push_back({"Patch area, static", "mm²", 1e6 * std::numbers::pi * hertz.semi_axis_x * hertz.semi_axis_y,
                  1e6 * r.preload.contact.area, remark});
  rows.push_back({"Largest pressure, static", "MPa", 1e-6 * hertz.max_pressure, 1e-6 * r.preload.max_pressure,
                  "nodal average; " + remark});
  const bool contact_case = rolls_at_300(scene) && is(scene.steel.youngs_modulus, 205.9e9) &&
                            std::abs(model.wheel_load() - 87564) < 500 && is(model.wheel_radius(), 0.43);
  if (contact_case && steady(model, r))
    rows.push_back(
        {"Creepage, steady", "%", 0.265, 100 * r.creepage,
         "CONTACT on the Hertz ellipse 6.67 x 5.25 mm, grid extrapolated, relative to free rolling"});
  return rows;
}

}  // namespace tread
