#pragma once
// Messages of errors.

#include <gtest/gtest.h>

#include <string>

#include "core/error.hpp"

namespace tread::samples {

/// The message of the error of type E that `action` throws; empty if it throws none.
template <class E = Error, class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const E& error) {
    return error.what();
  }
  return "";
}

inline void expect_part(const std::string& whole, const std::string& part) {
  EXPECT_NE(whole.find(part), std::string::npos) << "missing: " << part << "\nin: " << whole;
}

}  // namespace tread::samples
