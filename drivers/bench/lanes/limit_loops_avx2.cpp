#include "drivers/bench/lanes/limit_loops_body.hpp"

namespace tread {

extern const LimitLoops limit_loops_avx2;
const LimitLoops limit_loops_avx2 = loops("avx2");

}  // namespace tread
