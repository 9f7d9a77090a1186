#include "drivers/bench/lanes/limit_loops.hpp"

#include <stdexcept>
#include <string>

namespace tread {

extern const LimitLoops limit_loops_baseline;
#ifdef TREAD_X86_LANES
extern const LimitLoops limit_loops_avx2;
extern const LimitLoops limit_loops_avx512;
#endif

const LimitLoops& limit_loops(std::string_view instruction_set) {
  for (const LimitLoops* loops : {&limit_loops_baseline,
#ifdef TREAD_X86_LANES
                                  &limit_loops_avx2, &limit_loops_avx512
#endif
       })
    if (instruction_set == loops->name) return *loops;
  throw std::logic_error("no limit loops for the instruction set " + std::string(instruction_set));
}

}  // namespace tread
