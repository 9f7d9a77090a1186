#include "kernels/contact/contact.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <type_traits>
#include <utility>
#include <variant>

#include "core/contract.hpp"
#include "core/error.hpp"
#include "kernels/contact/patch_point_body.hpp"

namespace tread {

namespace {

const SweptBlock& block(const Mesh& mesh, int index) {
  return mesh.blocks[static_cast<std::size_t>(index)];
}

Friction friction_of(const FrictionLaw& law) {
  return std::visit(
      [](const auto& stated) -> Friction { return FrictionOf<std::decay_t<decltype(stated)>>{stated}; }, law);
}

/// The law's states by integration point, as plain doubles.
template <class Law>
void list_states(FrictionOf<Law>& friction, StateList& list) {
  if constexpr (FrictionOf<Law>::kHasState) list.add_records("friction", std::span(friction.state));
}

}  // namespace

Contact::Contact(const Mesh& mesh, const ContactOptions& options, Corrugation corrugation)
    : options_(options),
      slots_(mesh.slots),
      springs_{options.penalty, {options.penalty}},
      friction_(friction_of(options.friction)),
      search_(block(mesh, options.rail_block), block(mesh, options.wheel_block),
              {options.surface, options.straight_across ? SurfaceKind::facets : options.surface,
               options.points, options.penalty, options.wheel_radius, options.depth_room, options.reach_gap,
               options.rail_depth, options.wheel_depth},
              std::move(corrugation)),
      area_(search_) {
  TREAD_EXPECT(options.penalty > 0 && std::isfinite(options.penalty));
  TREAD_EXPECT(options.points > 0 && options.wheel_radius > 0 && options.depth_room >= 0);
  make_room();
}

void Contact::set_corrugation(Corrugation corrugation) {
  search_.set_corrugation(std::move(corrugation));
  totals_ = {};
  frictional_work_ = contact_loss_ = 0;
  make_room();
}

void Contact::make_room() {
  history_ = PageVector<PointHistory>(search_.rail_points());
  std::visit(
      [this](auto& of) {
        if constexpr (std::decay_t<decltype(of)>::kHasState) of.state.assign(history_.size(), {});
      },
      friction_);
  points_.clear();
  points_.reserve(search_.capacity());
  const auto [first_edge, last_edge] = search_.edges();
  solver_.reserve(slots_, points_.capacity(),
                  4 * (search_.window_capacity() + 4) * static_cast<std::size_t>(last_edge - first_edge + 4));
  const SurfacePair& surfaces = search_.surfaces();
  nodes_ = PatchNodes(
      make_surface_grid(surfaces.rail(), surfaces.rail_profile(), options_.surface, search_.edges()),
      static_cast<int>(search_.window_capacity()) + 1);
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

void Contact::find_static(const ContactState& state, double traction) {
  search_.find_static(state, points_);
  if (traction != 0)
    for (ContactPoint& point : points_) point.shear.along = -traction * point.pressure;
  const ContactSearch::Aim& aim = search_.aimed();
  nodes_.average(aim.first_station, aim.last_station, points_);
  totals_ = sum_up(points_, springs_, area_);
}

void Contact::begin() {
  history_ = PageVector<PointHistory>(history_.size());
  std::visit([](auto& of) { of.state.assign(of.state.size(), {}); }, friction_);
  search_.wake_all();
  frictional_work_ = contact_loss_ = 0;
  for (const ContactPoint& point : points_)
    history_[static_cast<std::size_t>(point.history)] = {point.shear, point.pressure};
}

double Contact::friction_at_rest(double x) const {
  Sliding resting;
  resting.x = x;
  return std::visit(
      [&](const auto& of) {
        typename std::remove_cvref_t<decltype(of.law)>::State fresh{};
        return of.law.advance(fresh, resting);
      },
      friction_);
}

void Contact::search(const ContactState& state, double time, double dt) {
  TREAD_EXPECT(dt > 0 && std::isfinite(time));
  aim(*state.wheel, dt);
  if (steps_ != nullptr)
    steps_->search(*state.wheel, time, dt);
  else
    search_.find(state, history_, time, points_);
}

void Contact::require_room(const BodyFrame& wheel) const {
  const ContactPoint* point = point_at_the_end(wheel);
  if (!point) return;
  throw NumericalError(fmt::format(
      "contact: the patch reaches {:.2f} mm ahead of the wheel and {:.2f} mm aside, the end of the "
      "surface that is searched (within {:.2f} mm along the rail); {}; a wheel's edge on the rail "
      "is such an end too: widen the wheel",
      1e3 * (point->position.x - wheel.origin.x), 1e3 * point->position.y, 1e3 * reach(), why_no_room()));
}

std::string Contact::why_no_room() const {
  constexpr double kClearly = 1.2;  // rolling on a smooth rail adds less
  const double force = norm(totals_.force_on_rail);
  const std::string measured = fmt::format("the contact force of {:.4g} kN", 1e-3 * force);
  if (force > kClearly * options_.static_force)
    return fmt::format(
        "{} is beyond what the wheel load of {:.4g} kN lets expect; raise the load that the scene states, or "
        "lower speed or corrugation depth",
        measured, 1e-3 * options_.static_force);
  return fmt::format(
      "{}, at a wheel load of {:.4g} kN, is no reason for that: the surfaces touch over more of their "
      "length or width than elastic bodies of such radii would; look after the profiles, "
      "wheel.crown_radius and rail.crown_radius; on a coarse mesh a smaller scene.element_size or "
      "contact.surface = \"exact\" helps{}",
      measured, 1e-3 * options_.static_force,
      options_.yields ? "; a small yield_stress of the material flattens a surface" : "");
}

void Contact::require_settled() const {
  if (settled()) return;
  throw NumericalError(fmt::format(
      "contact: the tractions of the patch do not settle: in the last of {} iterations one still changes by "
      "{:.2g} of the largest pressure, {:.0e} at most is taken; a larger contact.penetration_ratio (softer "
      "penalty), a smaller coefficient of friction or a smaller motion.step_safety helps",
      kMostIterations, unsettled_, kUnsettled));
}

void Contact::resolve(const NodeMotion& motion, const BodyFrame& wheel, double dt) {
  TREAD_EXPECT(dt > 0 && std::isfinite(dt));
  if (steps_ != nullptr) {
    steps_->resolve();
    return;
  }
  solver_.solve(points_, springs_, friction_, wheel, motion, dt);
  unsettled_ = solver_.unsettled();
  for (ContactPoint& point : points_) {
    PointHistory& history = history_[static_cast<std::size_t>(point.history)];
    const PointWork work = settle_history(point, history, springs_, dt);
    frictional_work_ += work.frictional;
    contact_loss_ += work.lost;
  }
  close_step();
}

void Contact::take(const ContactOutcome& outcome) {
  frictional_work_ += outcome.frictional_work;
  contact_loss_ += outcome.contact_loss;
  unsettled_ = outcome.unsettled;
  points_.clear();
  totals_ = {};
  totals_.force_on_rail = outcome.force_on_rail;
}

void Contact::take_points(std::span<const ContactPoint> points) {
  points_.assign(points.begin(), points.end());
  close_step();
}

void Contact::take_points(std::span<const ContactPoint> points, double frictional_work, double contact_loss) {
  frictional_work_ = frictional_work;
  contact_loss_ = contact_loss;
  take_points(points);
}

/// Averages and sums of the points that a step has solved; those that it opened leave.
void Contact::close_step() {
  const ContactSearch::Aim& aim = search_.aimed();
  nodes_.average(aim.first_station, aim.last_station, points_);
  std::erase_if(points_, [](const ContactPoint& point) { return point.pressure <= 0; });
  totals_ = sum_up(points_, springs_, area_);
}

void Contact::add_forces(NodeField force) const {
  for (const ContactPoint& point : points_) {
    const Vec3 load = point.area * point.traction();
    std::array<Vec3, 4> local{};
    for (std::size_t i = 0; i < 4; ++i) local[i] = localise(point.wheel_cosine[i], point.wheel_sine[i], load);
    for (std::size_t k = 0; k < kSupport; ++k) {
      force.add(point.rail.slot[k], -point.rail.weight(k) * load);
      force.add(point.wheel.slot[k], point.wheel.weight(k) * local[k / 4]);
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
        weights[dof(point.rail.slot[k], c)] += point.rail.weight(k) * point.normal[c];
        weights[dof(point.wheel.slot[k], c)] -= point.wheel.weight(k) * wheel_normal[c];
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

void Contact::list_state(StateList& list) {
  list_searched(list);
  list.add("frictional_work", frictional_work_);
  list.add("contact_loss", contact_loss_);
}

void Contact::list_searched(StateList& list) {
  list.add_records("history", std::span(history_));
  list.add("wake_time", std::span(search_.wake_time()));
  std::visit([&](auto& of) { list_states(of, list); }, friction_);
}

std::int64_t Contact::bytes() const {
  const std::size_t states =
      std::visit([](const auto& of) { return of.state.size() * sizeof(of.state[0]); }, friction_);
  return solver_.bytes() + nodes_.bytes() + search_.bytes() +
         static_cast<std::int64_t>(history_.size() * sizeof(PointHistory) + states);
}

}  // namespace tread
