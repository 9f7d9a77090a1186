#include "drivers/cli/program_name.hpp"

#include "commit.hpp"
#include "drivers/process/version.hpp"

namespace tread {

void state_commit() {
  state_program_commit(kCommit);
}

std::string program_name() {
  const std::string& commit = program_commit();
  return std::string("tread ") + program_version() + (commit.empty() ? "" : ", commit " + commit);
}

}  // namespace tread
