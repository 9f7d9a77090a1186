#pragma once
// Poses of wheel and rail by the displacements of their nodes.

#include "core/mesh/node_field.hpp"
#include "drivers/engine/model/model.hpp"

namespace tread {

/// Rotation of the tread about x, positive when its lowest point moves to the field side: the line that fits
/// its nodes' lateral displacement best, weighted by their masses; `angle` is the wheel frame's [rad].
double wheel_tilt(const Model& model, ConstNodeField displacement, double angle);

/// Place of a section after its body was loaded.
struct SectionPose {
  double roll = 0;   ///< about x [rad]
  double shift = 0;  ///< across, of the running surface [m]
};

/// Pose of the rail's head at a place along it [m], by both ends of its running surface.
SectionPose head_pose(const Model& model, ConstNodeField displacement, double x);

}  // namespace tread
