#pragma once
// A vector field over the nodes of a mesh, stored in double or in single precision. These views serve code
// that reads or changes few values; it computes in double for either storage.

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/inline.hpp"
#include "core/math/vec.hpp"
#include "core/mesh/swept_block.hpp"

namespace tread {

/// The components of kLanes nodes, [component][lane].
using NodeLanes = std::array<std::array<double, kLanes>, 3>;

/// Read-only view; values in the order of dof(). False if there is no field.
class ConstNodeField {
 public:
  TREAD_BODY ConstNodeField(std::nullptr_t = nullptr) {}
  TREAD_BODY ConstNodeField(const double* values) : double_(values) {}
  TREAD_BODY ConstNodeField(const float* values) : single_(values) {}

  TREAD_BODY explicit operator bool() const { return double_ != nullptr || single_ != nullptr; }

  TREAD_BODY double operator[](std::int64_t i) const { return single_ != nullptr ? single_[i] : double_[i]; }

  /// The three components at a node, in its local basis.
  TREAD_BODY Vec3 at(std::int64_t slot) const {
    const std::int64_t first = dof(slot, 0);
    if (single_ != nullptr) return {single_[first], single_[first + kLanes], single_[first + 2 * kLanes]};
    return {double_[first], double_[first + kLanes], double_[first + 2 * kLanes]};
  }

  /// Components at the nodes of the slots [slot, slot + kLanes); slot is a multiple of kLanes.
  NodeLanes lanes(std::int64_t slot) const {
    NodeLanes out;
    const auto read = [&](const auto* from) {
      for (std::array<double, kLanes>& component : out)
        for (double& value : component) value = *from++;
    };
    if (single_ != nullptr)
      read(single_ + dof(slot, 0));
    else
      read(double_ + dof(slot, 0));
    return out;
  }

 private:
  const double* double_ = nullptr;
  const float* single_ = nullptr;
};

/// View to read and write. Written values are rounded to the field's precision.
class NodeField {
 public:
  /// Proxy of one value of the field.
  class Value {
   public:
    TREAD_BODY Value(const NodeField& field, std::int64_t i)
        : double_(field.double_), single_(field.single_), i_(i) {}
    Value(const Value&) = default;
    /// Writes the other's value to the place of this one.
    /// NOLINTNEXTLINE(bugprone-unhandled-self-assignment)
    Value& operator=(const Value& other) { return *this = static_cast<double>(other); }
    TREAD_BODY operator double() const { return single_ != nullptr ? single_[i_] : double_[i_]; }
    TREAD_BODY Value& operator=(double value) {
      if (single_ != nullptr)
        single_[i_] = static_cast<float>(value);
      else
        double_[i_] = value;
      return *this;
    }
    TREAD_BODY Value& operator+=(double value) { return *this = *this + value; }
    TREAD_BODY Value& operator-=(double value) { return *this = *this - value; }

   private:
    double* double_;
    float* single_;
    std::int64_t i_;
  };

  NodeField() = default;
  TREAD_BODY NodeField(double* values) : double_(values) {}
  TREAD_BODY NodeField(float* values) : single_(values) {}
  TREAD_BODY operator ConstNodeField() const {
    return single_ != nullptr ? ConstNodeField(single_) : ConstNodeField(double_);
  }

  /// Calls `act` with a pointer to the values in their stored type.
  template <class Act>
  void visit(const Act& act) const {
    if (single_ != nullptr)
      act(single_);
    else
      act(double_);
  }

  TREAD_BODY Value operator[](std::int64_t i) const { return {*this, i}; }
  TREAD_BODY Vec3 at(std::int64_t slot) const { return ConstNodeField(*this).at(slot); }
  TREAD_BODY void set(std::int64_t slot, const Vec3& value) const {
    for (int c = 0; c < 3; ++c) (*this)[dof(slot, c)] = value[c];
  }
  TREAD_BODY void add(std::int64_t slot, const Vec3& value) const {
    for (int c = 0; c < 3; ++c) (*this)[dof(slot, c)] += value[c];
  }

 private:
  double* double_ = nullptr;
  float* single_ = nullptr;
};

}  // namespace tread
