#include "drivers/process/version.hpp"

namespace tread {

const char* program_version() {
  return TREAD_VERSION;
}

}  // namespace tread
