#pragma once
// The forces that ranks send one another in a step: each gets those of the nodes that it moves and others
// hold, and of nodes tied to them. [docs/records/ranks.md]

#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/function_ref.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/engine/rank_cut.hpp"
#include "drivers/engine/shared_groups.hpp"

namespace tread {

class RankMessages {
 public:
  /// Keeps a reference to the cut. `own`: this rank.
  RankMessages(const RankCut& cut, const SharedGroups& groups, int own);

  /// A part of a message about the station of a joint: the force of the element, or of all others there.
  struct JointPart {
    const Joint* joint;
    bool element;
    std::vector<std::int64_t> values;  ///< 3 * section node + component
    GroupMarks always;                 ///< by section node: those of third ranks wherever the patch is
  };
  /// Forces of whole groups, then those at joints.
  struct Message {
    int rank;                                  ///< the other
    std::vector<std::int64_t> always, groups;  ///< ascending: those wherever the patch is, and all
    std::vector<JointPart> parts;
    std::int64_t first = 0;  ///< place of its values among those of all messages
    std::int64_t count = 0;  ///< of its values
  };

  /// All ranks get the forces of these groups, ascending, besides those wherever the patch is.
  void follow(const std::vector<std::int64_t>& near);

  const std::vector<Message>& sent() const { return sent_; }
  const std::vector<Message>& received() const { return received_; }
  std::int64_t values_sent() const { return sent_.empty() ? 0 : sent_.back().first + sent_.back().count; }
  std::int64_t values_received() const {
    return received_.empty() ? 0 : received_.back().first + received_.back().count;
  }

 private:
  void add(std::vector<Message>& messages, int from, int to, const GroupMarks& forced) const;
  void follow(std::vector<Message>& messages, const std::vector<std::int64_t>& near, bool sends) const;

  const RankCut* cut_;
  int own_;
  std::vector<Message> sent_, received_;
};

template <class Real>
class RankForces {
 public:
  RankForces(const RankCut& cut, const SharedGroups& groups, Ranks& ranks)
      : messages_(cut, groups, ranks.rank()), ranks_(&ranks) {
    make_room();
  }

  const RankMessages& messages() const { return messages_; }
  /// RankMessages::follow.
  void follow(const std::vector<std::int64_t>& near) {
    messages_.follow(near);
    make_room();
  }

  /// Force of a tile's last element on the station behind it. [BasicInternalForce::carry]
  using Carry = FunctionRef<const Real*(std::size_t)>;
  /// Completes the forces of the elements of this rank's tiles.
  void exchange(Carry carry, Real* force);

 private:
  void make_room();
  void pack(const RankMessages::Message& message, Carry carry, const Real* force);
  void unpack_groups(const RankMessages::Message& message, Real* force) const;
  void unpack_joints(const RankMessages::Message& message, Carry carry, Real* force) const;

  RankMessages messages_;
  Ranks* ranks_;
  AlignedVector<Real> out_, in_;
  std::vector<RankSegment> out_segments_, in_segments_;
};

extern template class RankForces<double>;
extern template class RankForces<float>;

}  // namespace tread
