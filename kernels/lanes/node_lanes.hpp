#pragma once
// Values of nodes at any places of a chunk, into lanes and back: rows of four become columns of three.
// Internal linkage keeps the versions of the instruction sets apart.

#include <cstdint>

#include "kernels/lanes/hex_force.hpp"
#include "kernels/lanes/registers.hpp"
#include "kernels/lanes/shuffles.hpp"

namespace tread {
namespace {

/// Even, odd: values of both registers in turn, (a[0], b[0], a[2], b[2] ...) and (a[1], b[1], a[3] ...).
template <class V>
TREAD_INLINE V even_lanes(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  else if constexpr (sizeof a / sizeof a[0] == 4)
    return __builtin_shufflevector(a, b, 0, 4, 2, 6);
  else
    return __builtin_shufflevector(a, b, 0, 2);
}
template <class V>
TREAD_INLINE V odd_lanes(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  else if constexpr (sizeof a / sizeof a[0] == 4)
    return __builtin_shufflevector(a, b, 1, 5, 3, 7);
  else
    return __builtin_shufflevector(a, b, 1, 3);
}

/// First and second pairs of every four values of both registers: (a[0], a[1], b[0], b[1], a[4] ...).
template <class V>
TREAD_INLINE V first_pairs(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
  else
    return __builtin_shufflevector(a, b, 0, 1, 4, 5);
}
template <class V>
TREAD_INLINE V second_pairs(const V& a, const V& b) {
  if constexpr (sizeof a / sizeof a[0] == 8)
    return __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
  else
    return __builtin_shufflevector(a, b, 2, 3, 6, 7);
}

/// Rows l and l + 4 of eight, or row l of four, side by side.
template <class V, class Row>
TREAD_INLINE V rows_abreast(const Row& row, int l) {
  if constexpr (sizeof(V) == 64)
    return abreast(row(l), row(l + 4));
  else
    return row(l);
}

/// Components of rows of four.
template <class V, class At>
TREAD_INLINE void transpose_rows(const At& at, V (&value)[3]) {
  if constexpr (sizeof(V) == 16) {
    const V first = load<V>(at(0)), second = load<V>(at(1));
    value[0] = even_lanes(first, second);
    value[1] = odd_lanes(first, second);
    value[2] = even_lanes(load<V>(at(0) + 2), load<V>(at(1) + 2));
  } else {
    using Row = typename Vector<double, 4>::type;
    const auto row = [&](int l) { return load<Row>(at(l)); };
    const V r0 = rows_abreast<V>(row, 0), r1 = rows_abreast<V>(row, 1);
    const V r2 = rows_abreast<V>(row, 2), r3 = rows_abreast<V>(row, 3);
    const V even01 = even_lanes(r0, r1), even23 = even_lanes(r2, r3);
    value[0] = first_pairs(even01, even23);
    value[1] = first_pairs(odd_lanes(r0, r1), odd_lanes(r2, r3));
    value[2] = second_pairs(even01, even23);
  }
}

/// Positions and displacements of the nodes at the places.
template <class V>
TREAD_INLINE void gather_nodes(const double* nodes, const std::uint16_t* place, V (&position)[3],
                               V (&displacement)[3]) {
  constexpr int kWidth = sizeof(V) / sizeof(double);
  const double* at[kWidth];
  for (int l = 0; l < kWidth; ++l) at[l] = nodes + place[l];
  transpose_rows([&](int l) { return at[l]; }, position);
  transpose_rows([&](int l) { return at[l] + kHexNodeValues; }, displacement);
}

/// The same of the elements' corners: eight anywhere, or on four lines.
template <class V>
TREAD_INLINE void gather_corners(const double* nodes, const HexPack& pack, int lane, V (&position)[8][3],
                                 V (&displacement)[8][3]) {
  for (int k = 0; k < 8; ++k) gather_nodes(nodes, &pack.corner[k][lane], position[k], displacement[k]);
}
template <class V>
TREAD_INLINE void gather_corners(const double* nodes, const HexRow& row, int lane, V (&position)[8][3],
                                 V (&displacement)[8][3]) {
  constexpr int kWidth = sizeof(V) / sizeof(double);
  for (int k = 0; k < 4; ++k) {
    gather_nodes(nodes, &row.corner[k][lane], position[k], displacement[k]);
    const double* const last = nodes + row.corner[k][lane + kWidth];
    for (int i = 0; i < 3; ++i) {
      position[k + 4][i] = shift_down(position[k][i], V{} + last[i]);
      displacement[k + 4][i] = shift_down(displacement[k][i], V{} + last[kHexNodeValues + i]);
    }
  }
}

template <class Row, class V>
TREAD_INLINE void add_rows(double* first, double* second, const V& rows) {
  if constexpr (sizeof(V) == 64) {
    store(first, load<Row>(first) + __builtin_shufflevector(rows, rows, 0, 1, 2, 3));
    store(second, load<Row>(second) + __builtin_shufflevector(rows, rows, 4, 5, 6, 7));
  } else {
    store(first, load<Row>(first) + rows);
  }
}

/// The forces of a node, at its place.
[[gnu::always_inline]] inline double* force_at(double* forces, std::uint16_t place) {
  constexpr std::size_t kBytes = kHexNodeValues * sizeof(double) / kHexPlace;
  return reinterpret_cast<double*>(reinterpret_cast<char*>(forces) + kBytes * place);
}

/// Adds the components to the forces at the places, lane after lane in an order of its own.
template <class V>
TREAD_INLINE void add_to_nodes(double* forces, const std::uint16_t* place, const V (&value)[3]) {
  const auto at = [&](int l) { return force_at(forces, place[l]); };
  const V none{};
  const V even = even_lanes(value[0], value[1]), odd = odd_lanes(value[0], value[1]);
  const V even_z = even_lanes(value[2], none), odd_z = odd_lanes(value[2], none);
  if constexpr (sizeof(V) == 16) {
    store(at(0), load<V>(at(0)) + even);
    store(at(0) + 2, load<V>(at(0) + 2) + even_z);
    store(at(1), load<V>(at(1)) + odd);
    store(at(1) + 2, load<V>(at(1) + 2) + odd_z);
  } else {
    using Row = typename Vector<double, 4>::type;
    const int far = sizeof(V) == 64 ? 4 : 0;
    add_rows<Row>(at(0), at(far), first_pairs(even, even_z));
    add_rows<Row>(at(1), at(1 + far), first_pairs(odd, odd_z));
    add_rows<Row>(at(2), at(2 + far), second_pairs(even, even_z));
    add_rows<Row>(at(3), at(3 + far), second_pairs(odd, odd_z));
  }
}

/// The same for the elements' corners.
template <class V>
TREAD_INLINE void add_to_corners(double* forces, const HexPack& pack, int lane, const V (&value)[8][3]) {
  for (int k = 0; k < 8; ++k) add_to_nodes(forces, &pack.corner[k][lane], value[k]);
}
template <class V>
TREAD_INLINE void add_to_corners(double* forces, const HexRow& row, int lane, const V (&value)[8][3]) {
  constexpr int kWidth = sizeof(V) / sizeof(double);
  for (int k = 0; k < 4; ++k) {
    V sum[3];
    for (int i = 0; i < 3; ++i) sum[i] = value[k][i] + shift_up(V{}, value[k + 4][i]);
    add_to_nodes(forces, &row.corner[k][lane], sum);
    double* const last = force_at(forces, row.corner[k][lane + kWidth]);
    for (int i = 0; i < 3; ++i) last[i] += value[k + 4][i][kWidth - 1];
  }
}

}  // namespace
}  // namespace tread
