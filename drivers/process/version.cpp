#include "drivers/process/version.hpp"

namespace tread {

const char* program_version() {
  return TREAD_VERSION;
}

ProgramBuild program_build() {
  return {TREAD_COMPILER, TREAD_BUILD, TREAD_PACKAGES};
}

}  // namespace tread
