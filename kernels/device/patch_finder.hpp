#pragma once
// The patch of a step by teams of threads: its points, nodes, and what sums between both need.

#include "kernels/device/contact_layout.hpp"
#include "kernels/device/patch_links.hpp"
#include "kernels/device/patch_room.hpp"

namespace tread {

template <class Teams>
class PatchFinder {
 public:
  TREAD_BODY PatchFinder(const Teams& teams, const ContactTask& task)
      : teams_(teams), task_(task), links_(teams, task.links) {}

  TREAD_BODY void run() {
    number_points();
    if (points_ > 0) {
      links_.link({task_.candidates.point, task_.candidates.origin}, points_, task_.mass);
      fill_supports();
      list_items();
    }
    teams_.for_each(1, [&](int) { *task_.counts = {points_, links_.nodes(), 0, 0}; });
  }

 private:
  /// Numbers the candidates that were kept, in their order.
  TREAD_BODY void number_points() {
    const FaceWindow& window = task_.window;
    const int faces = window.stations * window.edges;
    const Candidates& from = task_.candidates;
    points_ = teams_.number(
        faces * window.points, [&](int i) { return from.kept[i]; },
        [&](int i, int place) {
          if (i % window.points == 0) task_.record.first_point[i / window.points] = place;
          if (from.kept[i] != 0) from.origin[place] = i;
        });
    teams_.for_each(1, [&](int) { task_.record.first_point[faces] = points_; });
  }

  TREAD_BODY void fill_supports() const {
    const PatchLinks& l = links_.links();
    teams_.for_each(2 * points_, [&](int entry) {
      const SurfaceSupport& of = links_.support(entry);
      TeamSupport& to = task_.vectors.support[2 * links_.point_of(entry) + entry / points_];
      const int* const node = l.cell_node + kCellNodes * l.cell[entry];
      for (std::size_t k = 0; k < 4; ++k) {
        to.weights.along[k] = of.along[k];
        to.weights.across[k] = of.across[k];
      }
      double mobility = 0;
      for (int k = 0; k < kCellNodes; ++k) {
        to.node[k] = node[k];
        const double weight = of.weight(static_cast<std::size_t>(k));
        mobility += weight * weight * l.inverse_mass[node[k]];
      }
      to.mobility = mobility;
    });
  }

  /// A node's items go through all entries of its cells.
  TREAD_BODY void list_items() const {
    const PatchLinks& l = links_.links();
    const int terms = kCellNodes * links_.cells();
    int* const item_of_term = task_.vectors.item_of_term;
    const int all = teams_.number(
        terms,
        [&](int t) {
          const int cell = l.term[t] / kCellNodes;
          return l.first_entry[cell + 1] - l.first_entry[cell];
        },
        [&](int t, int before) { item_of_term[t] = before; });
    teams_.for_each(terms + links_.nodes() + 1, [&](int i) {
      if (i < terms) {
        list_items_of(i);
        return;
      }
      const int node = i - terms;
      task_.vectors.first_item[node] = node < links_.nodes() ? item_of_term[l.first_term[node]] : all;
    });
  }

  TREAD_BODY void list_items_of(int term) const {
    const PatchLinks& l = links_.links();
    const int place = l.term[term];
    const int cell = place / kCellNodes;
    const double inverse_mass = l.inverse_mass[l.cell_node[place]];
    NodeItem* to = task_.vectors.item + task_.vectors.item_of_term[term];
    for (int e = l.first_entry[cell]; e < l.first_entry[cell + 1]; ++e, ++to) {
      const int entry = l.entry[e];
      const double weight = links_.support(entry).weight(static_cast<std::size_t>(place % kCellNodes));
      *to = {weight * inverse_mass, links_.point_of(entry)};
    }
  }

  const Teams& teams_;
  const ContactTask& task_;
  LinkedPatch<Teams> links_;
  int points_ = 0;
};

/// Finds the patch of what has been searched.
struct FindPatch {
  static constexpr bool kNeedsMemory = false;  ///< of its teams

  ContactTask task;

  template <class Teams>
  TREAD_BODY void operator()(const Teams& teams) const {
    PatchFinder<Teams>(teams, task).run();
  }
};

}  // namespace tread
