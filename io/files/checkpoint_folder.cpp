#include "io/files/checkpoint_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "io/files/output_file.hpp"
#include "io/files/step_files.hpp"

namespace tread {

namespace fs = std::filesystem;

namespace {

constexpr const char* kKind = "checkpoint";
constexpr std::size_t kKept = 2;
constexpr std::string_view kSuffix = ".h5";

/// Steps of the states, the newest first.
std::vector<std::int64_t> newest_first(const fs::path& folder) {
  std::vector<std::int64_t> found = steps_in(folder, kSuffix);
  std::reverse(found.begin(), found.end());
  return found;
}

/// Throws InputError where the folder is there and cannot be read.
void require_readable(const fs::path& folder) {
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error && error != std::errc::no_such_file_or_directory)
    throw InputError(fmt::format("cannot read {}: {}{}", folder.string(), error.message(),
                                 error == std::errc::permission_denied ? "; change its permissions" : ""));
}

void remove_states(const fs::path& folder, const std::vector<std::int64_t>& all) {
  std::error_code ignored;
  for (const std::int64_t steps : all) fs::remove(step_file(folder, steps, kSuffix), ignored);
}

void write_verified(const fs::path& path, SealedContent content, const CheckpointObserver& observer) {
  const auto digests = digests_of(content);
  const auto reached = [&](CheckpointStage stage) {
    if (observer) observer(stage);
  };
  replace_file(path, [&](const fs::path& part) {
    reached(CheckpointStage::begun);
    write_sealed(part, kKind, kCheckpointFileVersion, std::move(content));
    reached(CheckpointStage::sealed);
    try {
      if (digests_of(read_sealed(part, kKind, kCheckpointFileVersion)) != digests)
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
  create_last_folder(folder_);
  write_verified(folder_ / "order.h5", std::move(order), {});
}

SealedContent CheckpointFolder::read_order() const {
  return read_sealed(folder_ / "order.h5", kKind, kCheckpointFileVersion);
}

void CheckpointFolder::write(std::int64_t steps, SealedContent content,
                             const CheckpointObserver& observer) const {
  create_last_folder(folder_);
  remove_parts(folder_);
  write_verified(step_file(folder_, steps, kSuffix), std::move(content), observer);
  std::vector<std::int64_t> old = newest_first(folder_);
  std::size_t kept = 0;
  // States beyond `steps` are unusable: the run would have resumed from a sound one.
  std::erase_if(old, [&](std::int64_t other) { return other <= steps && ++kept <= kKept; });
  remove_states(folder_, old);
  if (observer) observer(CheckpointStage::old_removed);
}

void CheckpointFolder::keep(std::int64_t steps, const SealedContent& content) const {
  create_last_folder(folder_);
  remove_parts(folder_);
  write_verified(step_file(folder_, steps, kSuffix), content, {});
}

std::vector<fs::path> CheckpointFolder::states() const {
  std::vector<fs::path> paths;
  for (const std::int64_t steps : newest_first(folder_)) paths.push_back(step_file(folder_, steps, kSuffix));
  return paths;
}

bool CheckpointFolder::holds_run() const {
  return fs::exists(fs::symlink_status(folder_ / "order.h5")) || !states().empty();
}

std::optional<CheckpointFolder::Found> CheckpointFolder::newest(std::vector<std::string>& refused,
                                                                const Check& check, std::int64_t last) const {
  require_readable(folder_);
  for (const std::int64_t steps : newest_first(folder_)) {
    if (steps > last) continue;
    const fs::path path = step_file(folder_, steps, kSuffix);
    try {
      Found found{path, steps, read_sealed(path, kKind, kCheckpointFileVersion)};
      try {
        if (check) check(found);
      } catch (const InputError& error) {
        throw InputError(fmt::format("cannot use {}: {}", path.string(), error.what()));
      }
      return found;
    } catch (const InputError& error) {
      refused.emplace_back(error.what());
    }
  }
  return std::nullopt;
}

void CheckpointFolder::clear() const {
  std::error_code ignored;
  fs::remove(folder_ / "order.h5", ignored);  // first: an order without states would start the run anew
  remove_states(folder_, newest_first(folder_));
  remove_parts(folder_);
  fs::remove(folder_, ignored);
}

}  // namespace tread
