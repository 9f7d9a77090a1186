#pragma once
// The state of a run, field by field: bytes, copies, differences.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <variant>

#include "core/state_list.hpp"

namespace tread::samples {

/// The bytes of a field.
inline std::string bytes(const StateList::Field& field) {
  return std::visit(
      [](auto values) {
        return std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes());
      },
      field.values);
}

/// Copies the values of a state to one with the same fields.
inline void copy(const StateList& from, const StateList& to) {
  ASSERT_EQ(from.fields().size(), to.fields().size());
  for (std::size_t i = 0; i < from.fields().size(); ++i) {
    const StateList::Field& source = from.fields()[i];
    const StateList::Field& target = to.fields()[i];
    ASSERT_EQ(source.name, target.name);
    ASSERT_EQ(source.values.index(), target.values.index()) << source.name;
    std::visit(
        [&](auto values) {
          const auto given = std::get<decltype(values)>(source.values);
          ASSERT_EQ(given.size(), values.size()) << source.name;
          std::copy(given.begin(), given.end(), values.begin());
        },
        target.values);
  }
}

/// Names of the fields that differ in a bit.
inline std::string differences(const StateList& a, const StateList& b) {
  std::string names;
  for (std::size_t i = 0; i < a.fields().size(); ++i)
    if (bytes(a.fields()[i]) != bytes(b.fields()[i])) names += a.fields()[i].name + " ";
  return names;
}

}  // namespace tread::samples
