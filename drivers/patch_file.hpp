#pragma once
// The moving patch: pressure, shear stress, slip and state of the rail's surface nodes about the wheel,
// sample by sample.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/hdf5_file.hpp"
#include "kernels/patch_nodes.hpp"

namespace tread {

/// The nodes of a window of the rail's surface at one sample, arrays [station][row].
struct PatchSample {
  double time = 0;                  ///< [s]
  double wheel_x = 0;               ///< [m]
  std::int32_t first = 0;           ///< station of the grid that the window starts with
  std::vector<float> fields;        ///< [field][station][row], fields as in patch_fields()
  std::vector<std::uint8_t> state;  ///< PatchState
};

/// A field of patch.h5.
struct PatchField {
  const char* name;
  const char* unit;
  const char* description;
  double (*value)(const NodalContact&);
};
const std::vector<PatchField>& patch_fields();

/// Writes patch.h5: /x [m] by station and /y [m] by row of the whole rail's surface; by sample /time [s],
/// /wheel_x [m], /first_station; by sample, station of the window and row the fields of patch_fields() and
/// /state. Samples go out in blocks of `kBlock`, after which the file can be read.
class PatchFile {
 public:
  static constexpr std::size_t kBlock = 64;  ///< samples

  /// Starts the file afresh.
  PatchFile(const std::filesystem::path& path, const PatchNodes& nodes);
  /// Goes on with a file that holds `samples`. InputError where it does not fit.
  PatchFile(const std::filesystem::path& path, const PatchNodes& nodes, std::size_t samples);
  /// Closes without reporting errors.
  ~PatchFile();
  PatchFile(const PatchFile&) = delete;
  PatchFile& operator=(const PatchFile&) = delete;

  void append(double time, double wheel_x, const PatchNodes& nodes);
  /// Hands the samples that wait in memory to the operating system.
  void flush();
  void close();

  /// Of a sample before compression. [B]
  static std::int64_t sample_bytes(const PatchNodes& nodes);

 private:
  Hdf5File file_;
  std::vector<double> time_, wheel_x_;
  std::vector<std::int32_t> first_;
  std::vector<std::vector<float>> fields_;  ///< by field: [sample][station][row]
  std::vector<std::uint8_t> state_;
  bool open_ = true;
};

/// Of patch.h5: the samples whose wheel_x lies nearest to `count` places spread evenly over [first, last]
/// [m], each once.
std::vector<PatchSample> read_patch(const std::filesystem::path& path, double first, double last, int count);

}  // namespace tread
