#include "drivers/engine/ranks/rank_forces.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace tread {

RankMessage::RankMessage(const RankCut& all, int sender, int receiver, const GroupMarks& forced,
                         Content of_it)
    : cut(&all), from(sender), to(receiver), content(of_it) {
  for (const TileStretch& stretch : cut->stretches(from))
    for (std::int64_t group = cut->first_group(stretch.first); group < cut->first_group(stretch.last);
         ++group)
      if (forced[index(group)] != 0) always.push_back(group);
  for (const Joint& joint : cut->joints()) {
    const auto marks = forced.begin() + joint.slot / kLanes;
    if (joint.near == from) parts.push_back({&joint, true, {}, {marks, marks + joint.nodes}});
    if (joint.far == from && joint.near == to) parts.push_back({&joint, false, {}, {}});
  }
}

void RankMessage::follow(const std::vector<std::int64_t>& patch) {
  const auto of_patch = [&](std::int64_t group) {
    return to == kContactRank && std::binary_search(patch.begin(), patch.end(), group);
  };
  groups.clear();
  if (content == Content::rest)
    std::copy_if(always.begin(), always.end(), std::back_inserter(groups),
                 [&](std::int64_t group) { return !of_patch(group); });
  else
    std::copy_if(patch.begin(), patch.end(), std::back_inserter(groups),
                 [&](std::int64_t group) { return to == kContactRank && cut->owner(group) == from; });
  count = std::ssize(groups) * kGroupValues;
  for (JointPart& part : parts) {
    const bool neighbours = part.joint->far == to || part.joint->near == to;
    part.values.clear();
    for (std::int64_t node = 0; node < part.joint->nodes; ++node) {
      const bool about_it = of_patch(part.joint->slot / kLanes + node);
      const bool needed = neighbours || part.always[index(node)] != 0;
      if (content == Content::patch ? about_it : needed && !about_it)
        for (int c = 0; c < 3; ++c) part.values.push_back(3 * node + c);
    }
    count += std::ssize(part.values);
  }
}

template <class Real>
void RankForces<Real>::add(int rank, const HeldGroups& there, const HeldGroups& here) {
  sent_.push_back({RankMessage(*cut_, ranks_->rank(), rank, there.forced, content_)});
  received_.push_back({RankMessage(*cut_, rank, ranks_->rank(), here.forced, content_)});
}

template <class Real>
void RankForces<Real>::follow(const std::vector<std::int64_t>& near, std::span<const RankSegment> more) {
  const auto lay_out = [&](std::vector<Packed>& messages, AlignedVector<Real>& values,
                           int RankMessage::*other, std::vector<RankSegment>& segments) {
    std::int64_t place = 0;
    for (Packed& packed : messages) {
      packed.message.follow(near);
      packed.first = std::exchange(place, place + packed.message.count);
    }
    values.resize(index(place));
    segments.clear();
    for (const Packed& packed : messages)
      if (packed.message.count > 0)
        segments.push_back({packed.message.*other, std::as_writable_bytes(std::span(values).subspan(
                                                       index(packed.first), index(packed.message.count)))});
  };
  lay_out(sent_, out_, &RankMessage::to, out_segments_);
  lay_out(received_, in_, &RankMessage::from, in_segments_);
  std::vector<RankSegment>& with = ranks_->rank() == kContactRank ? out_segments_ : in_segments_;
  with.insert(with.end(), more.begin(), more.end());
}

template <class Real>
void RankForces<Real>::exchange(Carry carry, Real* force) {
  pack(carry, force);
  ranks_->exchange(out_segments_, in_segments_);
  unpack(carry, force);
}

template <class Real>
void RankForces<Real>::post(Carry carry, const Real* force) {
  pack(carry, force);
  ranks_->post(out_segments_);
}

template <class Real>
void RankForces<Real>::receive(Carry carry, Real* force) {
  ranks_->receive(in_segments_);
  unpack(carry, force);
}

template <class Real>
void RankForces<Real>::pack(Carry carry, const Real* force) {
  for (const Packed& packed : sent_) pack(packed, carry, force);
}

template <class Real>
void RankForces<Real>::unpack(Carry carry, Real* force) const {
  for (const Packed& packed : received_) unpack_groups(packed, force);
  for (const Packed& packed : received_) unpack_joints(packed, carry, force);
}

template <class Real>
void RankForces<Real>::pack(const Packed& packed, Carry carry, const Real* force) {
  const RankMessage& message = packed.message;
  Real* values = out_.data() + packed.first;
  for_groups(message.groups, 0, std::ssize(message.groups), [&](std::int64_t at, std::int64_t place) {
    std::copy_n(force + place, kGroupValues, values + at);
  });
  values += kGroupValues * std::ssize(message.groups);
  for (const RankMessage::JointPart& part : message.parts) {
    const Real* const element = carry(part.joint->tile);
    const Real* const station = force + dof(part.joint->slot, 0);
    for (const std::int64_t i : part.values) *values++ = part.element ? element[i] : station[i * kLanes];
  }
}

template <class Real>
void RankForces<Real>::unpack_groups(const Packed& packed, Real* force) const {
  const std::vector<std::int64_t>& groups = packed.message.groups;
  const Real* const values = in_.data() + packed.first;
  for_groups(groups, 0, std::ssize(groups), [&](std::int64_t at, std::int64_t place) {
    std::copy_n(values + at, kGroupValues, force + place);
  });
}

/// Forces at a station are added in one process's order: that of the element last.
template <class Real>
void RankForces<Real>::unpack_joints(const Packed& packed, Carry carry, Real* force) const {
  const Real* values = in_.data() + packed.first + kGroupValues * std::ssize(packed.message.groups);
  for (const RankMessage::JointPart& part : packed.message.parts) {
    const Real* const element = carry(part.joint->tile);
    Real* const station = force + dof(part.joint->slot, 0);
    for (const std::int64_t i : part.values) {
      Real& total = station[i * kLanes];
      total = part.element ? total + *values : *values + element[i];
      ++values;
    }
  }
}

template class RankForces<double>;
template class RankForces<float>;

}  // namespace tread
