#pragma once
// The files that grow while a run lasts: histories.csv, run.h5, patch.h5.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drivers/results/patch_file.hpp"
#include "drivers/results/run_results.hpp"
#include "io/files/history_file.hpp"

namespace tread {

inline constexpr const char* kPatchFile = "patch.h5";

class GrowingFiles {
 public:
  /// Starts all afresh.
  GrowingFiles(const Model& model, const std::filesystem::path& directory);

  /// Makes them what they were when patch_bytes() gave `patch`: cut back to the samples, whatever happened to
  /// them since.
  GrowingFiles(const Model& model, const std::filesystem::path& directory, const std::vector<Sample>& samples,
               const std::string& patch);

  /// NumericalError where a value is not finite: it does not reach a file.
  void append(const Sample& sample);

  /// What patch.h5 holds with all samples so far; empty without contact.
  std::string patch_bytes();

  void close();

 private:
  const Model* model_;
  std::filesystem::path directory_;
  std::vector<Channel> channels_;
  HistoryFile histories_;
  std::optional<PatchFile> patch_;
};

}  // namespace tread
