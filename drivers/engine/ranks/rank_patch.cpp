#include "drivers/engine/ranks/rank_patch.hpp"

#include <algorithm>
#include <iterator>

#include "core/index.hpp"
#include "drivers/engine/fields/featured_nodes.hpp"

namespace tread {

template <class Real, class U>
void PatchMotion<Real, U>::add(int other, const std::vector<std::int64_t>& surfaces,
                               const HeldGroups& receiver) {
  Part& part = parts_.emplace_back();
  part.other = other;
  std::copy_if(surfaces.begin(), surfaces.end(), std::back_inserter(part.surface),
               [&](std::int64_t group) { return receiver.moved[index(group)] != 0; });
}

template <class Real, class U>
void PatchMotion<Real, U>::follow(const std::vector<std::int64_t>& near) {
  segments_.clear();
  for (Part& part : parts_) {
    part.groups.clear();
    std::set_intersection(part.surface.begin(), part.surface.end(), near.begin(), near.end(),
                          std::back_inserter(part.groups));
    if (part.groups.empty()) continue;
    part.u.resize(part.groups.size() * kGroupValues);
    part.v.resize(part.u.size());
    segments_.push_back({part.other, std::as_writable_bytes(std::span(part.u))});
    segments_.push_back({part.other, std::as_writable_bytes(std::span(part.v))});
  }
}

template <class Real, class U>
void PatchMotion<Real, U>::pack(const U* u, const Real* v) {
  for (Part& part : parts_)
    for_groups(part.groups, 0, std::ssize(part.groups), [&](std::int64_t at, std::int64_t place) {
      std::copy_n(u + place, kGroupValues, part.u.data() + at);
      std::copy_n(v + place, kGroupValues, part.v.data() + at);
    });
}

template <class Real, class U>
void PatchMotion<Real, U>::unpack(U* u, Real* v) const {
  for (const Part& part : parts_)
    for_groups(part.groups, 0, std::ssize(part.groups), [&](std::int64_t at, std::int64_t place) {
      std::copy_n(part.u.data() + at, kGroupValues, u + place);
      std::copy_n(part.v.data() + at, kGroupValues, v + place);
    });
}

template class PatchMotion<double, double>;
template class PatchMotion<float, double>;
template class PatchMotion<float, float>;

}  // namespace tread
