#include "drivers/results/disk_use.hpp"

#include <fmt/core.h>

#include <system_error>

#include "core/error.hpp"
#include "drivers/engine/step_features.hpp"
#include "drivers/results/frame_files.hpp"
#include "drivers/results/inventory.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/plain_text.hpp"

namespace tread {

namespace {

// Measured on runs of the scenes in scenes/.
constexpr double kCsvBytes = 13.5;              ///< bytes of a value in histories.csv
constexpr double kPatchShare = 0.15;            ///< share of a sample in patch.h5 that compression leaves
constexpr double kFrameShare = 0.62;            ///< share of a frame that compression leaves
constexpr std::int64_t kReportBytes = 1500000;  ///< bytes of report.html and the small files

}  // namespace

std::int64_t file_bytes(const SceneSource& source) {
  std::size_t sum = 0;
  for (const auto& [name, text] : source.files) sum += text->size();
  return static_cast<std::int64_t>(sum);
}

DiskUse disk_use(const Model& model, double dt, std::int64_t files) {
  DiskUse use;
  use.results = kReportBytes;
  use.checkpoints = files;
  if (!model.scene.motion || dt <= 0) return use;
  const std::int64_t steps = step_count(model.scene, dt);
  const std::int64_t interval = sampling_interval(model.scene, dt);
  use.rows = (steps + interval - 1) / interval;
  const auto rows = static_cast<double>(use.rows);
  const double patch =
      model.contact
          ? kPatchShare * rows * static_cast<double>(PatchFile::sample_bytes(model.contact->nodes()))
          : 0;
  const std::size_t measured = StepFeatures(model, 0).measurements().channels().size();
  use.channels = static_cast<std::int64_t>(history_channels(model).size() + measured);
  const double values = rows * static_cast<double>(use.channels);
  use.results += static_cast<std::int64_t>(values * (kCsvBytes + sizeof(double)) + patch);
  constexpr int kAtOnce = 3;
  const std::int64_t state =
      checkpoint_bytes(model) + files +
      static_cast<std::int64_t>(rows * (sizeof(Sample) + sizeof(double) * static_cast<double>(measured)) +
                                patch);
  use.checkpoints += kAtOnce * state;
  if (model.scene.forks) use.forks = state;
  use.results += use.forks;
  if (const auto frames = static_cast<std::int64_t>(frame_steps(model.scene.output.frames, steps).size())) {
    const FrameBytes bytes = frame_bytes(make_vtk_grid(model.mesh, frame_cells(model.scene)));
    use.frames =
        bytes.mesh + frames * static_cast<std::int64_t>(kFrameShare * static_cast<double>(bytes.frame));
  }
  return use;
}

std::optional<std::int64_t> free_disk(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (error || space.capacity == 0) return std::nullopt;
  return static_cast<std::int64_t>(space.available);
}

void require_free_disk(const std::string& who, std::int64_t needed, const std::filesystem::path& folder,
                       const std::string& way_out) {
  const std::optional<std::int64_t> left = free_disk(folder);
  if (!left || needed <= *left) return;
  throw ResourceError(fmt::format("{} needs about {} more, the disk of {} has {} left; {}", who,
                                  bytes_text(needed), folder.string(), bytes_text(*left), way_out));
}

}  // namespace tread
