#include "drivers/process/progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include "drivers/process/standard_files.hpp"

namespace tread {

Progress::Progress(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()) {}

void Progress::say(const std::string& text) const {
  if (!quiet_) warn(text);
}

void Progress::warn(const std::string& text) const {
  print_error(text + "\n");
}

bool Progress::due(double interval) {
  const double now = seconds();
  if (now - last_ < interval) return false;
  last_ = now;
  return true;
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

std::string duration_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.1f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.1f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace tread
