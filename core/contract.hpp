#pragma once
// Contracts of functions, checked in debug builds (preset `debug`) and absent from release builds.
//
//   TREAD_EXPECT(condition)  precondition: demand on a function's arguments
//
// A broken contract is a defect of the program, not of its input: the process names the place and aborts.

#ifdef NDEBUG
#define TREAD_EXPECT(condition) static_cast<void>(sizeof(!(condition)))
#else
#include <cstdio>
#include <cstdlib>

namespace tread {

/// Names the broken contract and aborts.
[[noreturn]] inline void break_contract(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: expectation does not hold: %s\n", file, line, condition);
  std::abort();
}

}  // namespace tread

#define TREAD_EXPECT(condition) \
  ((condition) ? static_cast<void>(0) : ::tread::break_contract(#condition, __FILE__, __LINE__))
#endif
