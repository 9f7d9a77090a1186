#pragma once
// Cells and nodes of a patch by teams of threads, with the numbers of PatchCells.

#include <climits>
#include <cstdint>

#include "kernels/contact/contact_point.hpp"
#include "kernels/device/contact_layout.hpp"
#include "kernels/update/inverse_mass.hpp"

namespace tread {

/// Entries of a table for `keys` keys: a power of two, for some keys at least.
TREAD_BODY int table_size(int keys) {
  int size = 2;
  while (size <= keys) size *= 2;
  return size;
}

/// `Teams`: kernels/device/patch_room.hpp.
template <class Teams>
class LinkedPatch {
 public:
  TREAD_BODY LinkedPatch(const Teams& teams, const PatchLinks& links) : teams_(teams), l_(links) {}

  TREAD_BODY int cells() const { return cells_; }
  TREAD_BODY int nodes() const { return nodes_; }
  TREAD_BODY const PatchLinks& links() const { return l_; }
  /// Point and support of an entry.
  TREAD_BODY int point_of(int entry) const { return entry < count_ ? entry : entry - count_; }
  TREAD_BODY const SurfaceSupport& support(int entry) const {
    const ContactPoint& point = points_[point_of(entry)];
    return entry < count_ ? point.rail : point.wheel;
  }

  /// Finds cells and nodes of the points. `mass`: by slot [kg].
  TREAD_BODY void link(const PatchPoints& points, int count, const double* mass) {
    points_ = points;
    count_ = count;
    find_cells();
    list_entries();
    find_nodes(mass);
    list_terms();
  }

 private:
  /// Numbers the different keys, above zero, of `count` items by their first item: name(number, item).
  /// l_.mark: the key's place in the table l_.number. Returns how many there are.
  template <class Key, class Name>
  TREAD_BODY int number_keys(int count, const Key& key, const Name& name) const {
    const int size = table_size(count);
    teams_.for_each(size, [&](int i) {
      l_.known[i] = 0;
      l_.first[i] = INT_MAX;
    });
    teams_.for_each(count, [&](int i) {
      const int own = key(i);
      auto at =
          static_cast<int>((static_cast<unsigned>(own) * 2654435769U >> 8) & static_cast<unsigned>(size - 1));
      while (teams_.claim(l_.known + at, own) != own) at = (at + 1) & (size - 1);
      teams_.least(l_.first + at, i);
      l_.mark[i] = at;
    });
    return teams_.number(
        count, [&](int i) { return l_.first[l_.mark[i]] == i ? 1 : 0; },
        [&](int i, int number) {
          if (l_.first[l_.mark[i]] != i) return;
          l_.number[l_.mark[i]] = number;
          name(number, i);
        });
  }

  /// A cell's first node beside its face names it: no other face has that node there.
  TREAD_BODY void find_cells() {
    constexpr std::size_t kCorner = 5;
    cells_ = number_keys(
        2 * count_, [&](int e) { return 1 + static_cast<int>(support(e).slot[kCorner]); },
        [&](int cell, int e) { l_.sample[cell] = e; });
  }

  TREAD_BODY void list_entries() const {
    list(
        2 * count_, [&](int e) { return l_.number[l_.mark[e]]; }, cells_, l_.first_entry,
        [&](int e, int place) {
          l_.entry[place] = e;
          l_.cell[e] = l_.number[l_.mark[e]];
        });
  }

  TREAD_BODY void find_nodes(const double* mass) {
    const auto slot = [&](int place) {
      return support(l_.sample[place / kCellNodes]).slot[static_cast<std::size_t>(place % kCellNodes)];
    };
    nodes_ = number_keys(
        kCellNodes * cells_, [&](int p) { return 1 + static_cast<int>(slot(p)); },
        [&](int n, int p) {
          const int entry = l_.sample[p / kCellNodes];
          PatchNode node{slot(p), 1, 0, entry < count_ ? 0 : 1};
          l_.inverse_mass[n] = inverse_mass(mass[node.slot]);
          if (node.of_wheel != 0) {
            const auto station = static_cast<std::size_t>(p % kCellNodes / 4);
            node.cosine = points_[entry - count_].wheel_cosine[station];
            node.sine = points_[entry - count_].wheel_sine[station];
          }
          l_.node[n] = node;
        });
  }

  TREAD_BODY void list_terms() const {
    list(
        kCellNodes * cells_, [&](int p) { return l_.number[l_.mark[p]]; }, nodes_, l_.first_term,
        [&](int p, int place) {
          l_.cell_node[p] = l_.number[l_.mark[p]];
          l_.term[place] = p;
        });
  }

  /// Lists the items 0 ... count - 1 by the owner of each, in ascending order: take(item, place).
  template <class Owner, class Take>
  TREAD_BODY void list(int count, const Owner& owner, int owners, int* first, const Take& take) const {
    teams_.for_each(owners, [&](int o) { l_.owned[o] = 0; });
    teams_.for_each(count, [&](int i) { l_.nth[i] = teams_.add(l_.owned + owner(i), 1); });
    teams_.number(
        owners, [&](int o) { return l_.owned[o]; }, [&](int o, int before) { first[o] = before; });
    teams_.for_each(count + 1, [&](int i) {
      if (i < count)
        l_.item[first[owner(i)] + l_.nth[i]] = i;
      else
        first[owners] = count;
    });
    // The order in which threads came does not show.
    teams_.for_each(count, [&](int i) {
      const int own = owner(i);
      const int* const others = l_.item + first[own];
      const int all = l_.owned[own];
      int before = 0;
      for (int k = 0; k < all; ++k) before += others[k] < i ? 1 : 0;
      take(i, first[own] + before);
    });
  }

  const Teams& teams_;
  PatchLinks l_;
  PatchPoints points_;
  int count_ = 0;
  int cells_ = 0;
  int nodes_ = 0;
};

}  // namespace tread
