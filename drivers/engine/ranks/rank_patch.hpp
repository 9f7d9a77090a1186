#pragma once
// Motion of the patch, which kContactRank sends the other ranks. [docs/records/ranks.md]

#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/engine/ranks/shared_groups.hpp"

namespace tread {

template <class Real, class U>
class PatchMotion {
 public:
  /// Another rank, which gets the motion or, to others, sends it. `surfaces`: groups of both running
  /// surfaces, ascending; `receiver`: what it holds.
  void add(int other, const std::vector<std::int64_t>& surfaces, const HeldGroups& receiver);

  /// The groups about the patch, ascending.
  void follow(const std::vector<std::int64_t>& near);
  /// Sent by kContactRank and received by the others, in place until the next follow().
  const std::vector<RankSegment>& segments() const { return segments_; }

  void pack(const U* u, const Real* v);
  void unpack(U* u, Real* v) const;

 private:
  struct Part {
    int other;                          ///< rank that gets it, or sends it
    std::vector<std::int64_t> surface;  ///< groups of the running surfaces that are moved there, ascending
    std::vector<std::int64_t> groups;   ///< those about the patch
    AlignedVector<U> u;
    AlignedVector<Real> v;
  };

  std::vector<Part> parts_;  ///< by other rank on kContactRank, else one
  std::vector<RankSegment> segments_;
};

extern template class PatchMotion<double, double>;
extern template class PatchMotion<float, double>;
extern template class PatchMotion<float, float>;

}  // namespace tread
