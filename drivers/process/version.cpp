#include "drivers/process/version.hpp"

#include <utility>

namespace tread {

namespace {

std::string stated_commit;

}  // namespace

const char* program_version() {
  return TREAD_VERSION;
}

const std::string& program_commit() {
  return stated_commit;
}

void state_program_commit(std::string commit) {
  stated_commit = std::move(commit);
}

ProgramBuild program_build() {
  return {TREAD_COMPILER, TREAD_BUILD, TREAD_PACKAGES};
}

}  // namespace tread
