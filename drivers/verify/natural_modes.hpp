#pragma once
// Natural modes of a scene's wheel at rest and their shapes.

#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/engine/start/preload.hpp"

namespace tread {

/// Direction of the displacement that, by mass, carries most of a mode's motion.
enum class Direction { around, along_axis, radial };

struct NaturalMode {
  double frequency = 0;  ///< [Hz]
  int waves = 0;         ///< number of waves around the axle
  Direction direction = Direction::around;
  double share = 0;  ///< share of the motion with these waves [-]
  /// Amplitudes of the tread's, disc's and axle's section nodes along the axis and radially (for torsion:
  /// around), largest 1; node by node, block after block.
  std::vector<double> along_axis, in_plane;

  std::string name() const;
};

/// The lowest modes of a model that is a wheel alone, rigid ones included, one of each pair. Throws
/// NumericalError without convergence.
std::vector<NaturalMode> natural_modes(const Model& model, int count, const ProgressText& progress);

}  // namespace tread
