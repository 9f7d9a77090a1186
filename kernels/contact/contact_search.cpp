#include "kernels/contact/contact_search.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {

namespace {

constexpr double kEver = -std::numeric_limits<double>::infinity();

/// First station of the face at a place along a surface, or at its end beyond it.
int face_at(const SweptBlock& block, const StationFinder& finder, double at) {
  if (!block.closed) at = std::clamp(at, block.stations.front(), block.stations.back());
  return std::max(finder.find(at).station, 0);
}

/// The part of a surface between two places along it and about these edges, with all nodes that its faces'
/// cubics take.
SurfacePart part_of(const SweptBlock& block, const StationFinder& finder, const SurfaceProfile& profile,
                    std::array<double, 2> ends, std::array<int, 2> edges) {
  constexpr int kBeside = 2;  // of cubics, and one more
  const int all = block.station_count();
  const int first = face_at(block, finder, ends[0]);
  const int last = face_at(block, finder, ends[1]);
  SurfacePart part;
  if (block.closed) {
    const int between = ends[1] - ends[0] < M_PI ? (last - first + all) % all : all;
    part.count = std::min(between + 2 + 2 * kBeside, all);
    part.first = (first - kBeside + all) % all;
  } else {
    part.first = std::max(first - kBeside, 0);
    part.count = std::min(last + 2 + kBeside, all) - part.first;
  }
  part.first_node = std::max(edges[0] - kBeside, 0);
  part.last_node = std::min(edges[1] + 2 + kBeside, profile.edges() + 1);
  return part;
}

}  // namespace

TileSpan tiles_of(const SweptBlock& block, const SurfacePart& part) {
  const auto all = static_cast<int>(block.tiles.size());
  const int first = block.tile_of_station[index(part.first)];
  const int last = block.tile_of_station[index((part.first + part.count - 1) % block.station_count())];
  // A stretch that begins and ends in one tile lies in it, or passes all others.
  return {first, first == last && part.count > kLanes ? all : (last - first + all) % all + 1};
}

ContactSearch::ContactSearch(const SweptBlock& rail, const SweptBlock& wheel, const Options& options,
                             Corrugation corrugation)
    : surfaces_(rail, wheel, options.surface, options.across, options.rail_depth, options.wheel_depth),
      options_(options),
      quadrature_(options.points) {
  set_corrugation(std::move(corrugation));
}

void ContactSearch::set_corrugation(Corrugation corrugation) {
  surfaces_.set_corrugation(std::move(corrugation));
  deepest_ = depth_over(surfaces_.corrugation().deepest());
  choose_edges();
  make_room();
}

/// Depth that there is room for, of all shapes together, with a corrugation of that depth [m].
double ContactSearch::depth_over(double corrugation) const {
  double deepest = std::max(options_.depth_room, corrugation);
  for (const RunningSurface* surface : {&surfaces_.rail_depth(), &surfaces_.wheel_depth()})
    deepest += surface->room(options_.wheel_radius, options_.reach_gap);
  return deepest;
}

/// Edges of the rail that lie within reach of the wheel's undeformed profile lowered to touch.
void ContactSearch::choose_edges() {
  const SurfaceProfile& rail = surfaces_.rail_profile();
  const SurfaceProfile& wheel = surfaces_.wheel_profile();
  double closest = 1e30;
  std::vector<double>& gap = lateral_gap_;
  gap.assign(static_cast<std::size_t>(rail.edges()), 1e30);
  for (int edge = 0; edge < rail.edges(); ++edge) {
    const auto at = rail.evaluate(edge, 0.5, options_.surface);
    if (at.p <= wheel.first_p() || at.p >= wheel.last_p()) continue;
    const int over = wheel.edge_at(at.p);
    const double p0 = wheel.edge_p(over, 0);
    const double eta = (at.p - p0) / (wheel.edge_p(over, 1) - p0);
    gap[static_cast<std::size_t>(edge)] = -at.q - wheel.evaluate(over, eta, options_.surface).q;
    closest = std::min(closest, gap[static_cast<std::size_t>(edge)]);
  }
  touching_height_ = -closest;
  const double lateral_reach = 1.5 * options_.reach_gap + deepest_;
  first_edge_ = rail.edges();
  last_edge_ = 0;
  for (int edge = 0; edge < rail.edges(); ++edge)
    if (gap[static_cast<std::size_t>(edge)] < closest + lateral_reach) {
      first_edge_ = std::min(first_edge_, edge);
      last_edge_ = edge + 1;
    }
  if (first_edge_ >= last_edge_)
    throw InputError(
        "contact: no middle of a face of the rail lies under the wheel's profile; change "
        "wheel.lateral_offset, widen the wheel (wheel.width), or state a smaller scene.element_size");
  for (double& one : gap) one -= closest;
}

double ContactSearch::touching_depth(double wheel_x) const {
  const RunningSurface& rail = surfaces_.rail_depth();
  const RunningSurface& wheel = surfaces_.wheel_depth();
  if (rail.smooth() && wheel.smooth()) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (int edge = first_edge_; edge < last_edge_; ++edge) {
    const double y = surfaces_.rail_profile().evaluate(edge, 0.5, options_.surface).p;
    least = std::min(least, lateral_gap_[static_cast<std::size_t>(edge)] +
                                traced_depth(rail, wheel, options_.wheel_radius, wheel_x, y));
  }
  return least;
}

void ContactSearch::make_room() {
  const SweptBlock& rail = surfaces_.rail();
  wake_time_ = PageVector<double>(static_cast<std::size_t>(face_index(rail.station_count(), 0)));
  double pitch = 1e30;
  for (const PitchClass& c : rail.classes) pitch = std::min(pitch, c.pitch);
  const SurfaceProfile& wheel = surfaces_.wheel_profile();
  least_radius_ = std::numeric_limits<double>::infinity();
  for (int edge = 0; edge < wheel.edges(); ++edge)
    for (const double end : {0.0, 1.0})
      least_radius_ = std::min(least_radius_, wheel.evaluate(edge, end, options_.surface).q);
  columns_.assign(static_cast<std::size_t>(2 * reach() / pitch) + 3, {});
  for (std::vector<ContactPoint>& column : columns_)
    column.reserve(static_cast<std::size_t>(last_edge_ - first_edge_) * points_per_face());
}

/// A circle of the wheel's radius lies reach_gap and the depth of both surfaces above its lowest point there.
double ContactSearch::reach_within(double deepest) const {
  return std::sqrt(2 * options_.wheel_radius * (options_.reach_gap + deepest));
}

std::optional<ContactSearch::Aim> ContactSearch::aim_at(const BodyFrame& wheel, double dt) const {
  const double half = reach();
  const auto low = surfaces_.rail_stations().find(wheel.origin.x - half);
  const auto high = surfaces_.rail_stations().find(wheel.origin.x + half);
  const double angle = half / options_.wheel_radius;
  if (low.station < 0 || high.station < 0 ||
      surfaces_.wheel_stations().find(-wheel.angle - angle).station < 0 ||
      surfaces_.wheel_stations().find(-wheel.angle + angle).station < 0)
    return std::nullopt;
  Aim aim;
  aim.first_station = low.station;
  aim.last_station = std::min(high.station + 1, low.station + static_cast<int>(columns_.size()));
  const double slope = 1.5 * half / options_.wheel_radius + surfaces_.corrugation().steepest() +
                       surfaces_.rail_depth().steepest();
  // Depths of the wheel pass a place of the rail with the rim, which may spin.
  const double passing = std::abs(wheel.velocity.x - wheel.spin * options_.wheel_radius);
  const double speed = norm(wheel.velocity);
  aim.closing_speed = speed * slope + std::max(speed, passing) * surfaces_.wheel_depth().steepest() + 5;
  aim.margin = aim.closing_speed * dt;
  return aim;
}

void ContactSearch::refuse(const BodyFrame& wheel, bool at_rest) const {
  const std::vector<double>& stations = surfaces_.rail().stations;
  const double wheel_x = wheel.origin.x;
  const bool before = !(wheel_x - reach() >= stations.front());
  if (before || !(wheel_x + reach() <= stations.back())) {
    const char* later = before ? "shorten motion.duration or state a larger rail.origin"
                               : "shorten motion.duration or lengthen rail.length";
    throw NumericalError(
        fmt::format("the wheel at x = {:.4f} m reaches beyond the meshed rail surface ({:.3f} ... {:.3f} "
                    "m), as the patch is searched for within {:.1f} mm; {}",
                    wheel_x, stations.front(), stations.back(), 1e3 * reach(),
                    at_rest ? "state a lower load, lengthen rail.length, or move rail.origin" : later));
  }
  throw NumericalError(fmt::format(
      "the wheel at x = {:.4f} m rolls beyond its tread; lengthen wheel.overhang or leave it out", wheel_x));
}

SearchBounds ContactSearch::bounds(const Aim& aim, double time) const {
  return {0.5 * options_.reach_gap, aim.margin, aim.closing_speed, time};
}

void ContactSearch::visit_column(const Visit& visit, int station) {
  const ContactState& state = *visit.state;
  std::vector<ContactPoint>& column = columns_[static_cast<std::size_t>(station - aim_.first_station)];
  column.clear();
  const SurfacePairBody surfaces = surfaces_.body();
  const bool dynamic = static_cast<bool>(state.velocity);
  for (int edge = first_edge_; edge < last_edge_; ++edge) {
    const std::int64_t face = face_index(station, edge);
    double& wake = wake_time_[static_cast<std::size_t>(face)];
    if (dynamic && visit.bounds.time < wake) continue;
    double smallest = std::numeric_limits<double>::max();
    for (int k = 0; k < quadrature_.size(); ++k) {
      ContactPoint point{};
      point.history = face * quadrature_.size() + k;
      const PointHistory before =
          dynamic ? visit.history[static_cast<std::size_t>(point.history)] : PointHistory{};
      double gap = 0;
      const bool found = find_point(surfaces, state, visit.bounds, {station, edge}, quadrature_.point(k),
                                    before, point, gap);
      smallest = std::min(smallest, gap);
      if (!found) continue;
      if (!dynamic) point.pressure = -options_.penalty * gap;
      column.push_back(point);
    }
    if (dynamic) wake = visit.bounds.wake_time(smallest);
  }
}

void ContactSearch::gather(std::vector<ContactPoint>& points) const {
  points.clear();
  for (int station = aim_.first_station; station < aim_.last_station; ++station) {
    const std::vector<ContactPoint>& column =
        columns_[static_cast<std::size_t>(station - aim_.first_station)];
    points.insert(points.end(), column.begin(), column.end());
  }
}

void ContactSearch::find_static(const ContactState& state, std::vector<ContactPoint>& points) {
  aim(*state.wheel, 0);
  for (int station = aim_.first_station; station < aim_.last_station; ++station)
    visit_column({&state, {}, bounds(aim_, 0)}, station);
  gather(points);
}

void ContactSearch::aim(const BodyFrame& wheel, double dt) {
  const std::optional<Aim> aim = aim_at(wheel, dt);
  if (!aim) refuse(wheel, dt == 0);
  aim_ = *aim;
}

void ContactSearch::find(const ContactState& state, std::span<const PointHistory> history, double time,
                         std::vector<ContactPoint>& points) {
  parallel_ranges(columns(), [&](std::int64_t first, std::int64_t last) {
    visit_columns(state, history, time, static_cast<int>(first), static_cast<int>(last));
  });
  gather(points);
}

void ContactSearch::visit_columns(const ContactState& state, std::span<const PointHistory> history,
                                  double time, int first, int last) {
  const Visit visit{&state, history, bounds(aim_, time)};
  for (int station = aim_.first_station + first; station < aim_.first_station + last; ++station)
    visit_column(visit, station);
}

std::array<SurfacePart, 2> ContactSearch::near(const BodyFrame& wheel, double dt) const {
  constexpr double kRoom = 2e-3;  // for displacements, and the way from a rail point to the closest one [m]
  const SurfaceProfile& rail_profile = surfaces_.rail_profile();
  const SurfaceProfile& wheel_profile = surfaces_.wheel_profile();
  const double way = wheel.velocity.x * dt;
  const double turn = wheel.spin * dt;
  const double x = wheel.origin.x;
  const std::vector<double>& stations = surfaces_.rail().stations;
  const auto face = [&](double at) {
    return index(face_at(surfaces_.rail(), surfaces_.rail_stations(), at));
  };
  const double low = stations[face(x + std::min(way, 0.0) - reach())] - kRoom;
  const double high = stations[face(x + std::max(way, 0.0) + reach()) + 1] + kRoom;
  const double angle = std::max(x - low, high - x) / (0.98 * least_radius_);
  const double least_p = rail_profile.edge_p(first_edge_, 0) - wheel.origin.y - kRoom;
  const double most_p = rail_profile.edge_p(last_edge_ - 1, 1) - wheel.origin.y + kRoom;
  return {part_of(surfaces_.rail(), surfaces_.rail_stations(), rail_profile, {low, high},
                  {first_edge_, last_edge_ - 1}),
          part_of(surfaces_.wheel(), surfaces_.wheel_stations(), wheel_profile,
                  {-wheel.angle - std::max(turn, 0.0) - angle, -wheel.angle - std::min(turn, 0.0) + angle},
                  {wheel_profile.edge_at(least_p), wheel_profile.edge_at(most_p)})};
}

void ContactSearch::wake_all() {
  std::fill(wake_time_.begin(), wake_time_.end(), kEver);
}

SearchEnd ContactSearch::end() const {
  return {0.95 * reach(), quadrature_.place(0), first_edge_, last_edge_, surfaces_.rail_profile().edges()};
}

const ContactPoint* ContactSearch::point_at_the_end(const BodyFrame& wheel,
                                                    const std::vector<ContactPoint>& points) const {
  const SearchEnd bounds = end();
  for (const ContactPoint& point : points) {
    const double across = quadrature_.point(static_cast<int>(point.history % quadrature_.size())).across;
    if (bounds.has(point.face[1], across, point.position.x - wheel.origin.x)) return &point;
  }
  return nullptr;
}

}  // namespace tread
