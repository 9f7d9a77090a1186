#include "drivers/process/launcher.hpp"

#include <fmt/core.h>

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <thread>

#include "core/error.hpp"

namespace tread {

namespace {

struct LauncherNumber {
  const char* name = "";  ///< of the variable; empty: there is none
  int value = 0;
};

/// The first of these variables that holds a number.
LauncherNumber launcher_number(std::initializer_list<const char*> names) {
  for (const char* name : names) {
    int value = 0;
    const char* const text = std::getenv(name);
    if (text && std::from_chars(text, text + std::strlen(text), value).ec == std::errc())
      return {name, value};
  }
  return {};
}

LauncherNumber launcher_size() {
  return launcher_number({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
}

}  // namespace

int launched_count() {
  const int count = launcher_size().value;
  if (count > 0) return count;
  return std::getenv("PMIX_RANK") ? 0 : 1;
}

void refuse_launch(const std::string& why) {
  if (launcher_number({"OMPI_COMM_WORLD_RANK", "PMI_RANK"}).value > 0)
    std::this_thread::sleep_for(std::chrono::seconds(2));
  const LauncherNumber size = launcher_size();
  throw InputError(fmt::format(
      "{} processes were started together, but {}; one that has only inherited the variable: unset {}",
      size.value, why, size.name));
}

}  // namespace tread
