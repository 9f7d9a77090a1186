#pragma once
// The state of a run, field by field: bytes, copies, differences.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

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

/// Names and bytes of a state's fields. A model holds the contact's state of all runs that it makes.
using StateBytes = std::vector<std::pair<std::string, std::string>>;

inline StateBytes bytes(const StateList& state) {
  StateBytes copies;
  for (const StateList::Field& field : state.fields()) copies.emplace_back(field.name, bytes(field));
  return copies;
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
inline std::string differences(const StateBytes& a, const StateBytes& b) {
  std::string names = a.size() == b.size() ? "" : "number of fields ";
  for (std::size_t i = 0; i < a.size(); ++i)
    if (i >= b.size() || a[i] != b[i]) names += a[i].first + " ";
  return names;
}

inline std::string differences(const StateList& a, const StateList& b) {
  return differences(bytes(a), bytes(b));
}

}  // namespace tread::samples
