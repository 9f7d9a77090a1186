#pragma once
// Environment that launchers of several processes leave. Private to drivers/process/.

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace tread {

/// The first of these variables that holds a number, or `otherwise`.
inline int launcher_number(std::initializer_list<const char*> names, int otherwise) {
  for (const char* name : names) {
    int value = 0;
    const char* const text = std::getenv(name);
    if (text && std::from_chars(text, text + std::strlen(text), value).ec == std::errc()) return value;
  }
  return otherwise;
}

/// Number of processes started together; 0: several or one, known to the library of messages alone.
inline int launched_count() {
  const int count = launcher_number({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}, 0);
  if (count > 0) return count;
  return std::getenv("PMIX_RANK") ? 0 : 1;
}

}  // namespace tread
