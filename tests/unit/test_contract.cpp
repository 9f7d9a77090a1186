// Contracts abort in debug builds and are not evaluated in release builds.

#include <gtest/gtest.h>

#include "core/contract.hpp"

namespace tread {
namespace {

#ifdef NDEBUG
TEST(Contract, ReleaseBuildsDoNotEvaluateThem) {
  int evaluated = 0;
  TREAD_EXPECT(++evaluated > 0);
  EXPECT_EQ(evaluated, 0);
}
#else
TEST(ContractDeathTest, BrokenContractsNameThePlace) {
  EXPECT_DEATH(TREAD_EXPECT(1 + 1 == 3), "test_contract.cpp:[0-9]+: expectation does not hold: 1 \\+ 1 == 3");
}
#endif

}  // namespace
}  // namespace tread
