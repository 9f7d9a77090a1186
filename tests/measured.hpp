#pragma once
// Numbers that a test measures, printed for docs/records/verification.md and kept in the test's report.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>

namespace tread {

inline void measured(const std::string& what, double value, const std::string& unit = "") {
  fmt::print("  measured: {} = {:.6g} {}\n", what, value, unit);
  testing::Test::RecordProperty(what, fmt::format("{:.9g} {}", value, unit));
}

}  // namespace tread
