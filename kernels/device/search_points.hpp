#pragma once
// Search of a step on a device, and copies of what it found.

#include <array>
#include <cstdint>
#include <cstring>

#include "kernels/contact/contact_state.hpp"
#include "kernels/contact/patch_point_body.hpp"
#include "kernels/device/contact_layout.hpp"

namespace tread {

/// A field whose type is known: where it is chosen at every node, the loads of many nodes wait for each
/// other.
template <class Value>
struct TypedNodeField {
  const Value* values;

  TREAD_BODY explicit operator bool() const { return values != nullptr; }
  TREAD_BODY Vec3 at(std::int64_t slot) const {
    const Value* const first = values + dof(slot, 0);
    return {first[0], first[kLanes], first[2 * kLanes]};
  }
};

/// Search of a step: a candidate a thread.
template <class U, class V>
struct SearchPoints {
  ContactTask task;
  TypedNodeField<U> u;
  TypedNodeField<V> v;

  std::int64_t count() const { return task.window.count(); }
  TREAD_BODY void operator()(std::int64_t i) const {
    const FaceWindow& window = task.window;
    const auto of_window = static_cast<int>(i / window.points);
    const auto k = static_cast<int>(i % window.points);
    const std::int64_t face = window.face(of_window);
    task.candidates.kept[i] = 0;
    if (task.bounds.time < task.wake_time[face]) return;
    const ContactStateOf<TypedNodeField<U>, TypedNodeField<V>> state{u, v, &task.wheel};
    ContactPoint point{};
    point.history = face * window.points + k;
    double gap = 0;
    const std::array<int, 2> at = {window.first_station + of_window / window.edges,
                                   window.first_edge + of_window % window.edges};
    const bool found = find_point(task.surfaces, state, task.bounds, at, task.quadrature[k],
                                  task.history[point.history], point, gap);
    task.candidates.gap[i] = gap;
    if (!found || stays_open(point, kSpareClosing, task.dt)) return;
    task.candidates.kept[i] = 1;
    task.candidates.point[i] = point;
  }
};

/// Copies the points of the patch together: a word a thread.
struct GatherPoints {
  PatchPoints from;
  ContactPoint* to;
  int points;

  using Word = std::uint64_t;
  static constexpr std::int64_t kWords = sizeof(ContactPoint) / sizeof(Word);
  static_assert(kWords * sizeof(Word) == sizeof(ContactPoint));

  std::int64_t count() const { return points * kWords; }
  TREAD_BODY void operator()(std::int64_t i) const {
    const std::int64_t of_word = i % kWords * static_cast<std::int64_t>(sizeof(Word));
    const char* const source = reinterpret_cast<const char*>(&from[static_cast<int>(i / kWords)]);
    std::memcpy(reinterpret_cast<char*>(to + i / kWords) + of_word, source + of_word, sizeof(Word));
  }
};

}  // namespace tread
