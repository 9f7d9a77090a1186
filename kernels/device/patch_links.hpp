#pragma once
// Cells and nodes of a patch by a team of threads, with the numbers of PatchCells.

#include <climits>
#include <cstdint>

#include "kernels/contact/patch_point_body.hpp"
#include "kernels/device/contact_layout.hpp"

namespace tread {

inline constexpr int kPatchParts = 128;  ///< of sums over the patch

template <class Team>
class LinkedPatch {
 public:
  TREAD_BODY LinkedPatch(const Team& team, const PatchLinks& links) : team_(team), l_(links) {
    parts_ = team.template share<int>(kPatchParts + 2);
  }
  static std::size_t shared_bytes() { return sizeof(int) * (kPatchParts + 2); }

  TREAD_BODY int cells() const { return cells_; }
  TREAD_BODY int nodes() const { return nodes_; }

  /// Sets `number` of each of `count` flags to the flags before it that are not zero. Returns all of these.
  TREAD_BODY int number(const int* flag, int* number, int count) const {
    const int length = (count + kPatchParts - 1) / kPatchParts;
    team_.for_each(kPatchParts, [&](int part) {
      int own = 0;
      for (int i = part * length; i < (part + 1) * length && i < count; ++i) own += flag[i] != 0 ? 1 : 0;
      parts_[part] = own;
    });
    scan();
    team_.for_each(kPatchParts, [&](int part) {
      int before = parts_[part];
      for (int i = part * length; i < (part + 1) * length && i < count; ++i) {
        number[i] = before;
        before += flag[i] != 0 ? 1 : 0;
      }
    });
    return parts_[kPatchParts];
  }

  /// Finds cells and nodes of the points.
  TREAD_BODY void link(const ContactPoint* points, int count) {
    points_ = points;
    count_ = count;
    find_cells();
    list(l_.cell, 2 * count_, cells_, l_.first_listed, l_.listed);
    find_nodes();
    list(l_.cell_node, kCellNodes * cells_, nodes_, l_.first_term, l_.term);
  }

 private:
  /// Exclusive sums of the parts.
  TREAD_BODY void scan() const {
    team_.for_each(1, [&](int) {
      int before = 0;
      for (int part = 0; part < kPatchParts; ++part) {
        const int own = parts_[part];
        parts_[part] = before;
        before += own;
      }
      parts_[kPatchParts] = before;
    });
  }

  TREAD_BODY const SurfaceSupport& support(int entry) const {
    return entry < count_ ? points_[entry].rail : points_[entry - count_].wheel;
  }

  /// A cell's first node beside its face names it: no other face has that node there.
  TREAD_BODY void find_cells() {
    constexpr std::size_t kCorner = 5;
    const auto corner = [&](int entry) { return support(entry).slot[kCorner]; };
    team_.for_each(2 * count_, [&](int e) { team_.least(l_.at_slot + corner(e), e); });
    team_.for_each(2 * count_, [&](int e) { l_.flag[e] = l_.at_slot[corner(e)] == e ? 1 : 0; });
    cells_ = number(l_.flag, l_.number, 2 * count_);
    team_.for_each(2 * count_, [&](int e) {
      l_.cell[e] = l_.number[l_.at_slot[corner(e)]];
      if (l_.flag[e] != 0) l_.first_entry[l_.cell[e]] = e;
      const SurfaceSupport& of = support(e);
      for (std::size_t i = 0; i < 4; ++i) {
        l_.weights[e].along[i] = of.along[i];
        l_.weights[e].across[i] = of.across[i];
      }
    });
    team_.for_each(2 * count_, [&](int e) { l_.at_slot[corner(e)] = INT_MAX; });
  }

  TREAD_BODY void find_nodes() {
    const int places = kCellNodes * cells_;
    const auto slot = [&](int place) {
      return support(l_.first_entry[place / kCellNodes]).slot[static_cast<std::size_t>(place % kCellNodes)];
    };
    team_.for_each(places, [&](int p) { team_.least(l_.at_slot + slot(p), p); });
    team_.for_each(places, [&](int p) { l_.flag[p] = l_.at_slot[slot(p)] == p ? 1 : 0; });
    nodes_ = number(l_.flag, l_.number, places);
    team_.for_each(places, [&](int p) {
      const int node = l_.number[l_.at_slot[slot(p)]];
      l_.cell_node[p] = node;
      if (l_.flag[p] == 0) return;
      const int entry = l_.first_entry[p / kCellNodes];
      l_.slot[node] = slot(p);
      l_.of_wheel[node] = entry < count_ ? 0 : 1;
      const auto station = static_cast<std::size_t>(p % kCellNodes / 4);
      l_.basis[2 * node] = entry < count_ ? 1 : points_[entry - count_].wheel_cosine[station];
      l_.basis[2 * node + 1] = entry < count_ ? 0 : points_[entry - count_].wheel_sine[station];
    });
    team_.for_each(places, [&](int p) { l_.at_slot[slot(p)] = INT_MAX; });
  }

  /// Lists the items 0 ... count - 1 by the owner of each, in ascending order.
  TREAD_BODY void list(const int* owner, int count, int owners, int* first, int* listed) const {
    team_.for_each(owners + 1, [&](int o) { first[o] = 0; });
    team_.for_each(count, [&](int i) { team_.add(first + owner[i] + 1, 1); });
    const int length = (owners + kPatchParts - 1) / kPatchParts;
    team_.for_each(kPatchParts, [&](int part) {
      int own = 0;
      for (int o = part * length; o < (part + 1) * length && o < owners; ++o) own += first[o + 1];
      parts_[part] = own;
    });
    scan();
    team_.for_each(kPatchParts, [&](int part) {
      int before = parts_[part];
      for (int o = part * length; o < (part + 1) * length && o < owners; ++o)
        first[o + 1] = before += first[o + 1];
    });
    team_.for_each(owners, [&](int o) { l_.flag[o] = 0; });
    team_.for_each(count, [&](int i) { listed[first[owner[i]] + team_.add(l_.flag + owner[i], 1)] = i; });
    team_.for_each(owners, [&](int o) { sort(listed + first[o], first[o + 1] - first[o]); });
  }

  /// In any order of the threads the same.
  TREAD_BODY static void sort(int* values, int count) {
    for (int i = 1; i < count; ++i) {
      const int value = values[i];
      int at = i;
      for (; at > 0 && values[at - 1] > value; --at) values[at] = values[at - 1];
      values[at] = value;
    }
  }

  const Team& team_;
  const PatchLinks& l_;
  int* parts_;
  const ContactPoint* points_ = nullptr;
  int count_ = 0;
  int cells_ = 0;
  int nodes_ = 0;
};

}  // namespace tread
