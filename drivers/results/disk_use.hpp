#pragma once
// Disk use of a run.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "drivers/engine/model/model.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

struct DiskUse {
  std::int64_t rows = 0;         ///< rows of the histories
  std::int64_t channels = 0;     ///< columns of the histories
  std::int64_t results = 0;      ///< other files that stay [B]
  std::int64_t forks = 0;        ///< share of the results: a state that is kept for other runs [B]
  std::int64_t frames = 0;       ///< ParaView frames and their mesh, which stay too [B]
  std::int64_t checkpoints = 0;  ///< while the run lasts: order, two checkpoints, the one being written [B]

  std::int64_t total() const { return results + frames + checkpoints; }
};

/// Size of the files that a scene names, as texts. The order and every state of a run carry them. [B]
std::int64_t file_bytes(const SceneSource& source);

/// Disk use of a run with step `dt` [s]. 0: disk use of its statics alone. `files`: file_bytes() of its
/// scene.
DiskUse disk_use(const Model& model, double dt, std::int64_t files = 0);

/// Space that the disk of a folder has left [B]; nullopt where its file system does not say.
std::optional<std::int64_t> free_disk(const std::filesystem::path& folder);

/// ResourceError where the disk of `folder` has less space left than `who`, "the run", needs [B]. `way_out`:
/// "free some or ...".
void require_free_disk(const std::string& who, std::int64_t needed, const std::filesystem::path& folder,
                       const std::string& way_out);

}  // namespace tread
