#include "drivers/engine/rank_forces.hpp"

#include <algorithm>
#include <iterator>

namespace tread {

namespace {

std::vector<std::int64_t> all_values(const Joint& joint) {
  std::vector<std::int64_t> values(index(3 * joint.nodes));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i);
  return values;
}

}  // namespace

RankMessages::RankMessages(const RankCut& cut, const SharedGroups& groups, int own) : cut_(&cut), own_(own) {
  const GroupMarks own_forced = groups.held_by(own).forced;
  for (int rank = 0; rank < cut.ranks(); ++rank) {
    if (rank == own) continue;
    add(sent_, own, rank, groups.held_by(rank).forced);
    add(received_, rank, own, own_forced);
  }
  follow(groups.near());
}

/// `forced`: groups whose forces the receiver needs.
void RankMessages::add(std::vector<Message>& messages, int from, int to, const GroupMarks& forced) const {
  Message message{from == own_ ? to : from, {}, {}, {}};
  for (const TileStretch& stretch : cut_->stretches(from))
    for (std::int64_t group = cut_->first_group(stretch.first); group < cut_->first_group(stretch.last);
         ++group)
      if (forced[index(group)] != 0) message.always.push_back(group);
  for (const Joint& joint : cut_->joints()) {
    const auto marks = forced.begin() + joint.slot / kLanes;
    if (joint.near == from) message.parts.push_back({&joint, true, {}, {marks, marks + joint.nodes}});
    if (joint.far == from && joint.near == to)
      message.parts.push_back({&joint, false, all_values(joint), {}});
  }
  messages.push_back(std::move(message));
}

void RankMessages::follow(const std::vector<std::int64_t>& near) {
  follow(sent_, near, true);
  follow(received_, near, false);
}

void RankMessages::follow(std::vector<Message>& messages, const std::vector<std::int64_t>& near,
                          bool sends) const {
  std::int64_t place = 0;
  for (Message& message : messages) {
    const int from = sends ? own_ : message.rank;
    const int to = sends ? message.rank : own_;
    message.groups.assign(message.always.begin(), message.always.end());
    const auto middle = std::ssize(message.groups);
    for (const std::int64_t group : near)
      if (cut_->owner(group) == from &&
          !std::binary_search(message.always.begin(), message.always.end(), group))
        message.groups.push_back(group);
    std::inplace_merge(message.groups.begin(), message.groups.begin() + middle, message.groups.end());
    message.first = place;
    message.count = std::ssize(message.groups) * kGroupValues;
    for (JointPart& part : message.parts) {
      if (part.element) {
        part.values.clear();
        for (std::int64_t node = 0; node < part.joint->nodes; ++node)
          if (part.joint->far == to || part.always[index(node)] != 0 ||
              std::binary_search(near.begin(), near.end(), part.joint->slot / kLanes + node))
            for (int c = 0; c < 3; ++c) part.values.push_back(3 * node + c);
      }
      message.count += std::ssize(part.values);
    }
    place += message.count;
  }
}

template <class Real>
void RankForces<Real>::make_room() {
  out_.resize(index(messages_.values_sent()));
  in_.resize(index(messages_.values_received()));
  const auto segments = [](const std::vector<RankMessages::Message>& messages, AlignedVector<Real>& values,
                           std::vector<RankSegment>& list) {
    list.clear();
    for (const RankMessages::Message& message : messages)
      if (message.count > 0)
        list.push_back({message.rank, std::as_writable_bytes(std::span(values).subspan(
                                          index(message.first), index(message.count)))});
  };
  segments(messages_.sent(), out_, out_segments_);
  segments(messages_.received(), in_, in_segments_);
}

template <class Real>
void RankForces<Real>::exchange(Carry carry, Real* force) {
  for (const RankMessages::Message& message : messages_.sent()) pack(message, carry, force);
  ranks_->exchange(out_segments_, in_segments_);
  for (const RankMessages::Message& message : messages_.received()) unpack_groups(message, force);
  for (const RankMessages::Message& message : messages_.received()) unpack_joints(message, carry, force);
}

template <class Real>
void RankForces<Real>::pack(const RankMessages::Message& message, Carry carry, const Real* force) {
  Real* packed = out_.data() + message.first;
  for_groups(message.groups, 0, std::ssize(message.groups), [&](std::int64_t at, std::int64_t place) {
    std::copy_n(force + place, kGroupValues, packed + at);
  });
  packed += kGroupValues * std::ssize(message.groups);
  for (const RankMessages::JointPart& part : message.parts) {
    const Real* const element = carry(part.joint->tile);
    const Real* const station = force + dof(part.joint->slot, 0);
    for (const std::int64_t i : part.values) *packed++ = part.element ? element[i] : station[i * kLanes];
  }
}

template <class Real>
void RankForces<Real>::unpack_groups(const RankMessages::Message& message, Real* force) const {
  const Real* const packed = in_.data() + message.first;
  for_groups(message.groups, 0, std::ssize(message.groups), [&](std::int64_t at, std::int64_t place) {
    std::copy_n(packed + at, kGroupValues, force + place);
  });
}

/// Forces at a station are added in one process's order: that of the element last.
template <class Real>
void RankForces<Real>::unpack_joints(const RankMessages::Message& message, Carry carry, Real* force) const {
  const Real* packed = in_.data() + message.first + kGroupValues * std::ssize(message.groups);
  for (const RankMessages::JointPart& part : message.parts) {
    const Real* const element = carry(part.joint->tile);
    Real* const station = force + dof(part.joint->slot, 0);
    for (const std::int64_t i : part.values) {
      Real& total = station[i * kLanes];
      total = part.element ? total + *packed : *packed + element[i];
      ++packed;
    }
  }
}

template class RankForces<double>;
template class RankForces<float>;

}  // namespace tread
