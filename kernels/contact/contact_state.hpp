#pragma once
// Motion of the bodies at a contact point.

#include <cstddef>

#include "core/body_frame.hpp"
#include "core/inline.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/contact/contact_point.hpp"

namespace tread {

/// Displacement and velocity fields in local components, and the wheel's frame. A field has at(slot), and is
/// false where there is none.
template <class Displacement, class Velocity>
struct ContactStateOf {
  Displacement displacement;  ///< [m]
  Velocity velocity;          ///< relative to the frame [m/s]; none in statics
  const BodyFrame* wheel;
};
using ContactState = ContactStateOf<ConstNodeField, ConstNodeField>;

/// Velocity of the rail's surface at the point [m/s].
template <class State>
TREAD_BODY Vec3 rail_velocity(const State& state, const ContactPoint& point) {
  Vec3 v;
  for (std::size_t k = 0; k < kSupport; ++k)
    v += point.rail.weight(k) * state.velocity.at(point.rail.slot[k]);
  return v;
}

/// Velocity of the wheel's surface at the point [m/s].
template <class State>
TREAD_BODY Vec3 wheel_velocity(const State& state, const ContactPoint& point) {
  Vec3 v;
  for (std::size_t k = 0; k < kSupport; ++k)
    v += point.wheel.weight(k) * globalise(point.wheel_cosine[k / 4], point.wheel_sine[k / 4],
                                           state.velocity.at(point.wheel.slot[k]));
  const Vec3 arm = point.position - point.gap * point.normal - state.wheel->origin;
  return v + state.wheel->velocity + cross({0, state.wheel->spin, 0}, arm);
}

}  // namespace tread
