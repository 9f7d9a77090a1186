#include "drivers/bench/lanes/limit_loops_body.hpp"

namespace tread {

extern const LimitLoops limit_loops_baseline;
const LimitLoops limit_loops_baseline = loops("baseline");

}  // namespace tread
