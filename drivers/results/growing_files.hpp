#pragma once
// The files that grow during a run: histories.csv, run.h5, patch.h5.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/results/patch_file.hpp"
#include "drivers/results/run_results.hpp"
#include "io/files/file_identity.hpp"
#include "io/files/history_file.hpp"

namespace tread {

inline constexpr const char* kPatchFile = "patch.h5";

class GrowingFiles {
 public:
  /// Starts all files afresh. `results`: states the measured columns.
  GrowingFiles(const Model& model, const std::filesystem::path& directory, const RunResults& results);

  /// Restores the files to the state in which patch_bytes() returned `patch`: cut back to the samples of
  /// `results`, whatever happened to them since.
  GrowingFiles(const Model& model, const std::filesystem::path& directory, const RunResults& results,
               const std::string& patch);

  /// Appends a sample and its measured values. Throws NumericalError if a value of the sample is not finite;
  /// such a value does not reach a file.
  void append(const Sample& sample, std::span<const double> measured);

  /// Samples in the files of the histories.
  std::int64_t rows_written() const { return histories_.rows_written(); }

  /// Returns true while all files have their names: data go nowhere without.
  bool in_place() const;

  /// Bytes of patch.h5 with all samples so far; empty without contact.
  std::string patch_bytes();

  /// Closes the files and forces their data to the disk. Throws ResourceError.
  void close();

 private:
  void identify();
  std::vector<double> row_of(const Sample& sample, std::span<const double> measured) const;

  const Model* model_;
  std::filesystem::path directory_;
  std::vector<Channel> channels_;
  HistoryFile histories_;
  std::optional<PatchFile> patch_;
  std::vector<FileIdentity> identities_;  ///< of all files
};

}  // namespace tread
