// Figures of a run from its samples.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/start/traction.hpp"
#include "drivers/results/run_results.hpp"

namespace tread {

namespace {

constexpr double kRounding = 1e-9;  ///< of places [m]

/// Returns a test for samples with the wheel between two places [m]. The first sample lies at the start but
/// for rounding.
auto between(double first, double last) {
  return [first, last](const Sample& s) {
    return s.wheel_x >= first - kRounding && s.wheel_x <= last + kRounding;
  };
}

/// Those whose whole patch slides, of the samples in contact that count.
template <class Counts>
double full_slip_share(const std::vector<Sample>& samples, const Counts& counts) {
  constexpr double kWhole = 0.98;  // of the patch: the rest may be the rim of an integration point
  return statistics(
             samples, [&](const Sample& s) { return counts(s) && s.patch_area > 0; },
             [](const Sample& s) { return s.slip_area > kWhole * s.patch_area ? 1.0 : 0.0; })
      .mean;
}

/// Rearmost and foremost place of the wheel, which brakes may turn back [m].
Span way_of(const std::vector<Sample>& samples) {
  const auto [rear, fore] =
      std::ranges::minmax_element(samples, {}, [](const Sample& s) { return s.wheel_x; });
  return {rear->wheel_x, fore->wheel_x};
}

/// Length of the rail's elements on a stretch [m]; nothing where it changes.
std::optional<double> even_pitch(const Model& model, const Span& stretch) {
  const std::vector<double>& x = model.contact->nodes().grid().x;
  std::vector<double> pitches;
  for (std::size_t i = 1; i < x.size(); ++i)
    if (x[i] > stretch.first + kRounding && x[i - 1] < stretch.last - kRounding)
      pitches.push_back(x[i] - x[i - 1]);
  const Statistics pitch = statistics(pitches);
  return pitch.mean > 0 && pitch.range() <= kRounding ? std::optional(pitch.mean) : std::nullopt;
}

/// Fills the spectrum of F_N over the evaluated stretch, and its sines of elements and corrugation.
void evaluate_spectrum(const Model& model, RunResults& r) {
  r.spectrum = force_spectrum(r.samples, r.evaluated_first, r.evaluated_last, r.dt);
  if (const auto pitch = even_pitch(model, {r.evaluated_first, r.evaluated_last}))
    for (const int ratio : {1, model.sizes.approach_ratio})
      if (const auto ripple = r.spectrum.sine_of_elements(ratio * *pitch)) r.ripples.push_back(*ripple);
  const std::optional<CorrugationSpec>& corrugation = model.scene.corrugation;
  if (corrugation && corrugation->kind == "sine" && r.evaluated_first >= model.contact->corrugation().first())
    r.wave = r.spectrum.sine_of_wave(corrugation->wavelength);
}

/// Fills forces, creepage and sliding over the evaluated stretch. A wheel that stands trembles.
void evaluate_stretch(const Model& model, const Span& way, RunResults& r) {
  const Corrugation& corrugation = model.contact->corrugation();
  const Span stretch = stands(model.scene) ? way : evaluated_stretch(model.scene, corrugation);
  r.evaluated_first = stretch.first;
  r.evaluated_last = std::min(way.last, stretch.last);
  r.passed = way.last >= stretch.last - kRounding;
  if (r.evaluated_first > way.last) r.evaluated_first = model.scene.start_x();
  const auto evaluated = between(r.evaluated_first, r.evaluated_last);
  r.evaluated_samples = std::count_if(r.samples.begin(), r.samples.end(), evaluated);
  const auto over = [&](auto value) { return statistics(r.samples, evaluated, value); };
  r.vertical_force = over([](const Sample& s) { return s.vertical_force; });
  evaluate_spectrum(model, r);
  r.longitudinal_force = over([](const Sample& s) { return s.longitudinal_force; });
  r.lateral_force = over([](const Sample& s) { return s.lateral_force; });
  r.lateral_creepage = over([](const Sample& s) { return s.lateral_creepage; });
  r.spin_creepage = over([](const Sample& s) { return s.spin_creepage; });
  const Statistics creepage = over([](const Sample& s) { return s.creepage_mean; });
  r.creepage_max = -creepage.min > creepage.max ? creepage.min : creepage.max;
  r.full_slip_share = full_slip_share(r.samples, evaluated);
}

/// Accepted change of a traction along the steady stretch, or difference from it.
double traction_bound(double traction) {
  constexpr double kSteady = 0.05;
  return std::max(kSteady * std::abs(traction), kSmallTraction);
}

/// Mean F_L over mean F_N between two places of the wheel [m]; 0 without load.
double traction_between(std::span<const Sample> samples, double first, double last) {
  const auto mean = [&](auto value) { return statistics(samples, between(first, last), value).mean; };
  const double vertical = mean([](const Sample& s) { return s.vertical_force; });
  return vertical > 0 ? mean([](const Sample& s) { return s.longitudinal_force; }) / vertical : 0.0;
}

/// Traction of the stretch's second half less that of its first; nothing where a half holds no sample.
std::optional<double> traction_drift(const std::vector<Sample>& samples, double first, double last) {
  const double middle = 0.5 * (first + last);
  if (std::ranges::none_of(samples, between(first, middle)) ||
      std::ranges::none_of(samples, between(middle, last)))
    return std::nullopt;
  return traction_between(samples, middle, last) - traction_between(samples, first, middle);
}

/// Length of the steady stretch: a fastening span [m].
double steady_length(const Scene& scene) {
  return scene.fastenings ? scene.fastenings->spacing : 0.1;
}

/// Fills the means over a stretch that ends with the solution zone, or ahead of the corrugation.
void evaluate_steady(const Model& model, const Span& way, RunResults& r) {
  const Scene& scene = model.scene;
  const Corrugation& corrugation = model.contact->corrugation();
  constexpr double kAhead = 0.02;  // of the wheel's axis, where the patch does not meet the corrugation [m]
  const double end = std::min(
      way.last, corrugation.smooth() ? scene.zone_start + scene.zone_length : corrugation.first() - kAhead);
  const Span span = stands(scene) ? way : Span{std::max(scene.start_x(), end - steady_length(scene)), end};
  r.steady_first = span.first;
  r.steady_last = span.last;
  const auto steady = between(r.steady_first, r.steady_last);
  const auto mean = [&](auto value) { return statistics(r.samples, steady, value).mean; };
  r.steady_samples = std::count_if(r.samples.begin(), r.samples.end(), steady);
  if (const auto first = std::ranges::find_if(r.samples, steady); first != r.samples.end())
    r.steady_begin = first->time;
  r.vertical_force_steady = mean([](const Sample& s) { return s.vertical_force; });
  r.traction_coefficient = traction_between(r.samples, r.steady_first, r.steady_last);
  if (const double full = full_traction(model); full != 0)
    r.traction_target = full * scene.motion->torque_share(settled_torque_time(scene));
  r.traction_drift = traction_drift(r.samples, r.steady_first, r.steady_last);
  r.creepage = mean([](const Sample& s) { return s.creepage_mean; });
  r.creepage_of_work = creepage_of_work(r.samples, r.steady_first, r.steady_last, model.wheel_radius());
  r.steady_slip_share = full_slip_share(r.samples, steady);
  r.max_pressure = mean([](const Sample& s) { return s.max_pressure; });
  r.max_shear = mean([](const Sample& s) { return s.max_shear; });
  r.patch_area = mean([](const Sample& s) { return s.patch_area; });
  // The patch has passed what lies behind its search window.
  const double reach = model.contact->reach();
  if (r.surface_fields)
    r.surface = surface_results(*r.surface_fields, std::max(r.evaluated_first, model.scene.start_x() + reach),
                                std::min(r.evaluated_last, way.last - reach));
}

/// Fills the errors of energy and momentum. [theory.md, eq. 14]
void evaluate_balance(RunResults& r) {
  constexpr double kAtRest = 0.01;  // of the strain energy: a wheel that stands dissipates and stores nothing
  double worst = 0;
  double strain_low = r.samples.front().energy.strain;
  double strain_high = strain_low;
  for (std::size_t i = 0; i < r.samples.size(); ++i) {
    const EnergyLedger& e = r.samples[i].energy;
    worst = std::max(worst, std::abs(e.residual));
    strain_low = std::min(strain_low, e.strain);
    strain_high = std::max(strain_high, e.strain);
    if (i > 0)
      r.frictional_work_decrease =
          std::max(r.frictional_work_decrease, r.samples[i - 1].energy.frictional_work - e.frictional_work);
  }
  const EnergyLedger& last = r.samples.back().energy;
  const double scale = std::max(last.frictional_work + last.connector_loss + last.material_loss +
                                    last.plastic_work + strain_high - strain_low,
                                kAtRest * strain_high);
  r.energy_error = scale > 0 ? worst / scale : 0;
  r.energy_error_of_work = last.frictional_work > 0 ? worst / last.frictional_work : 0;
  const Vec3 miss = r.momentum.impulse - r.momentum.change;
  if (r.momentum.contact_impulse.z > 0)
    r.momentum_error = std::hypot(miss.x, miss.z) / r.momentum.contact_impulse.z;
}

}  // namespace

bool traction_slides(const RunResults& r) {
  return r.steady_slip_share > 0.5 && (r.driven || std::abs(r.traction_coefficient) > kSmallTraction);
}

bool traction_is_steady(const Scene& scene, const RunResults& r) {
  if (!r.traction_drift || traction_slides(r) || (r.driven && !torque_has_settled(scene, r))) return false;
  return std::abs(*r.traction_drift) <= traction_bound(r.traction_coefficient);
}

bool traction_misses(const RunResults& r) {
  return r.traction_target &&
         std::abs(r.traction_coefficient - *r.traction_target) > traction_bound(*r.traction_target);
}

std::optional<double> settling_place(const Scene& scene, const RunResults& r) {
  if (!r.driven || scene.motion->ramp > 0 || r.preload.traction != 0) return std::nullopt;
  return scene.start_x() + steady_length(scene);
}

bool torque_has_settled(const Scene& scene, const RunResults& r) {
  if (stands(scene)) return !r.driven;
  if (const std::optional<double> place = settling_place(scene, r))
    return r.steady_first >= *place - kRounding;
  return r.steady_begin >= settled_torque_time(scene);
}

void evaluate(const Model& model, RunResults& r) {
  if (r.samples.empty()) return;
  r.driven = full_torque(model) != 0;
  if (model.contact) {
    const Span way = way_of(r.samples);
    r.reached = way.last;
    evaluate_stretch(model, way, r);
    evaluate_steady(model, way, r);
  }
  evaluate_balance(r);
}

Statistics measured_statistics(const Model& model, const RunResults& r, std::size_t column) {
  const auto evaluated = between(r.evaluated_first, r.evaluated_last);
  std::vector<double> values;
  for (std::size_t i = 0; i < r.samples.size(); ++i)
    if ((!model.contact || evaluated(r.samples[i])) && std::isfinite(r.measured.row(i)[column]))
      values.push_back(r.measured.row(i)[column]);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return values.empty() ? Statistics{kNone, kNone, kNone, kNone} : statistics(values);
}

std::optional<double> creepage_of_work(const std::vector<Sample>& samples, double first, double last,
                                       double radius) {
  const auto inside = between(first, last);
  const auto begin = std::find_if(samples.begin(), samples.end(), inside);
  if (begin == samples.end()) return std::nullopt;
  // Brakes may turn the wheel back, within the stretch or beyond.
  const auto end = std::max_element(begin, std::find_if_not(begin, samples.end(), inside),
                                    [](const Sample& a, const Sample& b) { return a.wheel_x < b.wheel_x; });
  const std::span<const Sample> passage(&*begin, static_cast<std::size_t>(end - begin) + 1);
  double way = 0;  // of the mean of rim and forward speed [m]
  for (std::size_t i = 1; i < passage.size(); ++i) {
    const Sample &from = passage[i - 1], &to = passage[i];
    const double rolled = radius * 0.5 * (from.wheel_spin + to.wheel_spin) * (to.time - from.time);
    way += 0.5 * std::abs(rolled + to.wheel_x - from.wheel_x);
  }
  const double force = statistics(passage, inside, [](const Sample& s) { return s.longitudinal_force; }).mean;
  if (way <= 0 || std::abs(traction_between(passage, first, last)) < kSmallTraction) return std::nullopt;
  return (end->energy.frictional_work - begin->energy.frictional_work) / (way * force);
}

}  // namespace tread
