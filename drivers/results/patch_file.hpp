#pragma once
// The moving patch: pressure, shear stress, slip and state of the rail's surface nodes about the wheel,
// sample by sample.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "io/files/hdf5_file.hpp"
#include "kernels/contact/patch_nodes.hpp"

namespace tread {

/// Nodes of a window of the rail's surface at one sample, arrays [station][row].
struct PatchSample {
  double time = 0;                  ///< [s]
  double wheel_x = 0;               ///< [m]
  std::int32_t first = 0;           ///< station of the grid at which the window starts
  std::vector<float> fields;        ///< [field][station][row], fields as in patch_fields()
  std::vector<std::uint8_t> state;  ///< values of PatchState
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
  static constexpr std::size_t kBlock = 64;  ///< samples per block

  /// Starts the file afresh, with `attributes` at its root.
  PatchFile(const std::filesystem::path& path, const PatchNodes& nodes, const Hdf5Attributes& attributes);
  /// Goes on with a file that holds `samples`. The attributes replace those of the process before. Throws
  /// InputError if the file does not fit.
  PatchFile(const std::filesystem::path& path, const PatchNodes& nodes, const Hdf5Attributes& attributes,
            std::size_t samples);
  /// Closes without reporting errors.
  ~PatchFile();
  PatchFile(const PatchFile&) = delete;
  PatchFile& operator=(const PatchFile&) = delete;

  void append(double time, double wheel_x, const PatchNodes& nodes);
  /// Hands the waiting samples to the operating system.
  void flush();
  void close();

  /// Size of a sample before compression [B].
  static std::int64_t sample_bytes(const PatchNodes& nodes);

 private:
  Hdf5File file_;
  std::vector<double> time_, wheel_x_;
  std::vector<std::int32_t> first_;
  std::vector<std::vector<float>> fields_;  ///< values by field: [sample][station][row]
  std::vector<std::uint8_t> state_;
  bool open_ = true;
};

/// Axes of the rail's surface in patch.h5 [m].
struct PatchAxes {
  std::vector<double> x;  ///< coordinates by station
  std::vector<double> y;  ///< coordinates by row
};

/// The window of a sample. Axes and sample must outlive it.
class PatchWindow {
 public:
  PatchWindow(const PatchAxes& axes, const PatchSample& sample) : axes_(axes), sample_(sample) {}

  int stations() const { return static_cast<int>(sample_.state.size() / axes_.y.size()); }
  /// Place of a station of the window [m]. Beyond the rail: the place of its end.
  double x(int i) const;
  double pressure(int i, int row) const { return value(0, i, row); }  ///< [Pa]
  double shear(int i, int row) const;                                 ///< size of the shear stress [Pa]
  double slip_speed(int i, int row) const;                            ///< [m/s]
  PatchState state(int i, int row) const { return static_cast<PatchState>(sample_.state[node(i, row)]); }

 private:
  std::size_t node(int i, int row) const {
    return static_cast<std::size_t>(i) * axes_.y.size() + static_cast<std::size_t>(row);
  }
  /// Value of a field, numbered as in patch_fields().
  double value(std::size_t field, int i, int row) const {
    return sample_.fields[field * sample_.state.size() + node(i, row)];
  }

  const PatchAxes& axes_;
  const PatchSample& sample_;
};

/// Reads the axes. Throws InputError if the file does not hold them.
PatchAxes read_patch_axes(const std::filesystem::path& path);

/// Samples of patch.h5 whose wheel_x lies nearest to the places [m], each once. Throws InputError if the file
/// is damaged.
std::vector<PatchSample> read_patch(const std::filesystem::path& path, const std::vector<double>& places);

}  // namespace tread
