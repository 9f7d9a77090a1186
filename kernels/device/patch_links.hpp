#pragma once
// Cells and nodes of a patch by a team of threads, with the numbers of PatchCells.

#include <climits>
#include <cstdint>

#include "kernels/contact/contact_point.hpp"
#include "kernels/device/contact_layout.hpp"
#include "kernels/device/patch_arena.hpp"

namespace tread {

/// Entries of a table for `keys` keys: a power of two, for some keys at least.
TREAD_BODY int table_size(int keys) {
  int size = 2;
  while (size <= keys) size *= 2;
  return size;
}

template <class Team>
class LinkedPatch {
 public:
  /// Arrays for which the arena has no room are those of `room`.
  TREAD_BODY LinkedPatch(const Team& team, const PatchArena& arena, const PatchLinks& room)
      : team_(team), arena_(arena), room_(room) {}

  TREAD_BODY int cells() const { return cells_; }
  TREAD_BODY int nodes() const { return nodes_; }
  TREAD_BODY const PatchLinks& links() const { return l_; }
  /// Memory that the links left.
  TREAD_BODY PatchArena& arena() { return arena_; }

  /// PatchTeam::name_near
  TREAD_BODY void name_near() {
    l_.entry = team_.near(l_.entry);
    l_.place = team_.near(l_.place);
    l_.first_entry = team_.near(l_.first_entry);
    l_.cell_node = team_.near(l_.cell_node);
    l_.first_term = team_.near(l_.first_term);
    l_.term = team_.near(l_.term);
    l_.inverse_mass = team_.near(l_.inverse_mass);
  }

  /// Finds cells and nodes of the points. `inverse_mass`: by slot [1/kg].
  TREAD_BODY void link(const PatchPoints& points, int count, const double* inverse_mass) {
    points_ = points;
    count_ = count;
    find_cells();
    list_entries();
    find_nodes(inverse_mass);
    list_terms();
  }

 private:
  TREAD_BODY const SurfaceSupport& support(int entry) const {
    return entry < count_ ? points_[entry].rail : points_[entry - count_].wheel;
  }

  /// Numbers the different keys, above zero, of `count` items by their first item: name(number, item).
  /// l_.mark: the key's place in the table l_.number. Returns how many there are.
  template <class Key, class Name>
  TREAD_BODY int number_keys(int count, const Key& key, const Name& name) {
    const int size = table_size(count);
    l_.mark = arena_.lend(count, room_.mark);
    l_.number = arena_.lend(size, room_.number);
    int* const known = arena_.lend(size, room_.known);
    int* const first = arena_.lend(size, room_.first);
    team_.for_each(size, [&](int i) {
      known[i] = 0;
      first[i] = INT_MAX;
    });
    team_.for_each(count, [&](int i) {
      const int own = key(i);
      auto at =
          static_cast<int>((static_cast<unsigned>(own) * 2654435769U >> 8) & static_cast<unsigned>(size - 1));
      while (team_.claim(known + at, own) != own) at = (at + 1) & (size - 1);
      team_.least(first + at, i);
      l_.mark[i] = at;
    });
    return team_.number(
        count, [&](int i) { return first[l_.mark[i]] == i ? 1 : 0; },
        [&](int i, int number) {
          if (first[l_.mark[i]] != i) return;
          l_.number[l_.mark[i]] = number;
          name(number, i);
        });
  }

  /// A cell's first node beside its face names it: no other face has that node there.
  TREAD_BODY void find_cells() {
    constexpr std::size_t kCorner = 5;
    l_.entry = arena_.keep(2 * count_, room_.entry);
    l_.place = arena_.keep(2 * count_, room_.place);
    l_.first_entry = arena_.keep(2 * count_ + 1, room_.first_entry);
    l_.sample = arena_.lend(2 * count_, room_.sample);
    cells_ = number_keys(
        2 * count_, [&](int e) { return 1 + static_cast<int>(support(e).slot[kCorner]); },
        [&](int cell, int e) { l_.sample[cell] = e; });
  }

  TREAD_BODY void list_entries() {
    list(
        2 * count_, [&](int e) { return l_.number[l_.mark[e]]; }, cells_, l_.first_entry,
        [&](int e, int place) {
          LinkedEntry& to = l_.entry[place];
          const SurfaceSupport& of = support(e);
          for (std::size_t i = 0; i < 4; ++i) {
            to.weights.along[i] = of.along[i];
            to.weights.across[i] = of.across[i];
          }
          to.point = e < count_ ? e : e - count_;
          l_.place[e] = place;
        });
  }

  TREAD_BODY void find_nodes(const double* inverse_mass) {
    arena_.take_back();
    l_.sample = arena_.lend(2 * count_, room_.sample);  // the same once more: it holds the cells' samples
    const int places = kCellNodes * cells_;
    const auto slot = [&](int place) {
      return support(l_.sample[place / kCellNodes]).slot[static_cast<std::size_t>(place % kCellNodes)];
    };
    l_.item = arena_.lend(places, room_.item);
    nodes_ = number_keys(
        places, [&](int p) { return 1 + static_cast<int>(slot(p)); },
        [&](int node, int p) { l_.item[node] = p; });
    l_.node = room_.node;
    l_.inverse_mass = arena_.keep(nodes_, room_.inverse_mass);
    team_.for_each(nodes_, [&](int n) {
      const int p = l_.item[n];
      const int entry = l_.sample[p / kCellNodes];
      PatchNode node{slot(p), 1, 0, entry < count_ ? 0 : 1};
      l_.inverse_mass[n] = inverse_mass[node.slot];
      if (node.of_wheel != 0) {
        const auto station = static_cast<std::size_t>(p % kCellNodes / 4);
        node.cosine = points_[entry - count_].wheel_cosine[station];
        node.sine = points_[entry - count_].wheel_sine[station];
      }
      l_.node[n] = node;
    });
  }

  TREAD_BODY void list_terms() {
    const int places = kCellNodes * cells_;
    l_.cell_node = arena_.keep(kCellStride * cells_, room_.cell_node);
    l_.first_term = arena_.keep(nodes_ + 1, room_.first_term);
    l_.term = arena_.keep(places, room_.term);
    list(
        places, [&](int p) { return l_.number[l_.mark[p]]; }, nodes_, l_.first_term,
        [&](int p, int place) {
          const int cell = p / kCellNodes;
          const int k = p % kCellNodes;
          l_.cell_node[cell * kCellStride + k] = 3 * l_.number[l_.mark[p]];
          l_.term[place] = cell * kSumStride + 3 * k;
        });
    arena_.take_back();
  }

  /// Lists the items 0 ... count - 1 by the owner of each, in ascending order: take(item, place).
  template <class Owner, class Take>
  TREAD_BODY void list(int count, const Owner& owner, int owners, int* first, const Take& take) {
    int* const nth = arena_.lend(count, room_.nth);
    int* const item = arena_.lend(count, room_.item);
    int* const owned = arena_.lend(owners, room_.owned);
    team_.for_each(owners, [&](int o) { owned[o] = 0; });
    team_.for_each(count, [&](int i) { nth[i] = team_.add(owned + owner(i), 1); });
    team_.number(
        owners, [&](int o) { return owned[o]; }, [&](int o, int before) { first[o] = before; });
    team_.for_each(count + 1, [&](int i) {
      if (i < count)
        item[first[owner(i)] + nth[i]] = i;
      else
        first[owners] = count;
    });
    // The order in which threads came does not show.
    team_.for_each(count, [&](int i) {
      const int own = owner(i);
      const int* const others = item + first[own];
      const int all = owned[own];
      int before = 0;
      for (int k = 0; k < all; ++k) before += others[k] < i ? 1 : 0;
      take(i, first[own] + before);
    });
  }

  const Team& team_;
  PatchArena arena_;  // here: a reference would keep all of this from registers
  const PatchLinks& room_;
  PatchLinks l_{};
  PatchPoints points_;
  int count_ = 0;
  int cells_ = 0;
  int nodes_ = 0;
};

}  // namespace tread
