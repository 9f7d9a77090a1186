#include "drivers/studies/multibody/response_map.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "core/parallel/each_item.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/studies/multibody/local_parts.hpp"
#include "drivers/studies/multibody/model_difference.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

constexpr std::size_t kMostPoints = 100000;

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw InputError(
      fmt::format("--map {}: {}; expected for example \"speed=100:500:10km/h\" or \"wavelength=40:150:2mm\"",
                  text, reason));
}

MapAxis parse_axis(const std::string& text, const std::string& range, const Quantity& quantity) {
  const auto one = range.find(':');
  const auto two = one == std::string::npos ? one : range.find(':', one + 1);
  if (two == std::string::npos) refuse(text, "it needs first, last and step between colons");
  const std::string last = range.substr(two + 1);
  const auto letter = last.find_first_not_of("0123456789.+-eE ");
  MapAxis axis;
  axis.unit = letter == std::string::npos ? "" : last.substr(letter);
  try {
    const auto value = [&](const std::string& number) {
      return parse_quantity(number + " " + axis.unit, quantity);
    };
    const double low = value(range.substr(0, one));
    const double high = value(range.substr(one + 1, two - one - 1));
    const double step = value(last.substr(0, letter));
    if (!(low > 0 && high >= low && step > 0)) refuse(text, "it must hold 0 < first <= last and a step > 0");
    const double count = std::floor((high - low) / step + 1e-6);
    if (count >= static_cast<double>(kMostPoints)) refuse(text, "that is more than 100000 values");
    for (int i = 0; i <= static_cast<int>(count); ++i) axis.values.push_back(low + i * step);
  } catch (const InputError& error) {
    if (std::string(error.what()).starts_with("--map")) throw;
    refuse(text, error.what());
  }
  return axis;
}

/// Largest and smallest force and the loss of contact during a passage.
struct Extremes {
  double max = 0, min = 1e300;
  int steps = 0, lost = 0;
  void add(double force) {
    max = std::max(max, force);
    min = std::min(min, force);
    ++steps;
    lost += force > 0 ? 0 : 1;
  }
};

void require_sine(const Scene& scene, const std::string& where) {
  if (!scene.corrugation || scene.corrugation->kind != "sine")
    throw InputError(where + ": the scene needs a [corrugation] with kind = \"sine\"");
}

/// First difference of a run's sine from the map's, but for the wavelength; empty if there is none.
std::string sine_difference(const MultibodyModel& map, const MultibodyModel& run) {
  const SineUnderWheel ours = sine_under_wheel(map);
  const SineUnderWheel theirs = sine_under_wheel(run);
  if (std::abs(theirs.depth - ours.depth) > 1e-3 * ours.depth)
    return fmt::format("depth {:.3g} mm, the map's is {:.3g} mm", 1e3 * theirs.depth, 1e3 * ours.depth);
  const double our_start = map.scene.corrugation->start;
  const double their_start = run.scene.corrugation->start;
  if (std::abs(their_start - our_start) > 1e-6)
    return fmt::format("starts at {:.3f} m, the map's corrugation at {:.3f} m", their_start, our_start);
  if (std::abs(theirs.width - ours.width) > 1e-3 * ours.width)
    return fmt::format("half width {:.3g} mm, the map's is {:.3g} mm", 1e3 * theirs.width, 1e3 * ours.width);
  // The mesh slightly affects the contact's place.
  if (std::abs(theirs.centre - ours.centre) > 1e-2 * ours.width)
    return fmt::format("centre {:.1f} mm from the contact, the map's {:.1f} mm", 1e3 * theirs.centre,
                       1e3 * ours.centre);
  return "";
}

/// Sentences on cells whose waves pass faster than the modes vibrate or whose F_N exceeds the pressed
/// half-spaces'.
std::vector<std::string> map_warnings(const ResponseMap& map, const MultibodyModel& model,
                                      const MultibodyStep& step) {
  const TopOfModes top = top_of_modes(model, step.modes);
  std::size_t fast = 0, strong = 0;
  for (std::size_t i = 0; i < map.axes.speed.values.size(); ++i)
    for (std::size_t j = 0; j < map.axes.wavelength.values.size(); ++j) {
      fast += map.axes.speed.values[i] / map.axes.wavelength.values[j] > top.frequency;
      strong += model.beyond_half_spaces(map.at(i, j).max * model.vehicle.load());
    }
  std::vector<std::string> warnings;
  if (fast > 0)
    warnings.push_back(fmt::format(
        "in {} of {} cells of the map waves pass above {:.0f} Hz, where the modes of {} end; state {}", fast,
        map.points.size(), top.frequency, top.part, top.way_out));
  if (strong > 0)
    warnings.push_back(
        fmt::format("in {} of {} cells of the map F_N exceeds {:.1f} kN, up to which --contact half-space "
                    "presses; state a smaller depth or --contact hertz",
                    strong, map.points.size(), 1e-3 * model.sine.most()));
  return warnings;
}

}  // namespace

MapAxes parse_map_axes(const std::vector<std::string>& texts) {
  std::optional<MapAxis> speed, wavelength;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    const std::string name = text.substr(0, equals);
    if (equals == std::string::npos || (name != "speed" && name != "wavelength"))
      refuse(text, "it names neither speed nor wavelength");
    std::optional<MapAxis>& axis = name == "speed" ? speed : wavelength;
    if (axis) refuse(text, name + " is stated twice");
    axis = parse_axis(text, text.substr(equals + 1), name == "speed" ? kSpeed : kLength);
  }
  if (!speed || !wavelength) refuse(texts.front(), "it takes both speed and wavelength");
  if (speed->values.size() * wavelength->values.size() > kMostPoints)
    refuse(texts.front(), "that is more than 100000 points");
  return {*speed, *wavelength};
}

void require_whole_waves(const MultibodyModel& model, const MapAxes& axes) {
  require_sine(model.scene, "--map");
  const double longest = axes.wavelength.values.back();
  if (with_wavelength(model, longest).smooth())
    throw InputError(
        fmt::format("--map: no whole wave of {:.4g} mm fits corrugation.length = {:.4g} mm; state "
                    "shorter wavelengths or a larger corrugation.length",
                    1e3 * longest, 1e3 * model.scene.corrugation->length));
}

ResponseMap response_map(const MultibodyModel& model, const MapAxes& axes, const MultibodyStep& step,
                         bool filtered) {
  require_whole_waves(model, axes);
  const ModalTrack track = modal_track(model, step.modes);
  const std::vector<double>& speeds = axes.speed.values;
  const std::vector<double>& waves = axes.wavelength.values;
  std::vector<MultibodyModel> models(waves.size(), model);
  each_item(waves.size(), [&](std::size_t i) {
    MultibodyModel& m = models[i];
    m.scene.corrugation->wavelength = waves[i];
    m.corrugation = with_wavelength(model, waves[i]);
    if (filtered) apply_contact_filter(m);
    if (!m.sine.empty()) use_half_space_contact(m);
  });

  ResponseMap map{axes, std::vector<MapPoint>(speeds.size() * waves.size()), 0, 0, {}};
  const auto dt = [&](double speed) { return step.step.value_or(chosen_step(track, models.front(), speed)); };
  map.dt_first = dt(speeds.front());
  map.dt_last = dt(speeds.back());
  const double load = model.vehicle.load();
  each_item(speeds.size(), [&](std::size_t i) {
    const double speed = speeds[i];
    ModalPassage before(track, model.vehicle, model.start, dt(speed), model.wheel_at(speed));
    roll(before, models.front(), speed, model.scene.corrugation->start, [](double, double) {});
    for (std::size_t j = 0; j < waves.size(); ++j) {
      const MultibodyModel& m = models[j];
      const Span stretch = evaluated_stretch(m.scene, m.corrugation);
      ModalPassage passage = before;
      Extremes extremes;
      roll(passage, m, speed, stretch.last, [&](double x, double) {
        if (x >= stretch.first) extremes.add(passage.force());
      });
      map.points[i * waves.size() + j] = {extremes.max / load, extremes.min / load,
                                          static_cast<double>(extremes.lost) / extremes.steps};
    }
  });
  map.warnings = map_warnings(map, model, step);
  return map;
}

MapDot map_dot(const MultibodyModel& model, const TransientRun& run) {
  const std::string name = "--dots " + run.directory.string();
  require_same_files(run, name);
  require_sine(run.scene, name);
  const CorrugationSpec& spec = *run.scene.corrugation;
  const Corrugation corrugation = corrugation_of(spec, 0);
  const Span stretch = evaluated_stretch(run.scene, corrugation);
  if (run.x.back() < std::min(stretch.first + spec.wavelength, stretch.last))
    throw InputError(
        fmt::format("{}: the run ends at x = {:.3f} m, before a wave of its corrugation is past; {}", name,
                    run.x.back(), run.further()));
  require_samples(run, name, {std::max(stretch.first, run.x.front()), std::min(stretch.last, run.x.back())},
                  spec.wavelength);
  Extremes extremes;
  for (std::size_t i = 0; i < run.x.size(); ++i)
    if (run.x[i] >= stretch.first && run.x[i] <= stretch.last) extremes.add(run.force[i]);
  MapDot dot;
  dot.label = folder_name(run.directory);
  dot.speed = run.speed_between(stretch.first, stretch.last);
  dot.wavelength = spec.wavelength;
  const MultibodyModel theirs = multibody_model(run.scene, model.theory);
  dot.max = extremes.max / theirs.vehicle.load();
  dot.min = extremes.min / theirs.vehicle.load();
  dot.remark = sine_difference(model, theirs);
  if (dot.remark.empty() && run.x.back() < stretch.last)
    dot.remark = fmt::format("ends at x = {:.3f} m", run.x.back());
  if (dot.remark.empty()) dot.remark = track_difference(model, theirs);
  if (dot.remark.empty()) dot.remark = surface_difference(model, theirs);
  return dot;
}

}  // namespace tread
