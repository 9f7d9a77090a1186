#include "drivers/studies/multibody/multibody_run.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "core/error.hpp"
#include "core/math/statistics.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/start/rail_beam.hpp"

namespace tread {

namespace {

/// Wavelength of a sine [m]; 0 without one.
double wavelength_of(const MultibodyModel& model) {
  const auto& spec = model.scene.corrugation;
  return spec && spec->kind == "sine" ? spec->wavelength : 0;
}

/// Shortest wave that depths at these places show in full [m].
double shortest_measured(const std::vector<double>& x) {
  constexpr double kPlacesOfAWave = 20;  // as in random roughness
  return kPlacesOfAWave * mean_spacing(x);
}

/// Shortest wave of a surface; `diameter`: of the wheel [m].
double shortest_of(const SurfaceSpec& spec, double diameter) {
  if (spec.kind == "profile" || spec.kind == "map") return shortest_measured(spec.file_x);
  if (spec.kind == "waves") return spec.wavelength;
  return spec.kind == "polygon" ? std::numbers::pi * diameter / spec.order : spec.length;
}

/// Shortest wave of corrugation and surfaces [m]; infinite where rail and wheel are smooth.
double shortest_wave(const Scene& scene) {
  double shortest = std::numeric_limits<double>::infinity();
  if (const auto& spec = scene.corrugation)
    shortest = spec->in_file() ? shortest_measured(spec->table_x) : spec->shortest_wave();
  for (const auto& [name, surface] : scene.surfaces)
    shortest = std::min(shortest, shortest_of(surface, scene.wheel->diameter));
  return shortest;
}

/// Last fastening span before the corrugation, on a smooth rail of the evaluated stretch; none where the
/// wheel starts within it.
std::optional<Span> passing_span(const MultibodyModel& model) {
  const double last = model.corrugation.smooth() ? evaluated_stretch(model.scene, model.corrugation).last
                                                 : model.corrugation.first();
  const double first = last - model.scene.fastenings->spacing;
  return first < model.start ? std::nullopt : std::optional(Span{first, last});
}

/// Half the range of F_N over passing_span() [N]; none where surfaces lift or lower the wheel there.
std::optional<double> passing_half_range(const MultibodyModel& model,
                                         const std::vector<MultibodySample>& samples) {
  const std::optional<Span> span = passing_span(model);
  if (!span) return std::nullopt;
  const auto inside = [&](const MultibodySample& s) { return s.x >= span->first && s.x < span->last; };
  const auto off_line = [&](const MultibodySample& s) { return inside(s) && s.roughness != 0; };
  if (std::any_of(samples.begin(), samples.end(), off_line)) return std::nullopt;
  return 0.5 * statistics(samples, inside, [](const MultibodySample& s) { return s.force; }).range();
}

/// Place from which a passage is sampled [m].
double sampled_from(const MultibodyModel& model) {
  const double evaluated = evaluated_stretch(model.scene, model.corrugation).first;
  const std::optional<Span> span = passing_span(model);
  return std::min({0.0, model.scene.start_x(), evaluated, span ? span->first : evaluated});
}

void evaluate(const MultibodyModel& model, MultibodyResult& r) {
  const Span stretch = evaluated_stretch(model.scene, model.corrugation);
  r.evaluated_first = stretch.first;
  r.evaluated_last = stretch.last;
  const auto evaluated = [&](const MultibodySample& s) {
    return s.x >= stretch.first && s.x <= stretch.last;
  };
  r.force = statistics(r.samples, evaluated, [](const MultibodySample& s) { return s.force; });
  r.loss_of_contact =
      statistics(r.samples, evaluated, [](const MultibodySample& s) { return s.force > 0 ? 0.0 : 1.0; }).mean;
  r.passing = passing_half_range(model, r.samples);
  if (const double wave = wavelength_of(model); wave > 0) {
    std::vector<double> x, f;
    for (const MultibodySample& s : r.samples) {
      x.push_back(s.x);
      f.push_back(s.force);
    }
    r.peaks = crest_peaks(model.corrugation, wave, x, f);
  }
}

/// Sentences on waves that pass faster than the modes vibrate, on forces beyond the pressed half-spaces', and
/// on a head that the beam lacks.
std::vector<std::string> range_warnings(const MultibodyModel& model, const MultibodyStep& step,
                                        double largest_force) {
  std::vector<std::string> warnings;
  const TopOfModes top = top_of_modes(model, step.modes);
  const double wave = shortest_wave(model.scene);
  if (model.speed / wave > top.frequency)
    warnings.push_back(fmt::format(
        "the shortest wave or surface, {:.3g} mm, passes at {:.0f} Hz, and the modes of {} end at {:.0f} Hz; "
        "state {}",
        1e3 * wave, model.speed / wave, top.part, top.frequency, top.way_out));
  if (model.beyond_half_spaces(largest_force))
    warnings.push_back(
        fmt::format("F_N reaches {:.1f} kN, and --contact half-space presses up to {:.1f} kN and goes on "
                    "straight; state a smaller depth or --contact hertz",
                    1e-3 * largest_force, 1e-3 * model.sine.most()));
  if (!model.solid && !is_of_the_beam(model.scene, model.scene.head_material()))
    warnings.emplace_back(
        "the beam is of rail.material alone, and rail.head_material has another Young's modulus or density; "
        "state --beam solid");
  return warnings;
}

/// Place [m] where the least-squares parabola of forces [N] at x [m] is largest; nullopt unless it is among
/// them.
std::optional<double> vertex(std::span<const double> x, std::span<const double> force) {
  const auto mean = [&](const auto& value) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += value(i);
    return sum / static_cast<double>(x.size());
  };
  const double middle = mean([&](std::size_t i) { return x[i]; });
  const auto u = [&](std::size_t i) { return x[i] - middle; };
  // F = F0 + c1 u + c2 q(u); 1, u and q are orthogonal over the samples.
  const double square = mean([&](std::size_t i) { return u(i) * u(i); });
  const double lean = mean([&](std::size_t i) { return u(i) * u(i) * u(i); }) / square;
  const auto q = [&](std::size_t i) { return u(i) * u(i) - lean * u(i) - square; };
  const double c1 = mean([&](std::size_t i) { return u(i) * force[i]; }) / square;
  const double c2 =
      mean([&](std::size_t i) { return q(i) * force[i]; }) / mean([&](std::size_t i) { return q(i) * q(i); });
  const double place = middle + 0.5 * (lean - c1 / c2);
  return c2 < 0 && place >= x.front() && place <= x.back() ? std::optional(place) : std::nullopt;
}

/// Peak of forces [N] at x [m]: the vertex over the samples about the largest that lack at most 5 % of the
/// range; the largest sample itself where they are no hill.
CrestPeak peak_of(std::span<const double> x, std::span<const double> force) {
  constexpr double kShareOfRange = 0.05;
  const auto [least, most] = std::minmax_element(force.begin(), force.end());
  const auto lower = [limit = *most - kShareOfRange * (*most - *least)](double f) { return f < limit; };
  const auto top = most - force.begin();
  const auto first =
      std::find_if(std::make_reverse_iterator(most), force.rend(), lower).base() - force.begin();
  const auto count = std::find_if(most, force.end(), lower) - force.begin() - first;
  const auto about = [&](std::span<const double> all) {
    return all.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
  };
  const std::optional<double> place = count < 3 ? std::nullopt : vertex(about(x), about(force));
  return {.peak = place.value_or(x[static_cast<std::size_t>(top)]), .force = *most};
}

}  // namespace

std::vector<CrestPeak> crest_peaks(const Corrugation& corrugation, double wavelength,
                                   const std::vector<double>& x, const std::vector<double>& force) {
  std::vector<CrestPeak> peaks;
  const double half = 0.5 * wavelength;
  for (double crest = corrugation.first() + wavelength; crest < corrugation.last() - half;
       crest += wavelength) {
    const auto first = std::lower_bound(x.begin(), x.end(), crest - half);
    const auto last = std::upper_bound(first, x.end(), crest + half);
    if (first == x.begin() || last == x.end() || first == last) continue;
    CrestPeak found =
        peak_of({first, last}, {force.begin() + (first - x.begin()), force.begin() + (last - x.begin())});
    found.crest = crest;
    found.shift = 2 * std::numbers::pi * (crest - found.peak) / wavelength;
    peaks.push_back(found);
  }
  return peaks;
}

double mean_shift(const std::vector<CrestPeak>& peaks) {
  double sine = 0;
  double cosine = 0;
  for (const CrestPeak& p : peaks) {
    sine += std::sin(p.shift);
    cosine += std::cos(p.shift);
  }
  return std::atan2(sine, cosine);
}

double chosen_step(const ModalTrack& track, const MultibodyModel& model, double speed) {
  constexpr double kOfAWave = 40;
  return std::min(passage_step(track, model.vehicle, model.wheel),
                  shortest_wave(model.scene) / speed / kOfAWave);
}

MultibodyResult run_multibody(const MultibodyModel& model, const MultibodyStep& step) {
  const ModalTrack track = modal_track(model, step.modes);
  // Estimates of the stable step are good to a factor of two; a longer step cannot be stable.
  const double longest = 4 * passage_step(track, model.vehicle, model.wheel);
  if (step.step && *step.step > longest)
    throw InputError(fmt::format("--step {:.4g} s: steps beyond {:.2g} s cannot be stable with {} modes",
                                 *step.step, longest, track.modes()));
  MultibodyResult r;
  r.modes = track.modes();
  r.dt = step.step.value_or(chosen_step(track, model, model.speed));
  const ModalWheel wheel = model.wheel_at(model.speed);
  r.static_rail = ModalPassage(track, model.vehicle, model.scene.start_x(), r.dt, wheel).rail();
  ModalPassage passage(track, model.vehicle, model.start, r.dt, wheel);
  const double first = sampled_from(model);
  roll(passage, model, model.speed, model.end, [&](double x, double roughness) {
    ++r.steps;
    if (x >= first)
      r.samples.push_back(
          {passage.time(), x, passage.force(), passage.wheel(), passage.rail(), passage.sprung(), roughness});
  });
  evaluate(model, r);
  r.warnings = range_warnings(model, step, r.force.max);
  return r;
}

}  // namespace tread
