#include "kernels/contact/shared_columns.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "core/index.hpp"

namespace tread {

namespace {

static_assert(std::is_trivially_copyable_v<ContactPoint>);

/// Bytes of a column's number of points and its wake times.
std::size_t head_bytes(const FaceColumn& column) {
  return sizeof(std::int64_t) + column.wake_time.size_bytes();
}

std::int64_t points_of(const std::byte* head) {
  std::int64_t count = 0;
  std::memcpy(&count, head, sizeof count);
  return count;
}

}  // namespace

void SharedColumns::exchange(const FaceColumns& columns) {
  if (columns.of_station.empty()) return;
  for (bool fits = false; !fits;) {
    lay_out(columns);
    write_own(columns);
    ranks_->gather(packed_.data(), first_);
    fits = make_room(columns);
  }
  read_others(columns);
}

void SharedColumns::lay_out(const FaceColumns& columns) {
  const std::size_t ranks = index(ranks_->count());
  heads_ = (columns.of_station.size() + ranks - 1) / ranks * head_bytes(columns.of_station.front());
  const std::size_t length = heads_ + index(room_) * sizeof(ContactPoint);
  packed_.resize(ranks * length);
  first_.clear();
  for (std::size_t rank = 0; rank <= ranks; ++rank)
    first_.push_back(static_cast<std::int64_t>(rank * length));
}

template <class Visit>
void SharedColumns::for_each(const FaceColumns& columns, const Visit& visit) {
  for (std::size_t rank = 0; rank < head_.size(); ++rank) head_[rank] = message(rank);
  int station = columns.first_station;
  for (const FaceColumn& column : columns.of_station) {
    const int rank = rank_of(station++);
    visit(column, rank, head_[index(rank)]);
    head_[index(rank)] += head_bytes(column);
  }
}

/// Points that find no room are left out.
void SharedColumns::write_own(const FaceColumns& columns) {
  std::byte* points = message(index(ranks_->rank())) + heads_;
  std::int64_t left = room_;
  for_each(columns, [&](const FaceColumn& column, int rank, std::byte* head) {
    if (rank != ranks_->rank()) return;
    const std::int64_t count = std::ssize(*column.points);
    std::memcpy(head, &count, sizeof count);
    std::memcpy(head + sizeof count, column.wake_time.data(), column.wake_time.size_bytes());
    const std::int64_t fit = std::min(count, left);
    if (fit > 0) std::memcpy(points, column.points->data(), index(fit) * sizeof(ContactPoint));
    points += index(fit) * sizeof(ContactPoint);
    left -= fit;
  });
}

/// Returns false where the points of a rank have found no room; the next messages have it.
bool SharedColumns::make_room(const FaceColumns& columns) {
  std::fill(counts_.begin(), counts_.end(), 0);
  for_each(columns, [&](const FaceColumn& /*column*/, int rank, const std::byte* head) {
    counts_[index(rank)] += points_of(head);
  });
  const std::int64_t most = *std::max_element(counts_.begin(), counts_.end());
  const bool fits = most <= room_;
  room_ = most + most / 8 + 8;
  return fits;
}

void SharedColumns::read_others(const FaceColumns& columns) {
  for (std::size_t rank = 0; rank < points_.size(); ++rank) points_[rank] = message(rank) + heads_;
  for_each(columns, [&](const FaceColumn& column, int rank, const std::byte* head) {
    if (rank == ranks_->rank()) return;
    std::memcpy(column.wake_time.data(), head + sizeof(std::int64_t), column.wake_time.size_bytes());
    column.points->resize(index(points_of(head)));
    const std::size_t bytes = column.points->size() * sizeof(ContactPoint);
    if (bytes > 0) std::memcpy(column.points->data(), points_[index(rank)], bytes);
    points_[index(rank)] += bytes;
  });
}

}  // namespace tread
