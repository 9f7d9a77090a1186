#pragma once
// Columns of rail faces that ranks search in turns, and what they find there. [docs/records/ranks.md]

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "kernels/contact/contact_point.hpp"

namespace tread {

/// The faces that begin at a rail station.
struct FaceColumn {
  std::span<double> wake_time;                  ///< by edge of the rail's surface [s]
  std::vector<ContactPoint>* points = nullptr;  ///< found
};

/// Columns of a window, all with one number of edges.
struct FaceColumns {
  int first_station = 0;
  std::vector<FaceColumn> of_station;  ///< from the first one on
};

class SharedColumns {
 public:
  explicit SharedColumns(std::shared_ptr<Ranks> ranks)
      : ranks_(std::move(ranks)),
        head_(static_cast<std::size_t>(ranks_->count())),
        points_(head_.size()),
        counts_(head_.size()) {}

  /// True for columns that this rank searches. Neighbours are others', so that each rank has its share of the
  /// patch.
  bool own(int station) const { return rank_of(station) == ranks_->rank(); }

  /// Gives each rank what all have found.
  void exchange(const FaceColumns& columns);

 private:
  int rank_of(int station) const { return station % ranks_->count(); }
  void lay_out(const FaceColumns& columns);
  void write_own(const FaceColumns& columns);
  bool make_room(const FaceColumns& columns);
  void read_others(const FaceColumns& columns);
  std::byte* message(std::size_t rank) { return packed_.data() + first_[rank]; }
  /// Calls visit(column, rank, head of the column in the messages).
  template <class Visit>
  void for_each(const FaceColumns& columns, const Visit& visit);

  std::shared_ptr<Ranks> ranks_;
  std::int64_t room_ = 0;            ///< points of a rank that fit in its message
  std::vector<std::byte> packed_;    ///< messages of all ranks, of one length: heads of columns, then points
  std::vector<std::int64_t> first_;  ///< by rank, and the end, in packed_
  std::size_t heads_ = 0;            ///< length of the heads in a message [B]
  std::vector<std::byte*> head_, points_;  ///< by rank: the next ones in packed_
  std::vector<std::int64_t> counts_;       ///< by rank: points found
};

}  // namespace tread
