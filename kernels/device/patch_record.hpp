#pragma once
// Outcome of a patch: the record of the passage on the rail, and sums over the points.

#include <cstdint>

#include "kernels/contact/patch_nodes.hpp"
#include "kernels/device/contact_layout.hpp"

namespace tread {

/// A thread takes a node about the patch, or a part of a sum over the points.
struct RecordPatch {
  ContactTask task;

  std::int64_t count() const { return kSums + std::int64_t{task.window.stations + 1} * rows(); }
  TREAD_BODY void operator()(std::int64_t i) const {
    if (i < kSums)
      sum_up(static_cast<int>(i));
    else if (task.counts->points > 0)
      record_node(static_cast<int>(i - kSums) / rows(), static_cast<int>(i - kSums) % rows());
  }

 private:
  static constexpr int kSums = PointOutcome::kSums * kPatchParts;

  TREAD_BODY int rows() const { return task.window.edges + 1; }

  TREAD_BODY void sum_up(int i) const {
    double own = 0;
    for (int of = i / PointOutcome::kSums; of < task.counts->points; of += kPatchParts)
      own += task.vectors.outcome[of].sum[i % PointOutcome::kSums];
    task.vectors.total[i] = own;
  }

  /// Adds averages to the record, at the node at a station and row of the window, from the points of the
  /// faces about it.
  TREAD_BODY void record_node(int station, int row) const {
    const FaceWindow& window = task.window;
    const RecordView& to = task.record;
    const int at = window.first_station + station;
    const double area = to.length[at] * to.width[row];
    int first[4];
    int last[4];
    for (int corner = 0; corner < 4; ++corner) {
      const int of_station = station - corner / 2;
      const int of_edge = row - corner % 2;
      const bool there =
          of_station >= 0 && of_station < window.stations && of_edge >= 0 && of_edge < window.edges;
      const int face = there ? of_station * window.edges + of_edge : 0;
      first[corner] = to.first_point[face];
      last[corner] = there ? to.first_point[face + 1] : first[corner];
    }
    if (first[0] == last[0] && first[1] == last[1] && first[2] == last[2] && first[3] == last[3]) return;
    NodalStress node;
    for (int corner = 3; corner >= 0; --corner)
      for (int i = first[corner]; i < last[corner]; ++i)
        node.add(task.vectors.outcome[i], task.vectors.outcome[i].share[corner] / area);
    const std::int64_t place = std::int64_t{at} * to.rows + row;
    if (node.pressure > to.max_pressure[place]) to.max_pressure[place] = node.pressure;
    const double shear = node.shear_size();
    if (shear > to.max_shear[place]) to.max_shear[place] = shear;
    to.frictional_work[place] += node.frictional_work;
  }
};

/// Sums up the parts in their order.
struct SumPatch {
  ContactTask task;

  std::int64_t count() const { return 1; }
  TREAD_BODY void operator()(std::int64_t /*i*/) const {
    double all[PointOutcome::kSums] = {};
    for (int part = 0; part < kPatchParts; ++part)
      for (int j = 0; j < PointOutcome::kSums; ++j)
        all[j] += task.vectors.total[PointOutcome::kSums * part + j];
    const PatchCounts& counts = *task.counts;
    *task.result = {{all[0], all[1], all[2]}, all[3],          all[4], counts.points,
                    counts.at_the_end,        counts.unsettled};
  }
};

}  // namespace tread
