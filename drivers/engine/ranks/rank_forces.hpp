#pragma once
// The forces that ranks send one another in a step: each gets those of the nodes that it moves and others
// hold, and of nodes tied to them. [docs/records/ranks.md]

#include <cstdint>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/function_ref.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/engine/ranks/rank_cut.hpp"
#include "drivers/engine/ranks/shared_groups.hpp"

namespace tread {

/// Values that one rank sends another in a step: forces of whole groups, then those at joints.
struct RankMessage {
  /// About the station of a joint: the force of the element, or of all others there.
  struct JointPart {
    const Joint* joint;
    bool element;
    std::vector<std::int64_t> values;  ///< 3 * section node + component
    GroupMarks always;                 ///< by section node: those of third ranks wherever the patch is
  };

  enum class Content {
    patch,  ///< forces of the nodes about it, to kContactRank
    rest,   ///< all others
  };

  /// Keeps a reference to the cut. `forced`: HeldGroups::forced of the receiver.
  RankMessage(const RankCut& cut, int from, int to, const GroupMarks& forced, Content content);

  /// `patch`: the groups about it, ascending.
  void follow(const std::vector<std::int64_t>& patch);

  const RankCut* cut;
  int from, to;
  Content content;
  std::vector<std::int64_t> always, groups;  ///< ascending: those of the receiver, and those of the message
  std::vector<JointPart> parts;
  std::int64_t count = 0;  ///< of its values
};

template <class Real>
class RankForces {
 public:
  /// Keeps references.
  RankForces(const RankCut& cut, Ranks& ranks, RankMessage::Content content)
      : cut_(&cut), ranks_(&ranks), content_(content) {}

  /// Another rank. `there`, `here`: the groups that it and this rank hold.
  void add(int rank, const HeldGroups& there, const HeldGroups& here);

  /// RankMessage::follow of all. `more` bytes go along, to other ranks from kContactRank.
  void follow(const std::vector<std::int64_t>& patch, std::span<const RankSegment> more = {});

  /// Force of a tile's last element on the station behind it. [BasicInternalForce::carry]
  using Carry = FunctionRef<const Real*(std::size_t)>;
  /// Completes the forces of the elements of this rank's tiles.
  void exchange(Carry carry, Real* force);
  /// The same one way: begins to send the forces; waits for those of the others.
  void post(Carry carry, const Real* force);
  void receive(Carry carry, Real* force);

 private:
  /// A message and its place among the values that go the same way.
  struct Packed {
    RankMessage message;
    std::int64_t first = 0;
  };
  void pack(Carry carry, const Real* force);
  void pack(const Packed& packed, Carry carry, const Real* force);
  void unpack(Carry carry, Real* force) const;
  void unpack_groups(const Packed& packed, Real* force) const;
  void unpack_joints(const Packed& packed, Carry carry, Real* force) const;

  const RankCut* cut_;
  Ranks* ranks_;
  RankMessage::Content content_;
  std::vector<Packed> sent_, received_;
  AlignedVector<Real> out_, in_;
  std::vector<RankSegment> out_segments_, in_segments_;
};

extern template class RankForces<double>;
extern template class RankForces<float>;

}  // namespace tread
