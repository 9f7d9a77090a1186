#include "drivers/engine/model/station_plan.hpp"

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
  sizes.margin = scene.zone_margin;
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

namespace {

/// [m]
double half_patch(const Scene& scene) {
  return scene.wheel ? 0.7 * patch_reach(0.5 * scene.wheel->diameter) : 0;
}

}  // namespace

bool stands(const Scene& scene) {
  constexpr double kHardly = 1e-3;  // [m]
  if (!scene.motion) return true;
  const Travel travel = travel_of(scene);
  return scene.motion->speed == 0 && travel.last - travel.first < kHardly;
}

Span zone_span(const Scene& scene) {
  const double half = half_patch(scene);
  const ZoneSpec stated = scene.solution_zone();
  const Span zone{stated.start - half, stated.end() + half};
  const double start = scene.start_x();
  const bool elsewhere = stands(scene) && (zone.first > start || zone.last < start);
  return elsewhere ? run_span(scene) : zone;
}

std::vector<Span> zone_spans(const Scene& scene) {
  const double half = half_patch(scene);
  std::vector<Span> zones = {zone_span(scene)};
  for (const auto& [name, zone] : scene.zones) zones.push_back({zone.start - half, zone.end() + half});
  std::sort(zones.begin(), zones.end(), [](const Span& a, const Span& b) { return a.first < b.first; });
  return zones;
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

/// A stretch of the run outside of the zones: the approach pitch, and in `far`, beyond the margins of all
/// zones, twice that pitch in head and base. On a tread as coarse as that F_N swings more, and kicks the
/// wheel where the pitch changes.
void append_approach(NestedSegments& plan, Span stretch, Span far, const MeshSizes& sizes) {
  const double coarse = sizes.contact * sizes.coarse_ratio;
  const int parts = approach_parts(sizes);
  constexpr int kLeast = 8;          // base elements that are worth two changes of pitch
  constexpr double kLongest = 9e-3;  // on longer ones F_N swings by more than 1 % [m]
  if (far.last - far.first < kLeast * coarse || 2 * coarse / parts > kLongest)
    far = {stretch.last, stretch.last};
  append_uniform(plan, {stretch.first, far.first}, coarse, parts);
  append_uniform(plan, far, 2 * coarse, parts);
  append_uniform(plan, {far.last, stretch.last}, coarse, parts);
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

/// Widens the run to the ends of a body where less than `shortest` [m] would be left.
void absorb_ends(Span& run, const Span& body, double shortest) {
  if (run.first - body.first < shortest) run.first = body.first;
  if (body.last - run.last < shortest) run.last = body.last;
}

/// Least distance of zones that both have their steps [m].
double least_gap(const MeshSizes& sizes) {
  return 4 * kStepLength + 0.5 * sizes.contact * sizes.coarse_ratio;
}

/// The zones that are not empty, those nearer to each other than `gap` [m] in one.
std::vector<Span> joined(const std::vector<Span>& zones, double gap) {
  std::vector<Span> apart;
  for (const Span& zone : zones) {
    if (zone.empty()) continue;
    if (!apart.empty() && zone.first - apart.back().last < gap)
      apart.back().last = std::max(apart.back().last, zone.last);
    else
      apart.push_back(zone);
  }
  return apart;
}

/// The parts of the zones within `run`, without slivers, further apart than `gap` [m]. Without any, an empty
/// zone at the end of the run.
std::vector<Span> zones_within(const Span& run, std::vector<Span> zones, double gap, double shortest) {
  for (Span& zone : zones) {
    zone = {std::max(zone.first, run.first), std::min(zone.last, run.last)};
    absorb_slivers(zone, run, shortest);
  }
  zones = joined(zones, gap);
  if (zones.empty()) zones.push_back({run.last, run.last});
  return zones;
}

}  // namespace

Span arc_of(const Scene& scene, Span track) {
  if (!scene.motion) return track;
  const double way = scene.motion->speed * scene.motion->duration;
  const double slip = scene.motion->spin_ratio() - 1;  // of the way
  const double half = half_patch(scene);
  if (std::abs(slip) * way <= 0.5 * half) return track;
  const auto lead = [&](double x) { return slip * std::clamp(x, 0.0, way); };
  return {track.first + std::min(0.0, lead(track.first + half)),
          track.last + std::max(0.0, lead(track.last))};
}

NestedSegments plan_rail(Span rail, Span run, const std::vector<Span>& zones, const MeshSizes& sizes) {
  run.first = std::max(run.first, rail.first);
  run.last = std::min(run.last, rail.last);
  const double coarse = sizes.contact * sizes.coarse_ratio;
  const double shortest = 0.5 * coarse;
  absorb_ends(run, rail, shortest);

  NestedSegments plan;
  auto before = graded(run.first - rail.first, coarse, sizes.far);
  std::reverse(before.begin(), before.end());
  for (const Segment& s : before) append(plan, s.elements, s.pitch, 1);
  double at = run.first;
  double far = run.first;  // margin behind the last zone ends
  for (const Span& zone : zones_within(run, zones, least_gap(sizes), shortest)) {
    Span step{std::max(zone.first - 2 * kStepLength, run.first),
              std::min(zone.last + 2 * kStepLength, run.last)};
    absorb_slivers(step, run, shortest);
    append_approach(plan, {at, step.first}, {far, step.first - sizes.margin}, sizes);
    append_uniform(plan, {step.first, zone.first}, coarse, step_parts(sizes));
    append_uniform(plan, zone, coarse, sizes.coarse_ratio);
    append_uniform(plan, {zone.last, step.last}, coarse, step_parts(sizes));
    at = step.last;
    far = step.last + sizes.margin;
  }
  append_approach(plan, {at, run.last}, {far, run.last}, sizes);
  for (const Segment& s : graded(rail.last - run.last, coarse, sizes.far))
    append(plan, s.elements, s.pitch, 1);
  return plan;
}

NestedSegments plan_even_rail(Span rail, const MeshSizes& sizes) {
  NestedSegments plan;
  append_uniform(plan, rail, sizes.contact * sizes.coarse_ratio, 1);
  return plan;
}

WheelPlan plan_wheel(double radius, const std::vector<Span>& zones, const MeshSizes& sizes) {
  constexpr double turn = 2 * std::numbers::pi;
  // Whole axle elements around, each of axle_ratio disc elements of coarse_ratio tread elements.
  const int axle =
      static_cast<int>(std::lround(turn * radius / (sizes.contact * sizes.coarse_ratio * sizes.axle_ratio)));
  const int disc = axle * sizes.axle_ratio;
  const double pitch = turn / disc;
  const auto elements = [&](double length) { return static_cast<int>(std::ceil(length / (radius * pitch))); };

  WheelPlan plan;
  std::vector<int> parts(static_cast<std::size_t>(disc), approach_parts(sizes));  // of each disc element
  const auto refine = [&](int first, int count, int wanted) {
    for (int i = first; i < first + std::min(count, disc); ++i) {
      int& of = parts[static_cast<std::size_t>((i % disc + disc) % disc)];
      of = std::max(of, wanted);
    }
  };
  const std::vector<Span> fine = joined(zones, least_gap(sizes));
  // Place of the first element's end on the rail; the others lie behind it [m].
  const double start = fine.empty() ? 0 : fine.front().last + kStepLength;
  for (const Span& zone : fine) {
    const Span widened{zone.first - kStepLength, zone.last + kStepLength};
    const auto first = static_cast<int>(std::floor((start - widened.last) / (radius * pitch)));
    const int whole = elements(start - widened.first) - first;
    const int step = elements(2 * kStepLength);
    refine(first - step, whole + 2 * step, step_parts(sizes));
    refine(first, whole, sizes.coarse_ratio);
  }
  plan.start = -start / radius;
  plan.axle.push_back({axle, turn / axle, 0});
  plan.disc.push_back({disc, pitch, 0});
  for (std::size_t i = 0; i < parts.size();) {
    const auto other = std::find_if(parts.begin() + static_cast<std::ptrdiff_t>(i), parts.end(),
                                    [&](int count) { return count != parts[i]; });
    const auto next = static_cast<std::size_t>(other - parts.begin());
    plan.tread.push_back({static_cast<int>(next - i) * parts[i], pitch / parts[i], 0});
    i = next;
  }
  return plan;
}

WheelPlan plan_tyre(double radius, Span run, std::vector<Span> zones, const MeshSizes& sizes) {
  const double turn = 2 * std::numbers::pi * radius;
  const double pitch = sizes.contact * sizes.coarse_ratio / approach_parts(sizes);
  zones = joined(zones, 0.5 * pitch);
  if (zones.empty()) zones.push_back({0, 0});
  if (zones.back().last - zones.front().first > turn) zones = {{zones.front().first, zones.back().last}};
  run = {std::min(run.first, zones.front().first), std::max(run.last, zones.back().last)};

  // Lengths on the rolling circle, from the end of the last zone backwards.
  NestedSegments lengths;
  std::vector<Segment>& segments = lengths.fine;
  double left = turn;
  // A stretch of less than half an element goes to the one beside it.
  const double shortest = 0.5 * pitch;
  const auto evenly = [&](double length, double size) {
    if (length > 0 && left - length < shortest) length = left;
    append_uniform(lengths, {0, length}, size, 1);
    left -= std::max(length, 0.0);
  };
  double at = zones.back().last;
  for (auto zone = zones.rbegin(); zone != zones.rend(); ++zone) {
    evenly(at - zone->last, pitch);
    evenly(zone->last - zone->first, sizes.contact);
    at = zone->first;
  }
  if (const double behind = at - run.first; behind >= shortest) evenly(behind, pitch);
  double ahead = std::min(run.last - zones.back().last, left);
  if (ahead < shortest) ahead = 0;
  if (ahead > 0 && left - ahead < shortest) ahead = left;
  const double rest = left - ahead;
  if (rest > 1e-9) {
    auto growing = graded(0.5 * rest, pitch, 2 * sizes.section);
    segments.insert(segments.end(), growing.begin(), growing.end());
    segments.insert(segments.end(), growing.rbegin(), growing.rend());
    left -= rest;
  }
  evenly(ahead, pitch);

  WheelPlan plan;
  plan.start = -zones.back().last / radius;
  for (const Segment& s : segments) plan.tread.push_back({s.elements, s.pitch / radius, 0});
  return plan;
}

WheelPlan plan_tyre_part(double radius, Span run, const std::vector<Span>& zones, double overhang,
                         const MeshSizes& sizes) {
  run.last = std::min(run.last, run.first + kLargestPart * 2 * std::numbers::pi * radius - 2 * overhang);
  const Span all{run.first - overhang, run.last + overhang};
  run = {std::max(all.first, run.first - patch_reach(radius)),
         std::min(all.last, run.last + patch_reach(radius))};
  const double pitch = sizes.contact * sizes.coarse_ratio / approach_parts(sizes);
  const double shortest = 0.5 * pitch;
  absorb_ends(run, all, shortest);
  const std::vector<Span> within = zones_within(run, zones, shortest, shortest);
  // From the end backwards.
  NestedSegments lengths;
  std::vector<Segment>& segments = lengths.fine;
  auto ahead = graded(all.last - run.last, pitch, 2 * sizes.section);
  segments.insert(segments.end(), ahead.rbegin(), ahead.rend());
  double at = run.last;
  for (auto zone = within.rbegin(); zone != within.rend(); ++zone) {
    append_uniform(lengths, {zone->last, at}, pitch, 1);
    append_uniform(lengths, *zone, sizes.contact, 1);
    at = zone->first;
  }
  append_uniform(lengths, {run.first, at}, pitch, 1);
  const auto behind = graded(run.first - all.first, pitch, 2 * sizes.section);
  segments.insert(segments.end(), behind.begin(), behind.end());

  WheelPlan plan;
  plan.start = -all.last / radius;
  for (const Segment& s : segments) plan.tread.push_back({s.elements, s.pitch / radius, 0});
  return plan;
}

}  // namespace tread
