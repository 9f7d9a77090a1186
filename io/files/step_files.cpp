#include "io/files/step_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <system_error>

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = "step-";

/// Steps in the file's name; nullopt for any other name.
std::optional<std::int64_t> steps_of(const fs::path& path, std::string_view suffix) {
  const std::string name = path.filename().string();
  if (!name.starts_with(kPrefix) || !name.ends_with(suffix)) return std::nullopt;
  if (name.size() <= kPrefix.size() + suffix.size()) return std::nullopt;
  std::int64_t steps = 0;
  const char* last = name.data() + name.size() - suffix.size();
  const auto [end, error] = std::from_chars(name.data() + kPrefix.size(), last, steps);
  if (error != std::errc() || end != last || steps < 0) return std::nullopt;
  return steps;
}

}  // namespace

fs::path step_file(const fs::path& folder, std::int64_t steps, std::string_view suffix) {
  return folder / fmt::format("{}{:012}{}", kPrefix, steps, suffix);
}

std::vector<std::int64_t> steps_in(const fs::path& folder, std::string_view suffix) {
  std::vector<std::int64_t> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::optional<std::int64_t> steps = steps_of(entry.path(), suffix);
    // Another spelling of the number is a foreign file.
    if (steps && entry.path() == step_file(folder, *steps, suffix)) found.push_back(*steps);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void remove_parts(const fs::path& folder) {
  std::vector<fs::path> parts;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".part") parts.push_back(entry.path());
  for (const fs::path& part : parts) fs::remove(part, ignored);
}

}  // namespace tread
