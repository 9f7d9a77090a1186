#include "drivers/bench/lanes/limit_loops_body.hpp"

namespace tread {

extern const LimitLoops limit_loops_avx512;
const LimitLoops limit_loops_avx512 = loops("avx512");

}  // namespace tread
