#include "drivers/engine/rank_patch.hpp"

#include <algorithm>
#include <iterator>

#include "core/index.hpp"
#include "drivers/engine/featured_nodes.hpp"

namespace tread {

template <class Real, class U>
PatchMotion<Real, U>::PatchMotion(const Model& model, const SharedGroups& shared, const HeldGroups& held,
                                  const Ranks& ranks) {
  if (!model.contact) return;
  const GroupMarks surfaces = surface_groups(model);
  const auto add = [&](int other, const HeldGroups& by_receiver) {
    Part& part = parts_.emplace_back();
    part.other = other;
    for (std::int64_t group = 0; group < std::ssize(surfaces); ++group)
      if (surfaces[index(group)] != 0 && by_receiver.moved[index(group)] != 0) part.surface.push_back(group);
  };
  if (ranks.rank() != kContactRank) {
    add(kContactRank, held);
    return;
  }
  for (int rank = 0; rank < ranks.count(); ++rank)
    if (rank != kContactRank) add(rank, shared.held_by(rank));
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
