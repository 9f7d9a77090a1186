#pragma once
// Frames of a run for ParaView: frames/step-<number>.hdf, beside them their common mesh, and
// frames.hdf.series, which lists them with their times. Every file is complete or absent.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "io/vtk/vtkhdf.hpp"

namespace tread {

/// Steps after which a run of `steps` steps writes one of `count` frames, evenly spaced: the first after the
/// first step, the last at the end. A run of few steps has fewer.
std::vector<std::int64_t> frame_steps(int count, std::int64_t steps);

/// Values of all nodes, which all threads copy.
template <class Real>
class FieldCopy {
 public:
  void take(ConstNodeField from, std::int64_t slots);
  /// Null without values.
  const Real* data() const { return values_.get(); }
  const Real& operator[](std::size_t i) const { return values_[i]; }

 private:
  std::unique_ptr<Real[]> values_;
};

class FrameFiles {
 public:
  /// `steps`: number of steps of the whole run, `dt`: one step [s], `reached`: steps that the run has done.
  /// Frames up to there stay in the folder. Removes later ones that the run writes when it comes to them, or
  /// never; those on request before its end stay: they hold the bits that the run will have.
  FrameFiles(const Model& model, std::filesystem::path directory, std::int64_t steps, double dt,
             std::int64_t reached);

  bool due(std::int64_t steps) const;

  /// Keeps the data of a frame of this instant. Not to be called while write() runs.
  void copy(const Simulation& simulation);
  /// Writes the frame of the last copy() and frees the copy. Steps may go on meanwhile. Throws ResourceError.
  void write();

  /// Sentences on files in the folder that are no frames, and on frames up to a step that it lacks.
  std::vector<std::string> gaps(std::int64_t steps) const;

  /// Number of frames in the folder. It may be called while write() runs.
  std::size_t count() const;

  /// Copies the frames of the run in another folder up to a step. Throws ResourceError.
  static void take_over(const std::filesystem::path& from, const std::filesystem::path& to,
                        std::int64_t steps);

  /// Removes all files that an earlier run has left in the folder.
  static void remove(const std::filesystem::path& directory);

 private:
  /// Values of an instant that write() needs.
  struct Instant {
    std::int64_t steps = 0;
    double time = 0;  ///< [s]
    FieldCopy<double> displacement;
    FieldCopy<float> velocity;
    FieldCopy<double> lag;  ///< empty without Maxwell branches
    std::optional<LawState<double>> laws;
    BodyFrame wheel;
    PatchNodes patch;  ///< empty without contact
  };

  std::filesystem::path folder() const;
  void remove_later(std::int64_t reached, std::int64_t end) const;
  /// Steps of the frames in the folder, ascending; damaged ones are left out.
  std::vector<std::int64_t> there() const;
  void begin();
  void write_copy();
  void write_series() const;
  std::vector<VtkArray> arrays() const;
  std::vector<VtkArray> contact_arrays() const;
  VtkArray von_mises_stress() const;
  std::vector<float> points() const;

  const Model* model_;
  std::filesystem::path directory_;
  double dt_;
  std::vector<std::int64_t> due_;      ///< ascending
  std::vector<std::int64_t> damaged_;  ///< steps of files that were no HDF5 at the start, ascending
  std::vector<Placement> places_;      ///< placements of the blocks at the instant
  VtkGrid grid_;
  Instant at_;
  bool begun_ = false;
};

/// Sizes of a frame before compression and of the mesh that the frames share [B].
struct FrameBytes {
  std::int64_t frame = 0;
  std::int64_t mesh = 0;
};
FrameBytes frame_bytes(const VtkGrid& grid);

/// Places of the blocks; the wheel stands on the rail where the undeformed bodies touch.
std::vector<Placement> resting_places(const Model& model);

/// Cells that the scene's frames show.
VtkCells frame_cells(const Scene& scene);

}  // namespace tread
