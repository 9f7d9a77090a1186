#pragma once
// Cases of `tread verify`, run by tests on meshes of their own.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "drivers/verify/cases.hpp"
#include "tests/measured.hpp"

namespace tread {

/// Inputs by name and their new values, as after --set.
using InputChanges = std::vector<std::pair<std::string, std::string>>;

/// Runs the case of that name. The test fails if there is none or the case has no such input.
inline CaseResult run_case(const std::string& name, const InputChanges& changes) {
  for (const VerifyCase& c : verify_cases()) {
    if (c.name != name) continue;
    VerifyInputs inputs(c.inputs);
    for (const auto& [input, value] : changes) EXPECT_TRUE(inputs.set(input, value)) << input;
    CaseResult result = c.run(inputs, [](const std::string&) {});
    EXPECT_FALSE(result.findings.empty());
    EXPECT_FALSE(result.figures.empty());
    for (const Finding& f : result.findings) measured(f.quantity, f.value, f.unit);
    return result;
  }
  ADD_FAILURE() << "no case " << name;
  return {};
}

/// Expects that all findings of the run keep their bounds.
inline void expect_bounds_hold(const std::string& name, const InputChanges& changes) {
  const CaseResult result = run_case(name, changes);
  for (const Finding& f : result.findings)
    EXPECT_TRUE(f.pass()) << f.quantity << ": " << f.value << " against " << f.reference;
}

/// Error of the finding of that name, relative or absolute as the case states it; a finding that the mesh
/// does not resolve says so behind its name.
inline double error_of(const CaseResult& result, const std::string& quantity) {
  for (const Finding& f : result.findings)
    if (f.quantity == quantity || f.quantity.starts_with(quantity + ", not resolved")) return f.error();
  ADD_FAILURE() << "no finding " << quantity;
  return 0;
}

}  // namespace tread
