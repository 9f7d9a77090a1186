#include "kernels/contact/contact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"

namespace tread {

namespace {

/// Points and weights of Gauss on [0, 1].
std::vector<std::array<double, 2>> gauss(int points) {
  switch (points) {
    case 1:
      return {{0.5, 1.0}};
    case 2: {
      const double a = 0.5 / std::sqrt(3.0);
      return {{0.5 - a, 0.5}, {0.5 + a, 0.5}};
    }
    case 3: {
      const double a = 0.5 * std::sqrt(0.6);
      return {{0.5 - a, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + a, 5.0 / 18}};
    }
    case 4: {
      const double a = 0.5 * std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
      const double b = 0.5 * std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
      const double wa = (18 + std::sqrt(30.0)) / 72;
      const double wb = (18 - std::sqrt(30.0)) / 72;
      return {{0.5 - b, wb}, {0.5 - a, wa}, {0.5 + a, wa}, {0.5 + b, wb}};
    }
    default:
      throw InputError(
          fmt::format("contact.points = {}: 1 to 4 integration points per direction are available", points));
  }
}

/// Shares of both ends of a line in a point on it, at in [0, 1]: all for the nearer one.
std::array<double, 2> nearer_end(double at) {
  if (std::abs(at - 0.5) < 1e-9) return {0.5, 0.5};
  return at < 0.5 ? std::array{1.0, 0.0} : std::array{0.0, 1.0};
}

/// Tangents of the point and the bases of the wheel's nodes about it.
void set_bases(ContactPoint& point) {
  for (std::size_t i = 0; i < 4; ++i) {
    point.wheel_cosine[i] = std::cos(point.wheel_angle[i]);
    point.wheel_sine[i] = std::sin(point.wheel_angle[i]);
  }
  const Vec3 ahead{1, 0, 0};
  const Vec3 along = ahead - dot(ahead, point.normal) * point.normal;
  point.along = (1 / norm(along)) * along;
  point.across = cross(point.along, point.normal);
}

}  // namespace

Contact::Contact(const Mesh& mesh, const ContactOptions& options, Corrugation corrugation)
    : rail_(&mesh.blocks[static_cast<std::size_t>(options.rail_block)]),
      wheel_(&mesh.blocks[static_cast<std::size_t>(options.wheel_block)]),
      options_(options),
      corrugation_(std::move(corrugation)),
      rail_profile_(rail_->section),
      wheel_profile_(wheel_->section),
      rail_stations_(*rail_),
      wheel_stations_(*wheel_),
      friction_{options.friction, options.penalty},
      points_per_face_(options.points * options.points),
      deepest_(std::max(options.depth_room, corrugation_.deepest())) {
  gauss_ = gauss(options.points);
  for (const auto& along : gauss_)
    for (const auto& across : gauss_) quadrature_.push_back({along[0], across[0], along[1] * across[1]});
  double arc = 0;
  for (int edge = 0; edge < rail_profile_.edges(); ++edge) {
    const auto middle = rail_profile_.evaluate(edge, 0.5, options_.surface);
    const double width = std::hypot(middle.dp, middle.dq);
    for (const auto& at : gauss_) across_.push_back(arc + at[0] * width);
    arc += width;
  }
  width_ = arc;

  // Edges of the rail that lie within reach of the wheel's undeformed profile lowered to touch.
  double closest = 1e30;
  std::vector<double> gap(static_cast<std::size_t>(rail_profile_.edges()), 1e30);
  for (int edge = 0; edge < rail_profile_.edges(); ++edge) {
    const auto at = rail_profile_.evaluate(edge, 0.5, options_.surface);
    if (at.p <= wheel_profile_.first_p() || at.p >= wheel_profile_.last_p()) continue;
    const int over = wheel_profile_.edge_at(at.p);
    const double p0 = wheel_profile_.edge_p(over, 0);
    const double eta = (at.p - p0) / (wheel_profile_.edge_p(over, 1) - p0);
    gap[static_cast<std::size_t>(edge)] = -at.q - wheel_profile_.evaluate(over, eta, options_.surface).q;
    closest = std::min(closest, gap[static_cast<std::size_t>(edge)]);
  }
  touching_height_ = -closest;
  const double lateral_reach = 1.5 * options_.reach_gap + deepest_;
  first_edge_ = rail_profile_.edges();
  for (int edge = 0; edge < rail_profile_.edges(); ++edge)
    if (gap[static_cast<std::size_t>(edge)] < closest + lateral_reach) {
      first_edge_ = std::min(first_edge_, edge);
      last_edge_ = edge + 1;
    }
  if (first_edge_ >= last_edge_)
    throw InputError("contact: the wheel's profile does not lie over the rail's");

  const auto faces = static_cast<std::size_t>(face_index(rail_->station_count(), 0));
  history_.resize(faces * quadrature_.size());
  wake_time_.assign(faces, -std::numeric_limits<double>::infinity());
  const double window = 2 * reach();
  double pitch = 1e30;
  for (const PitchClass& c : rail_->classes) pitch = std::min(pitch, c.pitch);
  columns_.resize(static_cast<std::size_t>(window / pitch) + 3);
  const auto capacity = static_cast<std::size_t>(last_edge_ - first_edge_) * quadrature_.size();
  for (std::vector<ContactPoint>& column : columns_) column.reserve(capacity);
  points_.reserve(capacity * columns_.size());
  solver_.reserve(mesh.slots, points_.capacity(),
                  4 * (columns_.size() + 4) * static_cast<std::size_t>(last_edge_ - first_edge_ + 4));
  nodes_ = PatchNodes(make_surface_grid(*rail_, rail_profile_, options_.surface, {first_edge_, last_edge_}),
                      static_cast<int>(columns_.size()) + 1);
}

/// A circle of the wheel's radius lies reach_gap and the corrugation's depth above its lowest point there.
double Contact::reach() const {
  return std::sqrt(2 * options_.wheel_radius * (options_.reach_gap + deepest_));
}

void Contact::update_window(const BodyFrame& wheel) {
  const double wheel_x = wheel.origin.x;
  const double half = reach();
  const auto low = rail_stations_.find(wheel_x - half);
  const auto high = rail_stations_.find(wheel_x + half);
  if (low.station < 0 || high.station < 0)
    throw NumericalError(
        fmt::format("the wheel at x = {:.4f} m reaches beyond the meshed rail surface ({:.3f} ... {:.3f} "
                    "m); shorten motion.duration or lengthen rail.length",
                    wheel_x, rail_->stations.front(), rail_->stations.back()));
  const double angle = half / options_.wheel_radius;
  if (wheel_stations_.find(-wheel.angle - angle).station < 0 ||
      wheel_stations_.find(-wheel.angle + angle).station < 0)
    throw NumericalError(fmt::format(
        "the wheel at x = {:.4f} m rolls beyond its tread; lengthen wheel.overhang or leave it out",
        wheel_x));
  window_first_ = low.station;
  window_last_ = std::min(high.station + 1, window_first_ + static_cast<int>(columns_.size()));
}

double Contact::probe(const ContactState& state, const Candidate& where, ContactPoint& point) const {
  const auto& [along, across, weight] = quadrature_[static_cast<std::size_t>(where.point)];
  const ConstNodeField u = state.displacement;
  const bool exact = options_.surface == SurfaceKind::exact;

  // The rail point.
  const auto profile = rail_profile_.evaluate(where.edge, across, options_.surface);
  const LineCell rail_cell = station_cell(*rail_, where.station);
  const LineWeights rail_along = line_weights(rail_cell, along, options_.surface);
  const LineWeights rail_across = line_weights(rail_profile_.cell(where.edge), across, options_.surface);
  Vec3 x{rail_->stations[static_cast<std::size_t>(where.station)] + along * rail_cell.length, profile.p,
         profile.q};
  double depth = exact ? corrugation_.depth(x.x, x.y) : 0.0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t k = 4 * i + j;
      const int node = rail_profile_.node(rail_across.ordinal[j]);
      const int station = rail_along.ordinal[i];
      point.rail_slot[k] = rail_->base + rail_->slot(node, station);
      point.rail_weight[k] = rail_along.value[i] * rail_across.value[j];
      x += point.rail_weight[k] * u.at(point.rail_slot[k]);
      if (!exact)
        depth += point.rail_weight[k] * corrugation_.depth(rail_->stations[static_cast<std::size_t>(station)],
                                                           rail_->section.p[static_cast<std::size_t>(node)]);
    }
  x.z -= depth;
  point.position = x;
  point.face = {where.station, where.edge};
  const auto [here, ahead] = nearer_end(along);
  const auto [left, right] = nearer_end(across);
  point.face_share = {here * left, here * right, ahead * left, ahead * right};
  point.area = weight * rail_cell.length * std::hypot(profile.dp, profile.dq);

  // The wheel point whose deformed position is closest.
  const Vec3 d = x - state.wheel->origin;
  double phi = std::atan2(-d.x, -d.z);
  int edge = wheel_profile_.edge_at(d.y);
  double eta = (d.y - wheel_profile_.edge_p(edge, 0)) /
               (wheel_profile_.edge_p(edge, 1) - wheel_profile_.edge_p(edge, 0));
  double gap = std::numeric_limits<double>::max();
  constexpr int kMaxIterations = 6;
  for (int iteration = 1;; ++iteration) {
    if (!(eta >= -0.5 && eta <= 1.5))
      return std::numeric_limits<double>::max();  // beyond the wheel's surface
    const auto cell = wheel_stations_.find(phi - state.wheel->angle);
    if (cell.station < 0) return std::numeric_limits<double>::max();  // beyond a part of a ring
    const LineCell line = station_cell(*wheel_, cell.station);
    const LineWeights around = line_weights(line, cell.distance / cell.pitch, options_.surface);
    const LineWeights over = line_weights(wheel_profile_.cell(edge), eta, options_.surface);
    const std::array<double, 4> turned = {cell.distance + line.length_before, cell.distance,
                                          cell.distance - cell.pitch,
                                          cell.distance - cell.pitch - line.length_after};
    const auto p = wheel_profile_.evaluate(edge, eta, options_.surface);
    Vec3 surface = exact ? Vec3{0, p.p, p.q} : Vec3{};
    Vec3 side;
    Vec3 across_tangent = exact ? Vec3{0, p.dp, p.dq} : Vec3{};
    for (std::size_t i = 0; i < 4; ++i) {
      Vec3 value;
      Vec3 slope;
      for (std::size_t j = 0; j < 4; ++j) {
        const int node = wheel_profile_.node(over.ordinal[j]);
        const std::size_t k = 4 * i + j;
        point.wheel_slot[k] = wheel_->base + wheel_->slot(node, around.ordinal[i]);
        point.wheel_weight[k] = around.value[i] * over.value[j];
        Vec3 nodal = u.at(point.wheel_slot[k]);
        if (!exact)
          nodal += {0, wheel_->section.p[static_cast<std::size_t>(node)],
                    wheel_->section.q[static_cast<std::size_t>(node)]};
        value += over.value[j] * nodal;
        slope += over.slope[j] * nodal;
      }
      value = turn(value, -turned[i]);
      surface += around.value[i] * value;
      side += around.slope[i] * value;
      across_tangent += around.value[i] * turn(slope, -turned[i]);
      // Not by phi, so that all points of a station have the same bits.
      point.wheel_angle[i] =
          state.wheel->angle + wheel_->stations[static_cast<std::size_t>(around.ordinal[i])];
    }

    const Vec3 e = cartesian_to_cylindrical(phi, d) - surface;
    const double shift = (e.y * p.dp + e.z * p.dq) / (p.dp * p.dp + p.dq * p.dq);
    const Vec3 along_tangent = exact ? Vec3{1, 0, 0} + (1 / (p.q * cell.pitch)) * side : side;
    const Vec3 normal = cross(along_tangent, across_tangent);
    const double size = norm(normal);
    gap = dot(e, normal) / size;
    point.normal = cylindrical_to_cartesian(phi, (1 / size) * normal);
    if (std::abs(e.x) < 1e-9 && std::abs(shift) < 1e-7) break;
    if (gap > 0.5 * options_.reach_gap || iteration == kMaxIterations)
      break;  // far away: no need for more digits
    phi += e.x / p.q;
    eta += shift;
    if (eta < 0 || eta > 1) {
      const double target = p.p + shift * p.dp;
      edge = wheel_profile_.edge_at(target);
      eta = (target - wheel_profile_.edge_p(edge, 0)) /
            (wheel_profile_.edge_p(edge, 1) - wheel_profile_.edge_p(edge, 0));
    }
  }
  point.gap = gap;
  return gap;
}

Vec3 Contact::rail_velocity(const ContactState& state, const ContactPoint& point) const {
  Vec3 v;
  for (std::size_t k = 0; k < kSupport; ++k)
    v += point.rail_weight[k] * state.velocity.at(point.rail_slot[k]);
  return v;
}

Vec3 Contact::wheel_velocity(const ContactState& state, const ContactPoint& point) const {
  Vec3 v;
  for (std::size_t k = 0; k < kSupport; ++k)
    v += point.wheel_weight[k] * globalise(point.wheel_cosine[k / 4], point.wheel_sine[k / 4],
                                           state.velocity.at(point.wheel_slot[k]));
  const Vec3 arm = point.position - point.gap * point.normal - state.wheel->origin;
  return v + state.wheel->velocity + cross({0, state.wheel->spin, 0}, arm);
}

Vec3 Contact::mean_slip_velocity(const ContactState& state) const {
  Vec3 sum;
  double weight = 0;
  for (const ContactPoint& point : points_) {
    const double load = point.area * point.pressure;
    sum += load * (wheel_velocity(state, point) - rail_velocity(state, point));
    weight += load;
  }
  return weight > 0 ? (1 / weight) * sum : Vec3{};
}

void Contact::visit_column(const ContactState& state, int station, double time) {
  std::vector<ContactPoint>& column = columns_[static_cast<std::size_t>(station - window_first_)];
  column.clear();
  const bool dynamic = static_cast<bool>(state.velocity);
  for (int edge = first_edge_; edge < last_edge_; ++edge) {
    double& wake = wake_time_[static_cast<std::size_t>(face_index(station, edge))];
    if (dynamic && time < wake) continue;
    double smallest = std::numeric_limits<double>::max();
    for (int k = 0; k < points_per_face_; ++k) {
      ContactPoint point{};
      const double gap = probe(state, {station, edge, k}, point);
      smallest = std::min(smallest, gap);
      point.history = face_index(station, edge) * points_per_face_ + k;
      const History& history = history_[static_cast<std::size_t>(point.history)];
      // A point that carried pressure stays until a step in which it carries none has released its energy.
      if (gap >= margin_ && !(dynamic && history.pressure > 0)) continue;
      set_bases(point);
      if (dynamic) {
        point.shear_before = history.shear;
        point.velocity_before = wheel_velocity(state, point) - rail_velocity(state, point);
      } else {
        point.pressure = -options_.penalty * gap;
      }
      column.push_back(point);
    }
    if (dynamic) wake = smallest > margin_ ? time + (smallest - margin_) / closing_speed_ : time;
  }
}

void Contact::gather_columns() {
  points_.clear();
  for (int station = window_first_; station < window_last_; ++station) {
    const std::vector<ContactPoint>& column = columns_[static_cast<std::size_t>(station - window_first_)];
    points_.insert(points_.end(), column.begin(), column.end());
  }
}

void Contact::sum_up() {
  totals_ = {};
  double load = 0;
  for (const ContactPoint& point : points_) {
    totals_.force_on_rail += point.area * point.traction();
    totals_.area += point.area;
    if (point.slips) totals_.slip_area += point.area;
    load += point.area * point.pressure;
    totals_.centre += point.area * point.pressure * point.position;
    if (point.pressure > totals_.max_pressure) {
      totals_.max_pressure = point.pressure;
      totals_.pressure_peak = point.position;
    }
    totals_.max_shear = std::max(totals_.max_shear, std::hypot(point.shear.along, point.shear.across));
    totals_.max_penetration = std::max(totals_.max_penetration, point.pressure / options_.penalty);
    totals_.penalty_energy += point.area * stored_energy(point.pressure, point.shear);
  }
  if (load <= 0) return;
  totals_.centre = (1 / load) * totals_.centre;
  const double area = area_by_rows();
  totals_.slip_area *= area / totals_.area;
  totals_.area = area;
}

/// Counting points would make the area jump by whole points. Along a row of points across the rail the patch
/// ends where the penetration, linear at its border, falls to zero, at the latest at the next point.
double Contact::area_by_rows() const {
  const int per_line = options_.points;
  const auto place = [&](const ContactPoint& point) {
    return point.face[1] * per_line + static_cast<int>(point.history % per_line);
  };
  const auto s = [&](int n) {
    // Mirrored at the ends of the surface: the outermost points stand for what lies up to them.
    if (n < 0) return -across_.front();
    if (n >= static_cast<int>(across_.size())) return 2 * width_ - across_.back();
    return across_[static_cast<std::size_t>(n)];
  };
  // Where the stretch that a point stands for ends, towards the place `step` away; null: no point there, or
  // none on the other side.
  const auto border = [&](const ContactPoint& point, int step, const ContactPoint* there,
                          const ContactPoint* opposite) {
    const int n = place(point);
    const double half_way = 0.5 * (s(n) + s(n + step));
    if (there || !opposite || opposite->pressure <= point.pressure) return half_way;
    const double reached =
        s(n) + (s(n) - s(n - step)) * point.pressure / (opposite->pressure - point.pressure);
    return std::clamp(reached, std::max(0.0, s(n - 1)), std::min(width_, s(n + 1)));
  };
  double area = 0;
  std::size_t first = 0;
  while (first < points_.size()) {
    const int station = points_[first].face[0];
    std::size_t last = first;
    while (last < points_.size() && points_[last].face[0] == station) ++last;
    const double length = rail_->pitch(station);
    for (int line = 0; line < per_line; ++line) {
      const double thickness = length * gauss_[static_cast<std::size_t>(line)][1];
      const ContactPoint* before = nullptr;  // the neighbours of `point` in contact
      const ContactPoint* point = nullptr;
      const auto pass = [&](const ContactPoint* next) {
        const bool joined = point && next && place(*next) == place(*point) + 1;
        if (point)
          area += thickness * (border(*point, 1, joined ? next : nullptr, before) -
                               border(*point, -1, before, joined ? next : nullptr));
        before = joined ? point : nullptr;
        point = next;
      };
      for (std::size_t i = first; i < last; ++i)
        if (points_[i].history / per_line % per_line == line) pass(&points_[i]);
      pass(nullptr);
    }
    first = last;
  }
  return area;
}

void Contact::find_static(const ContactState& state) {
  margin_ = 0;
  update_window(*state.wheel);
  for (int station = window_first_; station < window_last_; ++station) visit_column(state, station, 0);
  gather_columns();
  nodes_.average(window_first_, window_last_, points_);
  sum_up();
}

void Contact::begin() {
  std::fill(history_.begin(), history_.end(), History{});
  std::fill(wake_time_.begin(), wake_time_.end(), -std::numeric_limits<double>::infinity());
  frictional_work_ = damping_work_ = 0;
  for (const ContactPoint& point : points_)
    history_[static_cast<std::size_t>(point.history)].pressure = point.pressure;
}

void Contact::search(const ContactState& state, double time, double dt) {
  update_window(*state.wheel);
  const double half = reach();
  const double slope = 1.5 * half / options_.wheel_radius + corrugation_.steepest();
  closing_speed_ = norm(state.wheel->velocity) * slope + 5;
  margin_ = closing_speed_ * dt;
  parallel_ranges(window_last_ - window_first_, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
      visit_column(state, window_first_ + static_cast<int>(i), time);
  });
  gather_columns();
}

const ContactPoint* Contact::point_at_the_end(const BodyFrame& wheel) const {
  const double room = 0.95 * reach();
  const double outermost = gauss_.front()[0];  // of a face, from its side
  for (const ContactPoint& point : points_) {
    const int edge = point.face[1];
    const double across = quadrature_[static_cast<std::size_t>(point.history % points_per_face_)][1];
    const bool beside =
        (first_edge_ > 0 && edge == first_edge_ && across <= outermost) ||
        (last_edge_ < rail_profile_.edges() && edge == last_edge_ - 1 && across >= 1 - outermost);
    if (beside || std::abs(point.position.x - wheel.origin.x) >= room) return &point;
  }
  return nullptr;
}

void Contact::require_room(const BodyFrame& wheel) const {
  const ContactPoint* point = point_at_the_end(wheel);
  if (!point) return;
  throw NumericalError(fmt::format(
      "contact: the patch reaches {:.2f} mm ahead of the wheel and {:.2f} mm aside, the end of the surface "
      "that "
      "is searched (within {:.2f} mm along the rail); the contact force of {:.4g} kN is beyond what "
      "the wheel load lets expect; raise the load that the scene states, or lower speed or corrugation "
      "depth",
      1e3 * (point->position.x - wheel.origin.x), 1e3 * point->position.y, 1e3 * reach(),
      1e-3 * norm(totals_.force_on_rail)));
}

void Contact::resolve(const NodeMotion& motion, const BodyFrame& wheel, double dt) {
  solver_.solve(points_, options_.penalty, friction_, wheel, motion, dt);
  for (ContactPoint& point : points_) {
    History& history = history_[static_cast<std::size_t>(point.history)];
    const Traction slip{dt * point.slip_speed.along, dt * point.slip_speed.across};
    point.frictional_work = friction_.dissipation(history.shear, point.shear, slip);
    // What the forces took from the bodies since the step before, less what was stored and rubbed away.
    const double work = dt * point.pressure * point.closing_speed + point.shear.along * slip.along +
                        point.shear.across * slip.across;
    const double stored =
        stored_energy(point.pressure, point.shear) - stored_energy(history.pressure, history.shear);
    frictional_work_ += point.area * point.frictional_work;
    damping_work_ += point.area * (work - stored - point.frictional_work);
    history = {point.shear, point.pressure};
  }
  nodes_.average(window_first_, window_last_, points_);
  std::erase_if(points_, [](const ContactPoint& point) { return point.pressure <= 0; });
  sum_up();
}

double Contact::stored_energy(double pressure, const Traction& shear) const {
  return 0.5 * pressure * pressure / options_.penalty + friction_.stored(shear);
}

void Contact::add_forces(NodeField force) const {
  for (const ContactPoint& point : points_) {
    const Vec3 load = point.area * point.traction();
    std::array<Vec3, 4> local{};
    for (std::size_t i = 0; i < 4; ++i) local[i] = localise(point.wheel_cosine[i], point.wheel_sine[i], load);
    for (std::size_t k = 0; k < kSupport; ++k) {
      force.add(point.rail_slot[k], -point.rail_weight[k] * load);
      force.add(point.wheel_slot[k], point.wheel_weight[k] * local[k / 4]);
    }
  }
}

std::vector<Spring> Contact::springs() const {
  std::vector<Spring> springs;
  for (const ContactPoint& point : points_) {
    std::map<std::int64_t, double> weights;  // a node at a surface's end may stand twice
    for (std::size_t k = 0; k < kSupport; ++k) {
      const Vec3 wheel_normal = localise(point.wheel_cosine[k / 4], point.wheel_sine[k / 4], point.normal);
      for (int c = 0; c < 3; ++c) {
        weights[dof(point.rail_slot[k], c)] += point.rail_weight[k] * point.normal[c];
        weights[dof(point.wheel_slot[k], c)] -= point.wheel_weight[k] * wheel_normal[c];
      }
    }
    Spring spring;
    spring.stiffness = options_.penalty * point.area;
    for (const auto& [unknown, weight] : weights) {
      spring.dofs.push_back(unknown);
      spring.weights.push_back(weight);
    }
    springs.push_back(std::move(spring));
  }
  return springs;
}

std::int64_t Contact::bytes() const {
  return solver_.bytes() + nodes_.bytes() +
         static_cast<std::int64_t>(history_.size() * sizeof(history_[0]) +
                                   wake_time_.size() * sizeof(wake_time_[0]));
}

}  // namespace tread
