#pragma once
// Histories of a run: one row of named values per sample, kept in run.h5 and histories.csv.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/channel.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/output_file.hpp"

namespace tread {

/// Writes rows of channel values to DIR/histories.csv (header `time [s],vertical_force [N],...`) and to the
/// datasets /histories/<channel> of DIR/run.h5 with attributes `unit` and `description`. Rows gather in
/// memory and go out in blocks of `kBlock`. The CSV file holds whole rows at any time, so a run that is
/// killed loses at most the last block. A ResourceError says how many rows are kept; nothing more is written
/// after it.
class HistoryFile {
 public:
  static constexpr std::size_t kBlock = 64;  ///< rows per block

  /// Starts both files afresh. The first channel is the abscissa, usually the time. run.h5 gets `attributes`
  /// at its root.
  HistoryFile(const std::filesystem::path& directory, std::vector<Channel> channels,
              const Hdf5Attributes& attributes = {});
  /// Closes without reporting errors.
  ~HistoryFile();
  HistoryFile(const HistoryFile&) = delete;
  HistoryFile& operator=(const HistoryFile&) = delete;

  /// Adds one row: one value per channel, in the channels' units.
  void append(std::span<const double> row);
  /// Writes the rows that wait in memory and hands both files to the operating system.
  void flush();
  /// Flushes and closes; nothing can be appended afterwards.
  void close();

  const std::vector<Channel>& channels() const { return channels_; }
  /// Number of rows in the files.
  std::int64_t rows_written() const { return rows_written_; }

 private:
  void write_csv();
  void write_hdf5();
  std::string kept() const;

  std::vector<Channel> channels_;
  Hdf5File hdf5_;
  GrowingFile csv_;
  std::vector<double> block_;  ///< waiting rows, row-major
  std::int64_t rows_written_ = 0;
  double last_abscissa_ = 0;  ///< abscissa of the last row written
  bool open_ = true;
};

}  // namespace tread
