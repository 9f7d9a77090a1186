#include "io/checkpoint_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/output_file.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kKind = "checkpoint";
/// To be raised whenever a name or meaning in a checkpoint changes.
constexpr int kVersion = 2;
constexpr std::size_t kKept = 2;
constexpr const char* kPrefix = "step-";
constexpr const char* kSuffix = ".h5";

/// Of "step-000000001200.h5"; nothing for any other name.
std::optional<std::int64_t> steps_of(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::string_view prefix = kPrefix;
  const std::string_view suffix = kSuffix;
  if (!name.starts_with(prefix) || !name.ends_with(suffix) || name.size() <= prefix.size() + suffix.size())
    return std::nullopt;
  std::int64_t steps = 0;
  const char* last = name.data() + name.size() - suffix.size();
  const auto [end, error] = std::from_chars(name.data() + prefix.size(), last, steps);
  if (error != std::errc() || end != last) return std::nullopt;
  return steps;
}

void remove_all(const std::vector<fs::path>& paths) {
  std::error_code ignored;
  for (const fs::path& path : paths) fs::remove(path, ignored);
}

/// What a process that was killed while it wrote has left.
void remove_parts(const fs::path& folder) {
  std::vector<fs::path> paths;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".part") paths.push_back(entry.path());
  remove_all(paths);
}

void create(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw ResourceError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
}

fs::path state_path(const fs::path& folder, std::int64_t steps) {
  return folder / fmt::format("{}{:012}{}", kPrefix, steps, kSuffix);
}

void write_verified(const fs::path& path, SealedContent content, const CheckpointObserver& observer) {
  const auto digests = digests_of(content);
  const auto reached = [&](CheckpointStage stage) {
    if (observer) observer(stage);
  };
  replace_file(path, [&](const fs::path& part) {
    reached(CheckpointStage::begun);
    write_sealed(part, kKind, kVersion, std::move(content));
    reached(CheckpointStage::sealed);
    try {
      if (digests_of(read_sealed(part, kKind, kVersion)) != digests)
        throw InputError("other values come back");
    } catch (const InputError& error) {
      throw ResourceError(fmt::format("{} does not read back as it was written: {}; look after the disk",
                                      part.string(), error.what()));
    }
    reached(CheckpointStage::verified);
  });
  reached(CheckpointStage::in_place);
}

}  // namespace

void CheckpointFolder::write_order(SealedContent order) const {
  create(folder_);
  write_verified(folder_ / "order.h5", std::move(order), {});
}

SealedContent CheckpointFolder::read_order() const {
  return read_sealed(folder_ / "order.h5", kKind, kVersion);
}

void CheckpointFolder::write(std::int64_t steps, SealedContent content,
                             const CheckpointObserver& observer) const {
  create(folder_);
  remove_parts(folder_);
  write_verified(state_path(folder_, steps), std::move(content), observer);
  std::vector<fs::path> old = states();
  std::size_t kept = 0;
  // States beyond this one were no good, or the run would have gone on from them.
  std::erase_if(old, [&](const fs::path& path) { return *steps_of(path) <= steps && ++kept <= kKept; });
  remove_all(old);
  if (observer) observer(CheckpointStage::old_removed);
}

void CheckpointFolder::keep(std::int64_t steps, const SealedContent& content) const {
  create(folder_);
  remove_parts(folder_);
  write_verified(state_path(folder_, steps), content, {});
}

std::vector<fs::path> CheckpointFolder::states() const {
  std::vector<fs::path> paths;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, ignored))
    if (steps_of(entry.path())) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end(),
            [](const fs::path& a, const fs::path& b) { return *steps_of(a) > *steps_of(b); });
  return paths;
}

bool CheckpointFolder::has_order() const {
  return fs::exists(fs::symlink_status(folder_ / "order.h5"));
}

std::optional<CheckpointFolder::Found> CheckpointFolder::newest(std::vector<std::string>& refused,
                                                                std::int64_t last) const {
  for (const fs::path& path : states()) {
    if (*steps_of(path) > last) continue;
    try {
      return Found{path, *steps_of(path), read_sealed(path, kKind, kVersion)};
    } catch (const InputError& error) {
      refused.emplace_back(error.what());
    }
  }
  return std::nullopt;
}

void CheckpointFolder::clear() const {
  std::error_code ignored;
  fs::remove(folder_ / "order.h5", ignored);  // first: an order without states would begin anew
  remove_all(states());
  remove_parts(folder_);
  fs::remove(folder_, ignored);
}

}  // namespace tread
