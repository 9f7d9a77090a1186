#pragma once
// Vector fields from which the loop over hexahedra takes displacements and to which it brings forces.

#include <algorithm>
#include <cstdint>

#include "core/mesh/node_field.hpp"
#include "kernels/lanes/hex_force.hpp"

namespace tread {

/// Values of a node, one by one: a register made of three places would wait for all of them.
using HexValues = double[3];

/// A field of rows.
template <class Value>
struct HexRows {
  Value* values;
  void get(std::int64_t node, HexValues& to) const {
    for (int c = 0; c < 3; ++c) to[c] = values[kHexNodeValues * node + c];
  }
  void set(std::int64_t node, const double* row) const {
    std::copy_n(row, kHexNodeValues, values + kHexNodeValues * node);
  }
};

/// A field of a mesh, from a slot on.
template <class Value>
struct HexSlots {
  Value* values;
  std::int64_t first;
  void get(std::int64_t node, HexValues& to) const {
    const Value* const of = values + dof(first + node, 0);
    for (int c = 0; c < 3; ++c) to[c] = static_cast<double>(of[c * kLanes]);
  }
  void set(std::int64_t node, const double* row) const {
    Value* const of = values + dof(first + node, 0);
    for (int c = 0; c < 3; ++c) of[c * kLanes] = static_cast<Value>(row[c]);
  }
};

/// The same through a view.
struct HexViewedSlots {
  ConstNodeField values;
  std::int64_t first;
  void get(std::int64_t node, HexValues& to) const {
    const Vec3 of = values.at(first + node);
    for (int c = 0; c < 3; ++c) to[c] = of[c];
  }
};

}  // namespace tread
