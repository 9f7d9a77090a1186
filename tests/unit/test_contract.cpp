// Contracts abort in debug builds and are not evaluated in release builds.

#include <gtest/gtest.h>

#include "core/contract.hpp"

namespace tread {
namespace {

TEST(Contract, HeldContractsPass) {
  TREAD_EXPECT(1 + 1 == 2);
  TREAD_ENSURE(true);
}

#ifdef NDEBUG
TEST(Contract, ReleaseBuildsDoNotEvaluateThem) {
  int evaluated = 0;
  TREAD_EXPECT(++evaluated > 0);
  TREAD_ENSURE(++evaluated > 0);
  EXPECT_EQ(evaluated, 0);
}
#else
TEST(ContractDeathTest, BrokenContractsNameThePlace) {
  EXPECT_DEATH(TREAD_EXPECT(1 + 1 == 3), "test_contract.cpp:[0-9]+: expectation does not hold: 1 \\+ 1 == 3");
  EXPECT_DEATH(TREAD_ENSURE(false), "promise does not hold: false");
}
#endif

}  // namespace
}  // namespace tread
