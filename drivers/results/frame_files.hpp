#pragma once
// Frames of a run for ParaView: frames/step-<number>.hdf, beside them the mesh that they share, and
// frames.hdf.series, which lists them with their times. Every file is whole or not there.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "drivers/engine/simulation.hpp"
#include "io/vtk/vtkhdf.hpp"

namespace tread {

/// Steps after which a run of `steps` steps leaves one of `count` frames: the first after the first step, the
/// last at the end, all even; a run of few steps has fewer.
std::vector<std::int64_t> frame_steps(int count, std::int64_t steps);

class FrameFiles {
 public:
  /// `steps`: of the whole run, `dt`: one of them [s]. Frames that lie in the folder stay: they hold the bits
  /// that would be written again.
  FrameFiles(const Model& model, std::filesystem::path directory, std::int64_t steps, double dt);

  bool due(std::int64_t steps) const;

  /// Keeps what a frame of this instant needs. Not beside write().
  void copy(const Simulation& simulation);
  /// Writes the frame of the last copy() and gives that up; steps may go on meanwhile. Throws ResourceError.
  void write();

  /// That lie in the folder.
  std::size_t count() const;

  /// Copies what the run in another folder has left up to a step. ResourceError.
  static void take_over(const std::filesystem::path& from, const std::filesystem::path& to,
                        std::int64_t steps);

  /// Removes all that an earlier run has left in the folder.
  static void remove(const std::filesystem::path& directory);

 private:
  /// What write() needs of an instant.
  struct Instant {
    std::int64_t steps = 0;
    double time = 0;  ///< [s]
    AlignedVector<double> displacement;
    AlignedVector<float> velocity;
    AlignedVector<double> lag;  ///< empty without Maxwell branches
    BodyFrame wheel;
    PatchNodes patch;  ///< empty without contact
  };

  std::filesystem::path folder() const;
  void begin();
  void write_copy();
  void write_series() const;
  std::vector<VtkArray> arrays() const;
  VtkArray contact_pressure() const;
  VtkArray von_mises_stress() const;
  std::vector<float> points() const;

  const Model* model_;
  std::filesystem::path directory_;
  double dt_;
  std::vector<std::int64_t> due_;  ///< rising
  std::vector<Placement> places_;  ///< of the blocks at the instant
  VtkGrid grid_;
  Instant at_;
  bool begun_ = false;
};

/// Of each frame before compression, and of the mesh that they share [B].
struct FrameBytes {
  std::int64_t frame = 0;
  std::int64_t mesh = 0;
};
FrameBytes frame_bytes(const VtkGrid& grid);

/// Of the blocks, the wheel on the rail where the undeformed bodies touch.
std::vector<Placement> resting_places(const Model& model);

/// What the scene's frames show.
VtkCells frame_cells(const Scene& scene);

}  // namespace tread
