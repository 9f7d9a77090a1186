#pragma once
// The checkpoints of a run: the last two, or those that are to be kept, each whole or not there at all.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/files/sealed_file.hpp"

namespace tread {

/// What has been done to a checkpoint that is being written.
enum class CheckpointStage { begun, sealed, verified, in_place, old_removed };
inline constexpr int kCheckpointStages = 5;

/// Told of each stage as it is reached.
using CheckpointObserver = std::function<void(CheckpointStage)>;

/// FOLDER/order.h5, what was asked for, and FOLDER/step-<number>.h5, states.
class CheckpointFolder {
 public:
  explicit CheckpointFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// What a run needs before it has a state. Throws ResourceError.
  void write_order(SealedContent order) const;
  SealedContent read_order() const;

  /// Writes the state after so many steps beside the others, forces it to the disk, reads it back, gives it
  /// its name and removes all others but the newest. Throws ResourceError; the others then stay as they were.
  void write(std::int64_t steps, SealedContent content, const CheckpointObserver& observer = {}) const;

  /// The same, but creates the folder where it is missing and removes nothing.
  void keep(std::int64_t steps, const SealedContent& content) const;

  struct Found {
    std::filesystem::path path;
    std::int64_t steps;
    SealedContent content;
  };
  /// The newest that is sound, of those after at most `last` steps; why newer ones are not goes to `refused`,
  /// a sentence each.
  std::optional<Found> newest(std::vector<std::string>& refused,
                              std::int64_t last = std::numeric_limits<std::int64_t>::max()) const;

  /// Of states, the newest first.
  std::vector<std::filesystem::path> states() const;
  bool has_order() const;

  /// Removes everything that write() and write_order() left.
  void clear() const;

  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace tread
