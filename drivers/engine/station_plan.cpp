#include "drivers/engine/station_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/travel.hpp"

namespace tread {

MeshSizes mesh_sizes(const Scene& scene) {
  MeshSizes sizes;
  if (scene.quality == "draft") {
    sizes = {2.2e-3, 45e-3, 10e-3, 65e-3, 2, 4, 4, 14e-3};
  } else if (scene.quality == "standard") {
    sizes = {1.6e-3, 35e-3, 8e-3, 50e-3, 2, 4, 4, 16e-3};
  } else {
    sizes = {1.1e-3, 25e-3, 8e-3, 40e-3, 3, 6, 4, 16e-3};
  }
  if (scene.element_size) {
    const double scale = *scene.element_size / sizes.contact;
    sizes.contact *= scale;
    sizes.section = std::min(sizes.section * scale, 12e-3);
    sizes.band_half_width = std::max(sizes.band_half_width, 6 * sizes.contact);
  }
  return sizes;
}

double patch_reach(double wheel_radius) {
  return std::sqrt(2 * wheel_radius * 6e-4);
}

Span run_span(const Scene& scene) {
  constexpr double kMargin = 0.02;  // [m]
  if (!scene.wheel) return {};
  const double reach = patch_reach(0.5 * scene.wheel->diameter);
  const double start = scene.start_x();
  const double run = scene.motion ? scene.motion->speed * scene.motion->duration : 0;
  const Travel travel = travel_of(scene);
  return {std::min(travel.first, start - kMargin) - reach,
          std::max(travel.last, start + run + kMargin) + reach};
}

Span zone_span(const Scene& scene) {
  const double margin = scene.wheel ? 0.7 * patch_reach(0.5 * scene.wheel->diameter) : 0;
  const Span zone{scene.zone_start - margin, scene.zone_start + scene.zone_length + margin};
  const bool elsewhere = !scene.motion && (zone.first > 0 || zone.last < 0);
  return elsewhere ? run_span(scene) : zone;
}

namespace {

/// Fine elements per coarse one where the wheel only approaches.
int approach_parts(const MeshSizes& sizes) {
  return std::max(1, sizes.coarse_ratio / sizes.approach_ratio);
}

/// A sudden change of pitch changes the contact's compliance and kicks the wheel. So the pitch changes in two
/// steps, and those of the wheel stand between those of the rail.
constexpr double kStepLength = 0.05;  // [m]

/// Fine elements per coarse one of the step between approach and zone.
int step_parts(const MeshSizes& sizes) {
  return (approach_parts(sizes) + sizes.coarse_ratio) / 2;
}

/// Appends `count` coarse elements of one pitch, each cut into `ratio` fine ones.
void append(NestedSegments& plan, int count, double pitch, int ratio) {
  plan.coarse.push_back({count, pitch, 0});
  plan.fine.push_back({count * ratio, pitch / ratio, 0});
}

void append_uniform(NestedSegments& plan, Span span, double pitch, int ratio) {
  if (span.last - span.first < 1e-9) return;
  const double length = span.last - span.first;
  const int count = std::max(1, static_cast<int>(std::ceil(length / pitch - 1e-6)));
  append(plan, count, length / count, ratio);
}

/// Pitches that grow from `pitch` to `far` over `length`, four elements of each.
std::vector<Segment> graded(double length, double pitch, double far) {
  std::vector<Segment> segments;
  double left = length;
  for (double p = 1.3 * pitch; p < far && left > 4 * p + 4 * far; p *= 1.3) {
    segments.push_back({4, p, 0});
    left -= 4 * p;
  }
  if (left > 1e-9) {
    const double target = segments.empty() ? std::min(far, 1.3 * pitch) : far;
    const int count = std::max(1, static_cast<int>(std::ceil(left / target - 1e-6)));
    segments.push_back({count, left / count, 0});
  }
  return segments;
}

/// Widens the zone to `shortest` [m], and to the ends of the run where less would be left: a short element
/// would limit the time step and spoil the static solver.
void absorb_slivers(Span& zone, const Span& run, double shortest) {
  if (zone.empty()) return;
  if (zone.last - zone.first < shortest) zone.first = zone.last - shortest;
  if (zone.first - run.first < shortest) zone.first = run.first;
  if (run.last - zone.last < shortest) zone.last = run.last;
}

}  // namespace

NestedSegments plan_rail(Span rail, Span run, Span zone, const MeshSizes& sizes) {
  run.first = std::max(run.first, rail.first);
  run.last = std::min(run.last, rail.last);
  zone.first = std::max(zone.first, run.first);
  zone.last = std::min(zone.last, run.last);
  if (zone.empty()) zone = {run.last, run.last};
  const double coarse = sizes.contact * sizes.coarse_ratio;
  absorb_slivers(zone, run, 0.5 * coarse);
  const int approach = approach_parts(sizes);
  Span step{zone.first - 2 * kStepLength, zone.last + 2 * kStepLength};
  step = {std::max(step.first, run.first), std::min(step.last, run.last)};
  absorb_slivers(step, run, 0.5 * coarse);

  NestedSegments plan;
  auto before = graded(run.first - rail.first, coarse, sizes.far);
  std::reverse(before.begin(), before.end());
  for (const Segment& s : before) append(plan, s.elements, s.pitch, 1);
  append_uniform(plan, {run.first, step.first}, coarse, approach);
  append_uniform(plan, {step.first, zone.first}, coarse, step_parts(sizes));
  append_uniform(plan, zone, coarse, sizes.coarse_ratio);
  append_uniform(plan, {zone.last, step.last}, coarse, step_parts(sizes));
  append_uniform(plan, {step.last, run.last}, coarse, approach);
  for (const Segment& s : graded(rail.last - run.last, coarse, sizes.far))
    append(plan, s.elements, s.pitch, 1);
  return plan;
}

NestedSegments plan_even_rail(Span rail, const MeshSizes& sizes) {
  NestedSegments plan;
  append_uniform(plan, rail, sizes.contact * sizes.coarse_ratio, 1);
  return plan;
}

WheelPlan plan_wheel(double radius, Span zone, const MeshSizes& sizes) {
  constexpr double turn = 2 * std::numbers::pi;
  // Whole axle elements around, each of axle_ratio disc elements of coarse_ratio tread elements.
  const int axle =
      static_cast<int>(std::lround(turn * radius / (sizes.contact * sizes.coarse_ratio * sizes.axle_ratio)));
  const int disc = axle * sizes.axle_ratio;
  const double pitch = turn / disc;
  const auto elements = [&](double length) { return static_cast<int>(std::ceil(length / (radius * pitch))); };
  if (!zone.empty()) zone = {zone.first - kStepLength, zone.last + kStepLength};
  const int fine = zone.empty() ? 0 : std::min(disc, elements(zone.last - zone.first));
  const int step = fine > 0 ? std::min((disc - fine) / 2, elements(2 * kStepLength)) : 0;

  WheelPlan plan;
  plan.start = zone.empty() ? 0 : -zone.last / radius;
  plan.axle.push_back({axle, turn / axle, 0});
  plan.disc.push_back({disc, pitch, 0});
  const auto tread = [&](int count, int parts) {
    if (count > 0) plan.tread.push_back({count * parts, pitch / parts, 0});
  };
  tread(fine, sizes.coarse_ratio);
  tread(step, step_parts(sizes));
  tread(disc - fine - 2 * step, approach_parts(sizes));
  tread(step, step_parts(sizes));
  return plan;
}

WheelPlan plan_tyre(double radius, Span run, Span zone, const MeshSizes& sizes) {
  const double turn = 2 * std::numbers::pi * radius;
  if (zone.empty()) zone = {0, 0};
  run = {std::min(run.first, zone.first), std::max(run.last, zone.last)};
  const double pitch = sizes.contact * sizes.coarse_ratio / approach_parts(sizes);

  // Lengths on the rolling circle, from the end of the zone backwards.
  NestedSegments lengths;
  std::vector<Segment>& segments = lengths.fine;
  double left = turn;
  const auto evenly = [&](double length, double size) {
    length = std::min(length, left);
    append_uniform(lengths, {0, length}, size, 1);
    left -= std::max(length, 0.0);
  };
  evenly(zone.last - zone.first, sizes.contact);
  const double behind = std::min(zone.first - run.first, left);
  const double ahead = std::min(run.last - zone.last, left - behind);
  evenly(behind, pitch);
  const double rest = left - ahead;
  if (rest > 1e-9) {
    auto growing = graded(0.5 * rest, pitch, 2 * sizes.section);
    segments.insert(segments.end(), growing.begin(), growing.end());
    segments.insert(segments.end(), growing.rbegin(), growing.rend());
    left -= rest;
  }
  evenly(ahead, pitch);

  WheelPlan plan;
  plan.start = -zone.last / radius;
  for (const Segment& s : segments) plan.tread.push_back({s.elements, s.pitch / radius, 0});
  return plan;
}

WheelPlan plan_tyre_part(double radius, Span run, Span zone, double overhang, const MeshSizes& sizes) {
  const Span all{run.first - overhang, run.last + overhang};
  run = {std::max(all.first, run.first - patch_reach(radius)),
         std::min(all.last, run.last + patch_reach(radius))};
  zone = {std::max(zone.first, run.first), std::min(zone.last, run.last)};
  if (zone.empty()) zone = {run.last, run.last};
  const double pitch = sizes.contact * sizes.coarse_ratio / approach_parts(sizes);
  absorb_slivers(zone, run, 0.5 * pitch);
  // From the end backwards.
  NestedSegments lengths;
  std::vector<Segment>& segments = lengths.fine;
  auto ahead = graded(all.last - run.last, pitch, 2 * sizes.section);
  segments.insert(segments.end(), ahead.rbegin(), ahead.rend());
  append_uniform(lengths, {zone.last, run.last}, pitch, 1);
  append_uniform(lengths, zone, sizes.contact, 1);
  append_uniform(lengths, {run.first, zone.first}, pitch, 1);
  const auto behind = graded(run.first - all.first, pitch, 2 * sizes.section);
  segments.insert(segments.end(), behind.begin(), behind.end());

  WheelPlan plan;
  plan.start = -all.last / radius;
  for (const Segment& s : segments) plan.tread.push_back({s.elements, s.pitch / radius, 0});
  return plan;
}

}  // namespace tread
