#pragma once
// The checkpoints of a run: the last two, or those to be kept. Each file is complete or absent.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/files/sealed_file.hpp"

namespace tread {

/// Number of the layout of a checkpoint's file; the contents have one of their own.
inline constexpr int kCheckpointFileVersion = 3;

/// Stages in the writing of a checkpoint.
enum class CheckpointStage { begun, sealed, verified, in_place, old_removed };

/// Called with each stage as it is reached.
using CheckpointObserver = std::function<void(CheckpointStage)>;

/// FOLDER/order.h5, the run's order, and FOLDER/step-<number>.h5, its states. Writing makes FOLDER, but not
/// the run's folder above it: that one may have been moved away.
class CheckpointFolder {
 public:
  explicit CheckpointFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes the order: the data that a run needs before it has a state. Throws ResourceError.
  void write_order(SealedContent order) const;
  SealedContent read_order() const;

  /// Writes the state after `steps` steps beside the others, forces it to the disk, reads it back and gives
  /// it its name. Then removes all other states but the newest. Throws ResourceError; the other states then
  /// stay unchanged.
  void write(std::int64_t steps, SealedContent content, const CheckpointObserver& observer = {}) const;

  /// Writes the state after `steps` steps as write() does, but removes nothing. Throws ResourceError.
  void keep(std::int64_t steps, const SealedContent& content) const;

  struct Found {
    std::filesystem::path path;
    std::int64_t steps;
    SealedContent content;
  };
  /// Throws InputError where a file of sound bytes holds no state.
  using Check = std::function<void(const Found&)>;
  /// Newest sound state after at most `last` steps that passes the check. Reasons why newer states are
  /// unsound go to `refused`, a sentence each. Throws InputError where the folder cannot be read.
  std::optional<Found> newest(std::vector<std::string>& refused, const Check& check = {},
                              std::int64_t last = std::numeric_limits<std::int64_t>::max()) const;

  /// Paths of the states, the newest first.
  std::vector<std::filesystem::path> states() const;
  /// Returns true if the folder holds the order or a state of a run that is not finished.
  bool holds_run() const;

  /// Removes everything that write() and write_order() left.
  void clear() const;

  const std::filesystem::path& path() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace tread
